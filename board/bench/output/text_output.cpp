#include "board/bench/output/text_output.h"

#include <array>
#include <cstdarg>
#include <cstdio>

namespace tubesight::board {

void tell(const std::string& message) { std::fprintf(stderr, "%s\n", message.c_str()); }

void tell(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    tell(message);
  }
}

bool write_out(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0) {
    std::perror("standard output: cannot be written");
    return false;
  }
  return true;
}

void print(std::string& out, const char* format, ...) {
  std::array<char, 500> text{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  out += text.data();
}

}  // namespace tubesight::board
