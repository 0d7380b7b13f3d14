#include "drivers/files/y4m_reader.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::size_t kBufferBytes = 65536;
/// Real header lines are below 100 bytes; comments (X...) may make them longer.
constexpr std::size_t kLongestLine = 4096;

}  // namespace

Result<void> Y4mReader::open(const std::string& path) {
  std::unique_ptr<ByteSource> source;
  name_ = path;
  std::string why;
  if (const auto opened = open_file(path, source, why); !opened) {
    return fail(opened.error(), "cannot be read: " + why);
  }
  return open(std::move(source), path);
}

Result<void> Y4mReader::open(std::unique_ptr<ByteSource> source, std::string name) {
  name_ = std::move(name);
  header_ = {};
  frames_read_ = 0;
  buffer_.resize(kBufferBytes);
  buffer_begin_ = 0;
  buffer_end_ = 0;
  line_.resize(kLongestLine);
  source_ = std::move(source);
  std::string why;
  if (const auto prepared = decompress_if_xz(source_, why); !prepared) {
    return fail(prepared.error(), "cannot be read: " + why);
  }
  std::string_view line;
  bool at_end = false;
  TUBESIGHT_TRY(read_line(line, at_end));
  const auto header = parse_y4m_header(line, why);
  if (!header) {
    return fail(header.error(), why);
  }
  if (at_end) {
    return fail(Error::kDataLoss, "cut short within its header");
  }
  header_ = *header;
  message_.clear();
  failed_ = false;
  return {};
}

Result<void> Y4mReader::read_frame(std::span<std::uint8_t> luma) {
  if (failed_) {
    return Unexpected(failure_);
  }
  if (std::cmp_less(luma.size(), header_.luma_bytes())) {
    return Unexpected(Error::kBufferTooSmall);
  }
  std::string_view line;
  bool at_end = false;
  TUBESIGHT_TRY(read_line(line, at_end));
  if (at_end && line.empty()) {
    failed_ = true;
    failure_ = Error::kEndOfData;
    return Unexpected(failure_);
  }
  constexpr std::string_view kFrame = "FRAME";
  if (at_end && kFrame.starts_with(line.substr(0, kFrame.size()))) {
    return fail_cut_short();
  }
  if (!line.starts_with(kFrame) || (line.size() > kFrame.size() && line[kFrame.size()] != ' ')) {
    return fail(Error::kIo, "corrupt after " + std::to_string(frames_read_) +
                                " frames: expected a line that begins with 'FRAME'");
  }
  TUBESIGHT_TRY(read_bytes(header_.luma_bytes(), luma.data()));
  TUBESIGHT_TRY(read_bytes(header_.chroma_bytes, nullptr));
  ++frames_read_;
  return {};
}

Result<void> Y4mReader::fail(Error error, const std::string& text) {
  failed_ = true;
  failure_ = error;
  message_ = name_ + ": " + text;
  return Unexpected(error);
}

Result<void> Y4mReader::fail_cut_short() {
  return fail(Error::kDataLoss,
              frames_read_ == 0
                  ? "cut short within its first frame"
                  : "cut short: only its first " + std::to_string(frames_read_) +
                        (frames_read_ == 1 ? " frame is complete" : " frames are complete"));
}

Result<void> Y4mReader::fail_read(Error error) {
  if (error == Error::kDataLoss) {
    return fail_cut_short();
  }
  return fail(error, "cannot be read after " + std::to_string(frames_read_) +
                         " frames: " + source_->message());
}

/// Refills the empty buffer; false at the end.
Result<bool> Y4mReader::fill() {
  const auto count = source_->read(buffer_);
  if (!count) {
    return Unexpected(fail_read(count.error()).error());
  }
  buffer_begin_ = 0;
  buffer_end_ = *count;
  return *count > 0;
}

/// Reads up to and without the next line feed; `at_end` when the data ended before one.
Result<void> Y4mReader::read_line(std::string_view& line, bool& at_end) {
  std::size_t length = 0;
  at_end = false;
  while (true) {
    if (buffer_begin_ == buffer_end_) {
      const auto more = fill();
      if (!more) {
        return Unexpected(more.error());
      }
      if (!*more) {
        at_end = true;
        break;
      }
    }
    const char c = static_cast<char>(buffer_[buffer_begin_++]);
    if (c == '\n') {
      break;
    }
    if (length == kLongestLine) {
      // Hundreds of pixels without a line feed: let the caller say what it expected instead.
      break;
    }
    line_[length++] = c;
  }
  line = {line_.data(), length};
  return {};
}

/// Reads `count` bytes into `into`, or passes them over when that is null.
Result<void> Y4mReader::read_bytes(std::int64_t count, std::uint8_t* into) {
  while (count > 0) {
    if (buffer_begin_ == buffer_end_) {
      const auto more = fill();
      if (!more) {
        return Unexpected(more.error());
      }
      if (!*more) {
        return fail_cut_short();
      }
    }
    const auto ready = static_cast<std::int64_t>(buffer_end_ - buffer_begin_);
    const std::int64_t part = std::min(count, ready);
    if (into != nullptr) {
      std::memcpy(into, buffer_.data() + buffer_begin_, static_cast<std::size_t>(part));
      into += part;
    }
    buffer_begin_ += static_cast<std::size_t>(part);
    count -= part;
  }
  return {};
}

}  // namespace tubesight::drivers
