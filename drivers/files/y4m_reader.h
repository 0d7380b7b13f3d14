#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "drivers/files/byte_source.h"
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

  /// Frames read completely so far.
  [[nodiscard]] std::int64_t frames_read() const { return frames_read_; }

  /// Reads the next frame's luma, line by line without padding, into header().luma_bytes() bytes.
  ///
  /// Errors: kEndOfData no more frames, kDataLoss the recording is cut short (the frames before are
  /// sound), kIo reading failed or the data is corrupt (the frames before are not to be trusted
  /// when the file is compressed), kNotReady not opened, kBufferTooSmall. Once failed it stays
  /// failed.
  [[nodiscard]] core::Result<void> read_frame(std::span<std::uint8_t> luma);

  /// The last failure in one line.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  core::Result<void> fail(core::Error error, const std::string& text);
  core::Result<void> fail_read(core::Error error);
  core::Result<void> fail_cut_short();
  core::Result<bool> fill();
  core::Result<void> read_line(std::string_view& line, bool& at_end);
  core::Result<void> read_bytes(std::int64_t count, std::uint8_t* into);

  std::unique_ptr<ByteSource> source_;
  std::string name_;
  std::string message_;
  Y4mHeader header_;
  std::int64_t frames_read_ = 0;
  std::vector<std::byte> buffer_;
  std::size_t buffer_begin_ = 0;
  std::size_t buffer_end_ = 0;
  std::vector<char> line_;
  core::Error failure_ = core::Error::kNotReady;
  bool failed_ = true;
};

}  // namespace tubesight::drivers
