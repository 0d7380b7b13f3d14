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
constexpr std::size_t kLongestLine = 65536;
constexpr std::string_view kFrame = "FRAME";
constexpr std::string_view kMagic = "YUV4MPEG2 ";

bool is_frame_line(std::string_view line) {
  return line.starts_with(kFrame) && (line.size() == kFrame.size() || line[kFrame.size()] == ' ');
}

std::string count_words(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

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
  search_ = {};
  alike_ = 0;
  source_ = std::move(source);
  std::string why;
  if (const auto prepared = decompress_if_xz(source_, why); !prepared) {
    return fail(prepared.error(), "cannot be read: " + why);
  }
  std::string_view line;
  Ending ending{};
  TUBESIGHT_TRY(read_line(line, ending));
  if (ending == Ending::kTooLong && line.starts_with(kMagic)) {
    return fail(Error::kUnsupported, "header longer than " + std::to_string(kLongestLine) +
                                         " bytes, expected a line feed within them");
  }
  const auto header = parse_y4m_header(line, why);
  if (!header) {
    return fail(header.error(), why);
  }
  if (ending == Ending::kEndOfData) {
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
  Ending ending{};
  TUBESIGHT_TRY(read_line(line, ending));
  if (ending == Ending::kEndOfData) {
    if (line.empty()) {
      failed_ = true;
      failure_ = Error::kEndOfData;
      return Unexpected(failure_);
    }
    if (kFrame.starts_with(line) || is_frame_line(line)) {
      return fail_cut_short();
    }
  }
  if (!is_frame_line(line)) {
    return line == "FRAME\r" ? fail(Error::kIo, std::string(kTextModeWords)) : fail_corrupt();
  }
  if (ending == Ending::kTooLong) {
    return fail(Error::kUnsupported, "FRAME line longer than " + std::to_string(kLongestLine) +
                                         " bytes after " + std::to_string(frames_read_) +
                                         " frames");
  }
  search_ = {};
  alike_ = 0;
  TUBESIGHT_TRY(read_luma(luma));
  TUBESIGHT_TRY(read_bytes(header_.chroma_bytes, nullptr));
  ++frames_read_;
  const auto sound = judge_what_follows();
  if (!sound) {
    --frames_read_;
  }
  return sound;
}

/// Looks at what follows the frame just read: it is sound when that is a frame, the end, or bytes
/// that are no part of the recording. An error is the frame's own; one that comes after it is kept
/// for the next call.
Result<void> Y4mReader::judge_what_follows() {
  std::string_view ahead;
  if (!peek(ahead)) {
    return {};
  }
  if (kFrame.starts_with(ahead) || is_frame_line(ahead.substr(0, ahead.find('\n')))) {
    return {};
  }
  if (ahead.starts_with("FRAME\r")) {
    return fail(Error::kIo, std::string(kTextModeWords));
  }
  if (ahead.starts_with(kMagic)) {
    return fail(Error::kIo, "corrupt after " + std::to_string(frames_read_) +
                                " frames: a second header, expected one recording in a file");
  }
  const bool ends_as_tail = alike_ >= header_.width_px && std::byte(ahead.front()) == last_byte_;
  if (const auto searched = search_rest(); !searched) {
    return searched.error() == Error::kDataLoss ? Result<void>() : searched;
  }
  if (search_.found_at() >= 0) {
    return fail_misplaced(search_.found_at());
  }
  if (ends_as_tail) {
    --frames_read_;
    const auto failed = fail_cut_short(", the next ends in bytes of one value as does the file");
    ++frames_read_;
    return failed;
  }
  const std::int64_t count = search_.bytes() - header_.stored_luma_bytes() - header_.chroma_bytes;
  static_cast<void>(fail_cut_short(", the " + count_words(count, "byte", "bytes") + " behind " +
                                   (frames_read_ == 1 ? "it" : "them") +
                                   (count == 1 ? " is" : " are") + " no frame"));
  return {};
}

/// Searches all that is left for a FRAME line. The search goes on from within the frame: its end
/// and the FRAME line may be what is missing. Only at its end does a compressed recording prove
/// sound.
Result<void> Y4mReader::search_rest() {
  while (search_.found_at() < 0) {
    search_.look_through(std::span(buffer_).subspan(buffer_begin_, buffer_end_ - buffer_begin_));
    const auto more = fill();
    if (!more) {
      return Unexpected(more.error());
    }
    if (!*more) {
      break;
    }
  }
  return {};
}

Result<void> Y4mReader::fail(Error error, const std::string& text) {
  failed_ = true;
  failure_ = error;
  message_ = name_ + ": " + text;
  return Unexpected(error);
}

Result<void> Y4mReader::fail_cut_short(const std::string& what_follows) {
  if (frames_read_ == 0) {
    return search_.found_at() >= 0 ? fail_misplaced(search_.found_at())
                                   : fail(Error::kDataLoss, "cut short within its first frame");
  }
  return fail(Error::kDataLoss, "cut short: only its first " +
                                    count_words(frames_read_, "frame is", "frames are") +
                                    " complete" + what_follows);
}

Result<void> Y4mReader::fail_corrupt() {
  return fail(Error::kIo, "corrupt after " + std::to_string(frames_read_) +
                              " frames: expected a line that begins with 'FRAME'");
}

/// Tells that the next FRAME line stands elsewhere than the header says: so many bytes behind the
/// line of the frame read last.
Result<void> Y4mReader::fail_misplaced(std::int64_t frame_bytes) {
  const std::int64_t chroma_bytes = frame_bytes - header_.stored_luma_bytes();
  const std::string_view colour = y4m_colour_of(header_, chroma_bytes);
  // In later frames the place fits by chance: the frames before had the length that C says.
  if (frames_read_ > 1 || colour.empty() || chroma_bytes == header_.chroma_bytes) {
    return fail_corrupt();
  }
  const std::string says = "header parameter C is wrong: it says " +
                           std::string(y4m_colour_of(header_, header_.chroma_bytes)) +
                           ", but a FRAME line stands ";
  return fail(Error::kInvalidArgument,
              says + (chroma_bytes == 0 ? "where chroma should be, as in Cmono"
                                        : "as far behind the first as in " + std::string(colour)));
}

Result<void> Y4mReader::fail_read(Error error) {
  if (error == Error::kDataLoss) {
    return fail_cut_short();
  }
  if (error == Error::kDisconnected) {
    const std::string why = ": " + source_->message();
    return frames_read_ == 0 ? fail(Error::kDataLoss, "cut short within its first frame" + why)
                             : fail_cut_short(why);
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

/// Reads up to and without the next line feed, which is taken as well.
Result<void> Y4mReader::read_line(std::string_view& line, Ending& ending) {
  std::size_t length = 0;
  ending = Ending::kTooLong;
  while (length < kLongestLine) {
    if (buffer_begin_ == buffer_end_) {
      const auto more = fill();
      if (!more) {
        return Unexpected(more.error());
      }
      if (!*more) {
        ending = Ending::kEndOfData;
        break;
      }
    }
    const char c = static_cast<char>(buffer_[buffer_begin_++]);
    if (c == '\n') {
      ending = Ending::kLineFeed;
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
    const auto bytes = std::span(buffer_).subspan(buffer_begin_, static_cast<std::size_t>(part));
    search_.look_through(bytes);
    note_end(bytes);
    if (into != nullptr) {
      std::memcpy(into, bytes.data(), bytes.size());
      into += part;
    }
    buffer_begin_ += static_cast<std::size_t>(part);
    count -= part;
  }
  return {};
}

/// Reads the luma plane. What is above a sample's bits is damage, or a writer's mistake: it is as
/// bright as can be.
Result<void> Y4mReader::read_luma(std::span<std::uint8_t> luma) {
  if (header_.depth_bits == 8) {
    return read_bytes(header_.luma_bytes(), luma.data());
  }
  deep_.resize(static_cast<std::size_t>(header_.stored_luma_bytes()));
  TUBESIGHT_TRY(read_bytes(header_.stored_luma_bytes(), deep_.data()));
  const std::int32_t below = header_.depth_bits - 8;
  for (std::size_t i = 0; i < deep_.size() / 2; ++i) {
    const std::int32_t sample = deep_[2 * i] + 256 * deep_[2 * i + 1];
    luma[i] = static_cast<std::uint8_t>(std::min(sample >> below, 255));
  }
  return {};
}

/// Counts the bytes of one value that a frame ends in, up to a line of them.
void Y4mReader::note_end(std::span<const std::byte> part) {
  if (part.back() != last_byte_) {
    alike_ = 0;
    last_byte_ = part.back();
  }
  std::int64_t count = 0;
  for (auto byte = part.rbegin();
       byte != part.rend() && *byte == last_byte_ && count < header_.width_px; ++byte) {
    ++count;
  }
  alike_ = std::cmp_equal(count, part.size()) ? alike_ + count : count;
}

/// Gives the next bytes without taking them: as many as tell what they begin, fewer at the end.
/// False when they cannot be read.
bool Y4mReader::peek(std::string_view& ahead) {
  constexpr std::size_t kEnough = kMagic.size();
  while (buffer_end_ - buffer_begin_ < kEnough) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(buffer_begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(buffer_end_), buffer_.begin());
    buffer_end_ -= buffer_begin_;
    buffer_begin_ = 0;
    const auto count = source_->read(std::span(buffer_).subspan(buffer_end_));
    if (!count) {
      static_cast<void>(fail_read(count.error()));
      return false;
    }
    if (*count == 0) {
      break;
    }
    buffer_end_ += *count;
  }
  ahead = {reinterpret_cast<const char*>(buffer_.data()) + buffer_begin_,
           std::min(kEnough, buffer_end_ - buffer_begin_)};
  return true;
}

}  // namespace tubesight::drivers
