#include "board/bench/input/recording_input.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <system_error>
#include <utility>

#include "board/bench/input/read_ahead_source.h"
#include "drivers/ffmpeg/ffmpeg_decoder.h"
#include "drivers/ffmpeg/video_length.h"
#include "drivers/files/byte_source.h"
#include "drivers/files/decimal.h"
#include "drivers/files/small_letters.h"

namespace tubesight::board {
namespace {

using core::Result;
using core::Unexpected;

/// Endings of videos, small letters.
constexpr std::array<std::string_view, 20> kVideoEndings = {
    ".y4m", ".y4m.xz", ".mp4",  ".m4v", ".mkv", ".mov", ".avi", ".webm", ".mpg",   ".mpeg",
    ".ts",  ".mts",    ".m2ts", ".wmv", ".ogv", ".dv",  ".mxf", ".mjpg", ".mjpeg", ".flv"};

bool is_y4m_name(std::string_view name) {
  return name.ends_with(".y4m") || name.ends_with(".y4m.xz");
}

constexpr std::string_view kY4m = "YUV4MPEG2";
constexpr std::string_view kXz(
    "\xFD"
    "7zXZ\0",
    6);

/// The first bytes of a file, as many as kY4m has; none when it cannot be read.
std::optional<std::string> first_bytes(const std::string& path) {
  std::unique_ptr<drivers::ByteSource> source;
  std::string ignored;
  if (!drivers::open_file(path, source, ignored)) {
    return std::nullopt;
  }
  std::array<char, kY4m.size()> first{};
  const auto count = source->read(std::as_writable_bytes(std::span(first)));
  return count ? std::optional(std::string(first.data(), *count)) : std::nullopt;
}

/// Whether the first bytes are those of a recording of ours, or cannot be read: then the reader
/// says why.
bool begins_as_y4m(const std::string& path) {
  const auto first = first_bytes(path);
  return !first || *first == kY4m || first->starts_with(kXz);
}

Result<void> open_video(const std::string& path, std::unique_ptr<drivers::FfmpegDecoder>& source,
                        std::string& message) {
  std::string why;
  auto opened = drivers::FfmpegDecoder::open(path, why);
  if (!opened) {
    message = path + ": cannot be read: " + why;
    return Unexpected(opened.error());
  }
  source = std::move(*opened);
  return {};
}

Result<void> open_standard_input(std::unique_ptr<drivers::ByteSource>& source,
                                 std::string& message) {
  std::string why;
  const auto opened = drivers::open_file("/dev/stdin", source, why);
  if (!opened) {
    message = "standard input: cannot be read: " + why;
  }
  return opened;
}

/// Lets a compressed file be unpacked ahead. Whatever else it is, and whatever is wrong with it, is
/// the grabber's to find.
void read_ahead(drivers::ReplayFrameGrabber& grabber, const std::string& path) {
  std::error_code ignored;
  std::unique_ptr<drivers::ByteSource> file;
  std::string why;
  if (!std::filesystem::is_regular_file(path, ignored) ||
      !first_bytes(path).value_or("").starts_with(kXz) || !drivers::open_file(path, file, why) ||
      !drivers::decompress_if_xz(file, why)) {
    return;
  }
  grabber.read_from(std::make_unique<ReadAheadSource>(std::move(file)), true);
}

}  // namespace

RecordingKind kind_of_recording(const std::string& recording) {
  if (recording == kStandardStream) {
    return RecordingKind::kStandardInput;
  }
  std::error_code ignored;
  if (is_y4m_name(recording) || !std::filesystem::is_regular_file(recording, ignored) ||
      begins_as_y4m(recording)) {
    return RecordingKind::kY4m;
  }
  return RecordingKind::kVideo;
}

bool is_named_as_recording(std::string_view file) {
  const std::string name = drivers::small_letters(file);
  return std::any_of(kVideoEndings.begin(), kVideoEndings.end(),
                     [&](std::string_view ending) { return name.ends_with(ending); });
}

Result<void> feed(drivers::ReplayFrameGrabber& grabber, const std::string& recording,
                  bool ignore_scan_flag, std::string& message) {
  if (ignore_scan_flag) {
    grabber.ignore_scan_flag();
  }
  switch (kind_of_recording(recording)) {
    case RecordingKind::kY4m: read_ahead(grabber, recording); return {};
    case RecordingKind::kStandardInput: {
      std::unique_ptr<drivers::ByteSource> source;
      TUBESIGHT_TRY(open_standard_input(source, message));
      grabber.read_from(std::move(source), false);
      return {};
    }
    case RecordingKind::kVideo: break;
  }
  std::unique_ptr<drivers::FfmpegDecoder> source;
  TUBESIGHT_TRY(open_video(recording, source, message));
  grabber.read_from(std::unique_ptr<drivers::StampedSource>(std::move(source)));
  return {};
}

bool start(drivers::ReplayFrameGrabber& grabber, drivers::Messages& messages) {
  const bool started = static_cast<bool>(grabber.start());
  messages.insert(messages.end(), grabber.messages().begin(), grabber.messages().end());
  if (grabber.scan_disagrees()) {
    messages.back() += kScanFlagWayOut;
  }
  return started;
}

std::string how_read(const std::string& recording, const drivers::Y4mHeader& header) {
  const bool standard_input = recording == kStandardStream;
  std::string text = (standard_input ? "standard input" : recording) + ": ";
  drivers::print(text, "%d x %d pixels, %d bits", header.width_px, header.height_px,
                 header.depth_bits);
  switch (header.interlacing) {
    case drivers::Y4mInterlacing::kUnstated: break;
    case drivers::Y4mInterlacing::kProgressive: text += ", progressive"; break;
    case drivers::Y4mInterlacing::kEvenFirst: text += ", even lines first"; break;
    case drivers::Y4mInterlacing::kOddFirst: text += ", odd lines first"; break;
  }
  if (header.rate_numerator > 0) {
    drivers::print(
        text, ", %.3f frames a second",
        static_cast<double>(header.rate_numerator) / static_cast<double>(header.rate_denominator));
  }
  const bool by_ffmpeg = !standard_input && kind_of_recording(recording) == RecordingKind::kVideo;
  return text + (by_ffmpeg ? ", read through ffmpeg" : ", read by itself");
}

std::optional<double> told_length_s(const std::string& recording) {
  return kind_of_recording(recording) == RecordingKind::kVideo ? drivers::video_length_s(recording)
                                                               : std::nullopt;
}

Result<void> open_frames(drivers::Y4mReader& reader, const std::string& recording,
                         std::string& message) {
  if (kind_of_recording(recording) == RecordingKind::kVideo) {
    return open_foreign_still(reader, recording, message);
  }
  const auto opened = reader.open(recording);
  if (!opened) {
    message = reader.message();
  }
  return opened;
}

Result<void> open_foreign_still(drivers::Y4mReader& reader, const std::string& still,
                                std::string& message) {
  std::unique_ptr<drivers::FfmpegDecoder> source;
  TUBESIGHT_TRY(open_video(still, source, message));
  const auto opened = reader.open(std::move(source), still);
  if (!opened) {
    message = reader.message();
  }
  return opened;
}

}  // namespace tubesight::board
