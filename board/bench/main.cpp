#include <csignal>
#include <cstdio>
#include <exception>

#include "board/bench/command_line.h"
#include "board/bench/interruption.h"

int main(int argc, char** argv) {
  using tubesight::board::ExitStatus;
  // A reader that goes away is told as a failed write, not by the end of the program.
  std::signal(SIGPIPE, SIG_IGN);
  // So is a file that grows beyond what the system allows.
  std::signal(SIGXFSZ, SIG_IGN);
  tubesight::board::remove_unfinished_when_interrupted();
  ExitStatus status = ExitStatus::kJobFailed;
  try {
    status = tubesight::board::run_command_line(argc, argv);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "tubesight: stopped: %s\n", problem.what());
  }
  // What fills the buffer may have failed before, and left nothing to flush.
  const bool unsaid = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (unsaid && status == ExitStatus::kDone) {
    std::perror("standard output: cannot be written");
    status = ExitStatus::kJobFailed;
  }
  return static_cast<int>(status);
}
