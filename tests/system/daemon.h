#pragma once

#include <chrono>
#include <string>
#include <vector>

#include <sys/types.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::tests {

/// For what comes at once on an idle machine, and must not fail on a busy one.
inline constexpr std::chrono::milliseconds kLong = std::chrono::seconds(20);

[[nodiscard]] inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What a run of a program left.
struct Answered {
  int status = -1;  ///< exit status; -1 when it was ended by a signal
  std::string out;
  std::string err;
};

/// Runs a program to its end, in the emulator where it is built for another machine.
[[nodiscard]] Answered run_program(const std::string& program,
                                   const std::vector<std::string>& arguments);

/// tubesightd in a folder of its own, with `box.toml` there and the socket `box`.
class Daemon {
 public:
  Daemon() = default;
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;
  ~Daemon();

  /// A box on the shipped recording; `more` are lines of [source].
  void write_settings(const std::string& more) const;

  /// A box on the scenario of the first run in docs/ with the search window alone drawn, which is
  /// cheap and shows no poses; or on another one, as it stands.
  void write_simulated_settings(const std::string& more, std::string scenario = {}) const;

  void start();
  /// Starts and waits until it answers.
  [[nodiscard]] bool start_and_wait();
  void signal(int number) const;
  [[nodiscard]] pid_t process() const { return process_; }
  /// Waits for its end; the exit status, -1 for a signal, -2 when it goes on.
  [[nodiscard]] int wait_for_end(std::chrono::milliseconds timeout);

  /// tubesightctl with these arguments.
  [[nodiscard]] Answered ask(std::vector<std::string> arguments) const;
  /// Asks `status --json` until it has this part; the last answer.
  [[nodiscard]] std::string wait_for(const std::string& part,
                                     std::chrono::milliseconds timeout) const;

  [[nodiscard]] std::string socket() const { return folder_.path("box"); }
  [[nodiscard]] std::string settings() const { return folder_.path("box.toml"); }
  [[nodiscard]] std::string said() const { return folder_.read("said"); }
  [[nodiscard]] const support::TemporaryFolder& folder() const { return folder_; }

 private:
  support::TemporaryFolder folder_;
  pid_t process_ = -1;
};

}  // namespace tubesight::tests
