#include "drivers/ffmpeg/ffmpeg_encoder.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

#include <sys/stat.h>
#include <unistd.h>

#include "drivers/ffmpeg/ffmpeg_words.h"
#include "drivers/files/commit_together.h"
#include "drivers/files/small_letters.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Name's ending and ffmpeg's muxer for it.
struct Container {
  std::string_view ending;
  const char* muxer;
};
constexpr std::array kContainers = {
    Container{".mp4", "mp4"},
    Container{".mkv", "matroska"},
    Container{".mov", "mov"},
};

const Container* container_of(std::string_view path) {
  const std::string name = small_letters(path);
  for (const Container& container : kContainers) {
    if (name.size() > container.ending.size() && name.ends_with(container.ending)) {
      return &container;
    }
  }
  return nullptr;
}

}  // namespace

bool FfmpegEncoder::encodes(std::string_view path) { return container_of(path) != nullptr; }

Result<void> FfmpegEncoder::open(const std::string& path, std::int64_t rate_numerator,
                                 std::int64_t rate_denominator) {
  ffmpeg_.end();
  path_ = path;
  width_px_ = 0;
  height_px_ = 0;
  rate_ = std::to_string(rate_numerator) + "/" + std::to_string(rate_denominator);
  // That it is there is found out now, not after the first field.
  if (const auto there = ffmpeg_.start({"ffmpeg", "-loglevel", "quiet", "-version"}, {}); !there) {
    return fail(there.error(),
                there.error() == Error::kUnsupported
                    ? "cannot be encoded: " + std::string(kNoFfmpeg)
                    : std::string("ffmpeg cannot be started: ") + std::strerror(errno));
  }
  ffmpeg_.end();
  if (struct stat status{}; ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    return fail(Error::kIo, "is no file, expected one: an encoded video is written to and fro");
  }
  if (const auto opened = file_.open(path); !opened) {
    message_ = file_.message();
    return opened;
  }
  return {};
}

Result<void> FfmpegEncoder::begin(const core::RgbImageView& first) {
  width_px_ = first.width_px;
  height_px_ = first.height_px;
  const std::string size = std::to_string(width_px_) + "x" + std::to_string(height_px_);
  const auto started = ffmpeg_.start({"ffmpeg",    "-hide_banner",
                                      "-loglevel", "error",
                                      "-f",        "rawvideo",
                                      "-pix_fmt",  "rgb24",
                                      "-s",        size,
                                      "-r",        rate_,
                                      "-i",        "pipe:0",
                                      "-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                      "-c:v",      "libx264",
                                      "-preset",   "veryfast",
                                      "-crf",      "18",
                                      "-pix_fmt",  "yuv420p",
                                      "-f",        container_of(path_)->muxer,
                                      "-y",        "file:" + file_.temporary()},
                                     {.input = true, .notes = false});
  return started ? Result<void>()
                 : fail(started.error(),
                        std::string("ffmpeg cannot be started: ") + std::strerror(errno));
}

Result<void> FfmpegEncoder::write_frame(const core::RgbImageView& rgb) {
  if (!file_.is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (width_px_ == 0) {
    TUBESIGHT_TRY(begin(rgb));
  }
  if (rgb.width_px != width_px_ || rgb.height_px != height_px_) {
    return fail(Error::kInvalidArgument, "cannot be written: its pictures differ in size");
  }
  for (std::int32_t line = 0; line < height_px_; ++line) {
    const std::uint8_t* const pixels = rgb.pixels + std::ptrdiff_t{line} * rgb.stride_bytes;
    const std::span<const std::uint8_t> row(pixels, 3 * static_cast<std::size_t>(width_px_));
    if (!ffmpeg_.write(std::as_bytes(row))) {
      return fail_by_ffmpeg();
    }
  }
  return {};
}

Result<void> FfmpegEncoder::commit() {
  if (!file_.is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (width_px_ == 0) {
    return fail(Error::kIo, "cannot be written: it has no picture");
  }
  ffmpeg_.close_input();
  ffmpeg_.close_output();
  if (const auto said = fail_by_ffmpeg(); !said) {
    return said;
  }
  if (const auto committed = file_.commit(); !committed) {
    message_ = file_.message();
    return committed;
  }
  return {};
}

Result<void> FfmpegEncoder::fail(Error error, const std::string& what) {
  message_ = path_ + ": " + what;
  CommitTogether::fail_current();
  return Unexpected(error);
}

/// Waits for its end; well when it ended well.
Result<void> FfmpegEncoder::fail_by_ffmpeg() {
  FfmpegWords words;
  std::array<char, 4096> part{};
  while (true) {
    const ssize_t count = ::read(ffmpeg_.errors(), part.data(), part.size());
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count <= 0) {
      break;
    }
    words.take(std::string_view(part.data(), static_cast<std::size_t>(count)));
  }
  const int status = ffmpeg_.wait();
  if (status == 0) {
    return {};
  }
  return fail(Error::kIo, "cannot be encoded: ffmpeg: " +
                              (words.empty() ? "ended with status " + std::to_string(status)
                                             : words.in_one_line(file_.temporary())));
}

}  // namespace tubesight::drivers
