#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/image_view.h"
#include "core/base/result.h"
#include "drivers/ffmpeg/child_process.h"
#include "drivers/files/atomic_file.h"

namespace tubesight::drivers {

/// Writes a colour video through ffmpeg; it appears under its name only when finished.
///
/// H.264, which players show: 4:2:0, sides of odd length are padded by one black line. Errors leave
/// one line in message().
class FfmpegEncoder {
 public:
  FfmpegEncoder() = default;
  FfmpegEncoder(const FfmpegEncoder&) = delete;
  FfmpegEncoder& operator=(const FfmpegEncoder&) = delete;
  ~FfmpegEncoder() = default;

  /// Whether a name ends as those that are encoded: .mp4, .mkv or .mov, in any case.
  [[nodiscard]] static bool encodes(std::string_view path);

  /// Begins `path`, a regular file or none yet, with the rate numerator / denominator frames a
  /// second. Errors: kUnsupported ffmpeg is not installed, kIo.
  [[nodiscard]] core::Result<void> open(const std::string& path, std::int64_t rate_numerator,
                                        std::int64_t rate_denominator);

  /// Appends a frame; all are of the first one's size. Waits until ffmpeg has taken it. Errors:
  /// kIo, kNotReady not open, kInvalidArgument another size.
  [[nodiscard]] core::Result<void> write_frame(const core::RgbImageView& rgb);

  /// Finishes the video. Errors: kIo (also when it has no frame), kNotReady.
  [[nodiscard]] core::Result<void> commit();

  /// The last failure, beginning with the file's name.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  core::Result<void> begin(const core::RgbImageView& first);
  core::Result<void> fail(core::Error error, const std::string& what);
  core::Result<void> fail_by_ffmpeg();

  std::string path_;
  AtomicFile file_;  ///< holds the place; ffmpeg writes into it
  std::string rate_;
  ChildProcess ffmpeg_;
  std::int32_t width_px_ = 0;  ///< 0: no frame yet
  std::int32_t height_px_ = 0;
  std::string message_;
};

}  // namespace tubesight::drivers
