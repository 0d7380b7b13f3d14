#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "drivers/files/byte_source.h"
#include "drivers/files/frame_line_search.h"
#include "drivers/files/y4m_header.h"

namespace tubesight::drivers {

/// Reads a YUV4MPEG2 recording frame by frame, plain or compressed by xz.
///
/// Only the luma plane is delivered. All memory is obtained in open() and by the first
/// read_frame(). Every failure leaves one line in message() that begins with the recording's name.
class Y4mReader {
 public:
  /// Opens the file `path` and reads its header.
  ///
  /// Errors: kIo the file cannot be read or its compression is corrupt, kDataLoss it ends within
  /// the header, kInvalidArgument and kUnsupported as parse_y4m_header().
  [[nodiscard]] core::Result<void> open(const std::string& path);

  /// The same from any source; `name` stands in for the path in messages.
  [[nodiscard]] core::Result<void> open(std::unique_ptr<ByteSource> source, std::string name);

  /// The header of the opened recording.
  [[nodiscard]] const Y4mHeader& header() const { return header_; }

  /// As ByteSource::share_read(), of the opened recording.
  [[nodiscard]] double share_read() const { return source_ ? source_->share_read() : -1.0; }

  /// Frames read completely so far.
  [[nodiscard]] std::int64_t frames_read() const { return frames_read_; }

  /// Reads the next frame's luma, line by line without padding, into header().luma_bytes() bytes;
  /// of samples with more than 8 bits the upper 8.
  ///
  /// Errors: kEndOfData no more frames, kDataLoss the recording is cut short, or bytes follow its
  /// last complete frame among which no further one begins (the frames before are sound), kIo
  /// reading failed or the data is corrupt, as more frames follow (the frames before are not to be
  /// trusted), kInvalidArgument and kUnsupported the header or a FRAME line cannot be served,
  /// kNotReady not opened, kBufferTooSmall. Once failed it stays failed.
  ///
  /// A frame is judged by what follows it, as only that shows that it has all its bytes and no
  /// more. One whose last line has one value, which garbage behind it repeats, is no complete one:
  /// file systems fill up so what was not written when the power went.
  [[nodiscard]] core::Result<void> read_frame(std::span<std::uint8_t> luma);

  /// The last failure in one line.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  enum class Ending : std::uint8_t {
    kLineFeed,
    kEndOfData,  ///< before a line feed
    kTooLong,    ///< none in as many bytes as a line may have
  };

  core::Result<void> fail(core::Error error, const std::string& text);
  core::Result<void> fail_read(core::Error error);
  core::Result<void> fail_cut_short(const std::string& what_follows = {});
  core::Result<void> fail_corrupt();
  core::Result<void> fail_misplaced(std::int64_t frame_bytes);
  core::Result<bool> fill();
  core::Result<void> read_line(std::string_view& line, Ending& ending);
  core::Result<void> read_bytes(std::int64_t count, std::uint8_t* into);
  core::Result<void> read_luma(std::span<std::uint8_t> luma);
  void note_end(std::span<const std::byte> part);
  core::Result<void> judge_what_follows();
  core::Result<void> search_rest();
  bool peek(std::string_view& ahead);

  std::unique_ptr<ByteSource> source_;
  std::string name_;
  std::string message_;
  Y4mHeader header_;
  std::int64_t frames_read_ = 0;
  std::vector<std::byte> buffer_;
  std::size_t buffer_begin_ = 0;
  std::size_t buffer_end_ = 0;
  std::vector<char> line_;
  std::vector<std::uint8_t> deep_;  ///< a luma plane of more than 8 bits
  FrameLineSearch search_;          ///< for FRAME lines within the frame read last
  std::int64_t alike_ = 0;  ///< bytes of one value at that frame's end; counted up to a line
  std::byte last_byte_{0};  ///< that value
  core::Error failure_ = core::Error::kNotReady;
  bool failed_ = true;
};

}  // namespace tubesight::drivers
