#include "drivers/ffmpeg/ffmpeg_words.h"

#include <utility>

namespace tubesight::drivers {
namespace {

constexpr std::size_t kLongestLine = 1000;
constexpr std::size_t kLongestText = 300;

/// "[h264 @ 0x5581d0c0] error while decoding" -> "error while decoding"
std::string_view without_object(std::string_view line) {
  while (line.starts_with('[')) {
    const std::size_t end = line.find("] ");
    if (end == std::string_view::npos ||
        line.substr(0, end).find(" @ 0x") == std::string_view::npos) {
      break;
    }
    line.remove_prefix(end + 2);
  }
  return line;
}

std::string_view without_file(std::string_view line, const std::string& file) {
  for (const std::string& prefix : {"file:" + file + ": ", file + ": "}) {
    if (line.starts_with(prefix)) {
      line.remove_prefix(prefix.size());
    }
  }
  return line;
}

}  // namespace

void FfmpegWords::take(std::string_view part) {
  for (const char c : part) {
    if (c == '\n' || c == '\r') {
      end_line();
    } else if (line_.size() < kLongestLine) {
      const bool control = static_cast<unsigned char>(c) < 0x20U || c == 0x7F;
      line_ += control ? '?' : c;
    }
  }
}

void FfmpegWords::end_line() {
  if (!line_.empty()) {
    last_ = std::exchange(line_, {});
    if (first_.empty()) {
      first_ = last_;
    }
  }
}

std::string FfmpegWords::in_one_line(const std::string& file) const {
  FfmpegWords whole = *this;
  whole.end_line();
  const std::string_view first = without_file(without_object(whole.first_), file);
  const std::string_view last = without_file(without_object(whole.last_), file);
  if (first.find("matches no streams") != std::string_view::npos) {
    return "it holds no picture";
  }
  std::string text(first);
  if (last != first) {
    text += "; ";
    text += last;
  }
  return text.substr(0, kLongestText);
}

}  // namespace tubesight::drivers
