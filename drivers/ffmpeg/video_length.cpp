#include "drivers/ffmpeg/video_length.h"

#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "drivers/ffmpeg/child_process.h"

namespace tubesight::drivers {
namespace {

constexpr int kAnswer_ms = 3000;  ///< with each part of its answer
constexpr int kMostParts = 4;

/// What the program writes until it ends; empty where it takes too long or writes too much.
std::string answer_of(const ChildProcess& process) {
  std::string text;
  for (int part = 0; part < kMostParts; ++part) {
    pollfd pipe{process.output(), POLLIN, 0};
    std::array<char, 256> bytes{};
    const bool ready = ::poll(&pipe, 1, kAnswer_ms) > 0;
    const ssize_t count = ready ? ::read(process.output(), bytes.data(), bytes.size()) : -1;
    if (count < 0) {
      return {};
    }
    if (count == 0) {
      return text;
    }
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return {};
}

}  // namespace

std::optional<double> video_length_s(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return {};
  }
  ChildProcess ffprobe;
  // The file is opened by us, for the reasons of FfmpegDecoder.
  const auto started =
      ffprobe.start({"ffprobe", "-hide_banner", "-loglevel", "quiet", "-protocol_whitelist",
                     "file,pipe", "-show_entries", "format=duration", "-of",
                     "default=noprint_wrappers=1:nokey=1", "file:/dev/fd/4"},
                    {.input = false, .notes = false, .file = file});
  ::close(file);
  if (!started) {
    return {};
  }
  const std::string text = answer_of(ffprobe);
  double length_s = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), length_s);
  const bool whole = rest == text.data() + text.size() || *rest == '\n';
  return error == std::errc() && whole && length_s > 0.0 ? std::optional(length_s) : std::nullopt;
}

}  // namespace tubesight::drivers
