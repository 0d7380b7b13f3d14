#include "board/bench/output/text_output.h"

#include <cstdio>

#include "drivers/files/commit_together.h"

namespace tubesight::board {

void tell(const std::string& message) { std::fprintf(stderr, "%s\n", message.c_str()); }

void tell(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    tell(message);
  }
}

bool write_out(const std::string& text, bool taken) {
  if (taken) {
    std::fputs(text.c_str(), stderr);
    return true;
  }
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0) {
    std::perror("standard output: cannot be written");
    drivers::CommitTogether::fail_current();
    return false;
  }
  return true;
}

}  // namespace tubesight::board
