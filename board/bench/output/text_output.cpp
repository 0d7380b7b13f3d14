#include "board/bench/output/text_output.h"

#include <cstdio>

#include "board/bench/output/progress_line.h"
#include "drivers/files/commit_together.h"

namespace tubesight::board {
namespace {

Talk how_much = Talk::kUsual;

}  // namespace

void set_talk(Talk talk) { how_much = talk; }

Talk talk() { return how_much; }

void tell(const std::string& message) {
  ProgressLine::erase_shown();
  std::fprintf(stderr, "%s\n", message.c_str());
}

void tell(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    tell(message);
  }
}

void tell_more(const std::string& message) {
  if (how_much == Talk::kVerbose) {
    tell(message);
  }
}

void tell_files(const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) {
    text += text.empty() ? file + ": read" : (&file == &files[1] ? ", with " : ", ") + file;
  }
  tell_more(text);
}

bool write_out(const std::string& text, bool taken) {
  ProgressLine::erase_shown();
  if (how_much == Talk::kQuiet) {
    return true;
  }
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
