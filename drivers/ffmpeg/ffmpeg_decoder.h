#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "drivers/ffmpeg/child_process.h"
#include "drivers/ffmpeg/ffmpeg_words.h"
#include "drivers/ffmpeg/frame_stamps.h"
#include "drivers/files/stamped_source.h"

namespace tubesight::drivers {

/// Any video or still that ffmpeg reads, as a YUV4MPEG2 recording of its first video stream in
/// grey.
///
/// ffmpeg runs in a process of its own and no faster than it is read: what waits is a pipe's worth,
/// and the picture after a frame whose stamp comes late, as ffmpeg may not write it before.
/// The pixels are those of `ffmpeg -i VIDEO -pix_fmt gray -strict -1 out.y4m`, in 9 to 16 bits
/// where the video has more than 8; frames are neither doubled nor dropped to even out the rate.
/// The first error in decoding ends it: what a decoder makes up in place of damaged pictures is not
/// delivered.
class FfmpegDecoder final : public StampedSource {
 public:
  /// Starts to read the file `path`, whatever its name looks like. Errors: kUnsupported ffmpeg is
  /// not installed, kIo the file cannot be read or ffmpeg not be started; `message` says why
  /// without the file's name.
  [[nodiscard]] static core::Result<std::unique_ptr<FfmpegDecoder>> open(const std::string& path,
                                                                         std::string& message);

  /// Beside the errors of the interface: kDisconnected ffmpeg reported an error.
  [[nodiscard]] core::Result<std::size_t> read(std::span<std::byte> into) override;
  [[nodiscard]] const std::string& message() const override { return message_; }

  [[nodiscard]] std::optional<FrameStamp> next_stamp() override;

 private:
  FfmpegDecoder() = default;

  enum class Awaited : unsigned char { kPicture, kNotes, kEnd };
  bool wait_for(Awaited what);
  void read_ahead();
  core::Result<std::size_t> finish();

  ChildProcess ffmpeg_;
  FfmpegWords words_;
  FrameStamps stamps_;
  std::vector<std::byte> ahead_;  ///< of the pictures, read while a stamp was waited for
  std::size_t ahead_given_ = 0;   ///< of it
  std::int64_t late_stamps_ = 0;  ///< of frames before, that will still come
  bool pictures_open_ = true;
  bool words_open_ = true;
  bool notes_open_ = true;
  bool ended_ = false;
  std::string message_;
};

}  // namespace tubesight::drivers
