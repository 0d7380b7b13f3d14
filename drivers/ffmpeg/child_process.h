#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

#include "core/base/result.h"

namespace tubesight::drivers {

/// A program that runs in a process of its own, spoken to through pipes.
///
/// It is started without a shell, gets no file of ours beside its pipes, is killed when the thread
/// that started it ends, and leaves no zombie: destruction kills and reaps it. Everything blocks
/// until the program answers; one thread uses an object.
class ChildProcess {
 public:
  /// What the program's descriptors are; 1 and 2 are always pipes to us.
  struct Pipes {
    bool input = false;  ///< 0 is a pipe from us; else it is /dev/null
    bool notes = false;  ///< 3 is a pipe to us; else it is closed
    int file = -1;       ///< of ours, is 4 there: `/dev/fd/4`; -1: none
  };

  ChildProcess() = default;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess() { end(); }

  /// Starts `arguments[0]`, which is looked for in PATH, with these arguments. Errors: kUnsupported
  /// there is no such program, kIo the system refused (errno tells), kNotReady one runs already.
  [[nodiscard]] core::Result<void> start(const std::vector<std::string>& arguments, Pipes pipes);

  /// Our ends of its pipes; -1: none, or closed.
  [[nodiscard]] int output() const { return output_; }
  [[nodiscard]] int errors() const { return errors_; }
  [[nodiscard]] int notes() const { return notes_; }

  /// Writes to its standard input. False when it no longer reads; no signal is raised then.
  [[nodiscard]] bool write(std::span<const std::byte> bytes);
  /// Closes its standard input: it reads the end.
  void close_input();
  /// Closes our end of its standard output.
  void close_output();

  /// Waits for its end, and gives its exit status; 128 + N when signal N ended it.
  [[nodiscard]] int wait();

  /// Kills it if it still runs, reaps it and closes all pipes.
  void end();

 private:
  pid_t process_ = -1;  ///< -1: none, or reaped
  int status_ = 0;      ///< of the one that was reaped
  int input_ = -1;
  int output_ = -1;
  int errors_ = -1;
  int notes_ = -1;
};

}  // namespace tubesight::drivers
