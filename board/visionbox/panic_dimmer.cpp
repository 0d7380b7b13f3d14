#include "board/visionbox/panic_dimmer.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <vector>

#include <sys/uio.h>
#include <unistd.h>

#include "board/visionbox/log.h"
#include "core/base/assert.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

// A signal's handler has no object to ask.
constinit std::atomic<hal::Dimmer*> g_lamp{nullptr};
constinit std::atomic<bool> g_dying{false};
/// What stands before a line that the journal is to take for a critical one.
constinit std::atomic<const char*> g_level{""};
static_assert(std::atomic<hal::Dimmer*>::is_always_lock_free);

struct Deadly {
  int signal;
  const char* name;
};
constexpr std::array kDeadly{Deadly{SIGSEGV, "SIGSEGV"}, Deadly{SIGBUS, "SIGBUS"},
                             Deadly{SIGFPE, "SIGFPE"},   Deadly{SIGILL, "SIGILL"},
                             Deadly{SIGABRT, "SIGABRT"}, Deadly{SIGTRAP, "SIGTRAP"},
                             Deadly{SIGSYS, "SIGSYS"},   Deadly{SIGXCPU, "SIGXCPU"}};

/// A stack for the handlers of a thread, as long as that lives.
class SignalStack {
 public:
  SignalStack() : memory_(kBytes) {
    stack_t own{};
    own.ss_sp = memory_.data();
    own.ss_size = memory_.size();
    held_ = sigaltstack(&own, &before_) == 0;
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;
  /// What stood there before may be somebody's who frees what he finds: a sanitizer's.
  ~SignalStack() {
    if (held_) {
      sigaltstack(&before_, nullptr);
    }
  }

 private:
  /// For the registers of any processor, which the system puts there, and a lamp's driver.
  static constexpr std::size_t kBytes = 64UL * 1024;
  std::vector<std::byte> memory_;
  stack_t before_{};
  bool held_ = false;
};

/// One line in one call, of what a handler may call.
void say(std::initializer_list<const char*> parts) {
  constexpr std::size_t kMostParts = 8;
  std::array<iovec, kMostParts> pieces{};
  std::size_t count = 0;
  const char* const level = g_level;
  // writev() only reads. NOLINTNEXTLINE(*-const-cast)
  pieces[count++] = {const_cast<char*>(level), std::strlen(level)};
  for (const char* part : parts) {
    // writev() only reads. NOLINTNEXTLINE(*-const-cast)
    pieces[count++] = {const_cast<char*>(part), std::strlen(part)};
  }
  static_cast<void>(writev(STDERR_FILENO, pieces.data(), static_cast<int>(count)) == 0);
}

/// False: it was said already.
bool die_once() {
  const bool first = !g_dying.exchange(true);
  PanicDimmer::darken();
  return first;
}

void on_failed_assertion(const char* expression, const char* file, int line) {
  // In digits, from the last.
  std::array<char, 12> digits{};
  std::size_t at = digits.size() - 1;
  do {
    digits[--at] = static_cast<char>('0' + line % 10);
    line /= 10;
  } while (line > 0 && at > 0);
  if (die_once()) {
    say({"tubesightd: panic: ", expression, " at ", file, ":", &digits[at],
         ": the lamp is dark\n"});
  }
}

[[noreturn]] void abort_saying(const char* what) {
  if (die_once()) {
    say({"tubesightd: panic: nobody caught: ", what, ": the lamp is dark\n"});
  }
  std::abort();
}

[[noreturn]] void on_terminate() {
  try {
    if (const std::exception_ptr problem = std::current_exception()) {
      std::rethrow_exception(problem);
    }
  } catch (const std::exception& problem) {
    abort_saying(problem.what());
  } catch (...) {
    abort_saying("something that is no exception");
  }
  abort_saying("the end of a thread that still runs");
}

/// The signal's own action is in force again, so that it kills, and whoever watches sees of what.
void on_deadly_signal(int signal) {
  if (die_once()) {
    const char* name = "a signal";
    for (const Deadly& each : kDeadly) {
      name = each.signal == signal ? each.name : name;
    }
    say({"tubesightd: panic: ", name, ": the lamp is dark\n"});
  }
  PanicDimmer::darken();  // one that was being lit when the first call came
  static_cast<void>(std::raise(signal));
}

}  // namespace

Result<void> PanicDimmer::start() {
  TUBESIGHT_TRY(lamp_->start());
  g_lamp = lamp_;
  return {};
}

void PanicDimmer::stop() {
  forget();
  lamp_->stop();
}

Result<void> PanicDimmer::set_level(std::int32_t permille) {
  if (g_dying) {
    return Unexpected(Error::kNotReady);
  }
  return lamp_->set_level(permille);
}

void PanicDimmer::forget() {
  hal::Dimmer* own = lamp_;
  g_lamp.compare_exchange_strong(own, nullptr);
}

void PanicDimmer::darken() {
  if (hal::Dimmer* const lamp = g_lamp) {
    static_cast<void>(lamp->set_level(0));
  }
}

void use_signal_stack() { thread_local const SignalStack stack; }

void install_panic_hooks() {
  g_level = stderr_is_journal() ? "<2>" : "";
  use_signal_stack();
  core::set_panic_hook(on_failed_assertion);
  std::set_terminate(on_terminate);
  for (const Deadly& each : kDeadly) {
    struct sigaction action {};
    action.sa_handler = on_deadly_signal;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER | SA_ONSTACK);
    sigaction(each.signal, &action, nullptr);
  }
}

}  // namespace tubesight::board
