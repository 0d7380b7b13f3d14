#include "drivers/gpio/gpio_dimmer.h"

#include <cerrno>
#include <cstddef>
#include <utility>

#include <sched.h>
#include <sys/timerfd.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// A pulse or a pause shorter than this is none: the thread needs as long to be woken.
constexpr std::int64_t kShortest_ns = 20'000;

Error error_of(int status) { return status == -ENODEV ? Error::kDisconnected : Error::kIo; }

/// Goes off once after `ns`, and then each `every_ns` unless that is 0.
void set_timer(int timer, std::int64_t ns, std::int64_t every_ns) {
  itimerspec spec{};
  spec.it_value.tv_sec = static_cast<time_t>(ns / kSecond_ns);
  spec.it_value.tv_nsec = static_cast<long>(ns % kSecond_ns);
  spec.it_interval.tv_sec = static_cast<time_t>(every_ns / kSecond_ns);
  spec.it_interval.tv_nsec = static_cast<long>(every_ns % kSecond_ns);
  timerfd_settime(timer, 0, &spec, nullptr);
}

/// Waits for it; gives how often it went off since the last time.
std::uint64_t wait_for_timer(int timer) {
  std::uint64_t times = 0;
  while (read(timer, &times, sizeof times) < 0 && errno == EINTR) {
  }
  return times;
}

}  // namespace

GpioDimmer::GpioDimmer(GpioSettings settings, std::unique_ptr<LineBank> bank)
    : settings_(std::move(settings)), bank_(std::move(bank)) {}

Result<void> GpioDimmer::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  std::string what;
  message_.clear();
  if (const auto opened = bank_->open(settings_.bank, what); !opened) {
    message_ = "lamp on " + settings_.bank.chip + ": " + what;
    return Unexpected(Error::kIo);
  }
  level_permille_ = 0;
  wanted_permille_ = 0;
  status_ = 0;
  lit_ = false;
  darkened_ = false;
  if (pulsed()) {
    period_timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC);
    pulse_timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC);
    if (period_timer_ < 0 || pulse_timer_ < 0) {
      message_ = "lamp on " + settings_.bank.chip + ": the system has no timers left";
      close(period_timer_);
      close(pulse_timer_);
      bank_->close();
      return Unexpected(Error::kIo);
    }
    stopping_ = false;
    thread_ = std::thread([this] { pulse(); });
  }
  started_ = true;
  return {};
}

void GpioDimmer::stop() {
  if (!started_) {
    return;
  }
  started_ = false;
  level_permille_ = 0;
  if (pulsed()) {
    stopping_ = true;
    thread_.join();
    close(period_timer_);
    close(pulse_timer_);
  }
  static_cast<void>(bank_->set(0));
  bank_->close();
}

/// The first k of n lines, k the nearest to the level.
std::uint32_t GpioDimmer::steps_of(std::int32_t permille) const {
  const auto lines = static_cast<std::int32_t>(settings_.bank.lines.size());
  const std::int32_t lit =
      (permille * lines + hal::kFullLevel_permille / 2) / hal::kFullLevel_permille;
  return (std::uint32_t{1} << lit) - 1;
}

Result<void> GpioDimmer::set_level(std::int32_t permille) {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  if (permille < 0 || permille > hal::kFullLevel_permille) {
    return Unexpected(Error::kOutOfRange);
  }
  wanted_permille_ = permille;
  if (permille == 0 && pulsed()) {
    // At once, whatever the thread is at: it may be the last thing that the program does.
    static_cast<void>(bank_->set(0));
    darkened_ = true;
  }
  const int status = pulsed() ? status_.exchange(0) : bank_->set(steps_of(permille));
  if (status != 0) {
    return Unexpected(error_of(status));
  }
  level_permille_ = permille;
  return {};
}

/// A change that was refused is tried again at the next tick.
void GpioDimmer::set_line(bool lit) {
  const int status = bank_->set(lit ? 1 : 0);
  if (status == 0) {
    lit_ = lit;
  } else {
    status_ = status;
  }
}

/// The pulses begin at the ticks of a timer that the kernel keeps, so that no delay adds up.
void GpioDimmer::pulse() {
  if (settings_.priority > 0) {
    sched_param wanted{};
    wanted.sched_priority = settings_.priority;
    prioritised_ = sched_setscheduler(0, SCHED_FIFO, &wanted) == 0;
  }
  const std::int64_t period_ns = kSecond_ns / settings_.frequency_hz;
  set_timer(period_timer_, period_ns, period_ns);
  while (!stopping_) {
    const std::uint64_t ticks = wait_for_timer(period_timer_);
    late_ += ticks > 1 ? static_cast<std::int64_t>(ticks) - 1 : 0;
    const std::int64_t lit_ns = period_ns * wanted_permille_ / hal::kFullLevel_permille;
    const bool on = lit_ns >= kShortest_ns;
    if (darkened_.exchange(false) || on != lit_) {
      set_line(on);
    }
    if (on && lit_ns <= period_ns - kShortest_ns) {
      set_timer(pulse_timer_, lit_ns, 0);
      static_cast<void>(wait_for_timer(pulse_timer_));
      set_line(false);
    }
  }
}

}  // namespace tubesight::drivers
