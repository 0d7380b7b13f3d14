#include "drivers/ffmpeg/ffmpeg_decoder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// A stamp that has not come so long after its frame is taken for none, ms.
constexpr int kPatience_ms = 10'000;

/// Pictures that are read ahead of a late stamp: two of the largest.
constexpr std::size_t kMostAhead = std::size_t{2} * 8192 * 8192 * 2;
constexpr std::size_t kAheadChunk = 65536;

/// The file, opened by us: so its name is none of a protocol, of a pattern or of an option, and
/// tells nothing of its content.
constexpr const char* kFile = "/dev/fd/4";

/// Whether a file is a TIFF picture: of those ffmpeg takes every tag that it does not know for an
/// error when it is told to be strict.
bool is_tiff(int file) {
  constexpr std::string_view kLittle("II*\0", 4);
  constexpr std::string_view kBig("MM\0*", 4);
  std::array<char, 4> first{};
  const ssize_t count = ::pread(file, first.data(), first.size(), 0);
  const std::string_view begin(first.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  return begin == kLittle || begin == kBig;
}

std::vector<std::string> make_arguments(bool strict) {
  return {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error",
          // The first error ends it; pictures made up in place of lost ones would look sound.
          "-xerror", "-err_detect", strict ? "explode" : "crccheck",
          // Nor may its content point at a network.
          "-protocol_whitelist", "file,pipe", "-i", std::string("file:") + kFile,
          // The stamps come first, so that a frame's is mostly there when the frame is.
          "-map", "0:v:0", "-vf", "scale=16:16", "-fps_mode", "passthrough", "-enc_time_base", "-1",
          "-flush_packets", "1", "-f", "framecrc", "pipe:3",
          // The least loss is chosen: 8 bits from 8, 16 from more.
          "-map", "0:v:0", "-vf", "format=pix_fmts=gray|gray10le|gray12le|gray16le", "-fps_mode",
          "passthrough", "-flush_packets", "1", "-strict", "-1", "-f", "yuv4mpegpipe", "pipe:1"};
}

/// Reads what a pipe has into `take`; false at its end.
template <typename Take>
bool drain(int descriptor, Take take) {
  std::array<char, 4096> part{};
  ssize_t count = 0;
  do {
    count = ::read(descriptor, part.data(), part.size());
  } while (count < 0 && errno == EINTR);
  if (count <= 0) {
    return false;
  }
  take(std::string_view(part.data(), static_cast<std::size_t>(count)));
  return true;
}

}  // namespace

Result<std::unique_ptr<FfmpegDecoder>> FfmpegDecoder::open(const std::string& path,
                                                           std::string& message) {
  std::unique_ptr<FfmpegDecoder> source(new FfmpegDecoder);
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    message = std::strerror(errno);
    return Unexpected(Error::kIo);
  }
  const auto started = source->ffmpeg_.start(make_arguments(!is_tiff(file)),
                                             {.input = false, .notes = true, .file = file});
  const int why = errno;
  ::close(file);
  if (!started) {
    message = started.error() == Error::kUnsupported
                  ? std::string(kNoFfmpeg)
                  : std::string("ffmpeg cannot be started: ") + std::strerror(why);
    return Unexpected(started.error());
  }
  return source;
}

/// Takes words and stamps as they come, until there is something of what is awaited; false: not in
/// time, or never.
bool FfmpegDecoder::wait_for(Awaited what) {
  while (true) {
    if (what == Awaited::kNotes && (stamps_.ready() || !notes_open_)) {
      return stamps_.ready();
    }
    if (what == Awaited::kEnd && !words_open_ && !notes_open_) {
      return true;
    }
    // A negative descriptor is passed over.
    std::array<pollfd, 3> pipes{};
    // ffmpeg may write the next picture before a frame's stamp: unless that is taken, both wait.
    const bool ahead =
        what == Awaited::kNotes && pictures_open_ && ahead_.size() - ahead_given_ < kMostAhead;
    pipes[0] = {what == Awaited::kPicture || ahead ? ffmpeg_.output() : -1, POLLIN, 0};
    pipes[1] = {words_open_ ? ffmpeg_.errors() : -1, POLLIN, 0};
    pipes[2] = {notes_open_ ? ffmpeg_.notes() : -1, POLLIN, 0};
    const int ready =
        ::poll(pipes.data(), pipes.size(), what == Awaited::kNotes ? kPatience_ms : -1);
    if (ready < 0 && errno == EINTR) {
      continue;
    }
    if (ready <= 0) {
      return false;
    }
    if (pipes[1].revents != 0) {
      words_open_ = drain(ffmpeg_.errors(), [this](std::string_view part) { words_.take(part); });
    }
    if (pipes[2].revents != 0) {
      notes_open_ = drain(ffmpeg_.notes(), [this](std::string_view part) { stamps_.take(part); });
    }
    if (what == Awaited::kPicture && pipes[0].revents != 0) {
      return true;
    }
    if (ahead && pipes[0].revents != 0) {
      read_ahead();
    }
  }
}

/// Takes what there is of the pictures. A failure is told by the read() that comes to it.
void FfmpegDecoder::read_ahead() {
  ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(ahead_given_));
  ahead_given_ = 0;
  const std::size_t before = ahead_.size();
  ahead_.resize(before + kAheadChunk);
  ssize_t count = 0;
  do {
    count = ::read(ffmpeg_.output(), ahead_.data() + before, kAheadChunk);
  } while (count < 0 && errno == EINTR);
  pictures_open_ = count > 0;
  ahead_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
}

Result<std::size_t> FfmpegDecoder::read(std::span<std::byte> into) {
  if (ended_) {
    return message_.empty() ? Result<std::size_t>(std::size_t{0})
                            : Unexpected(Error::kDisconnected);
  }
  if (ahead_given_ < ahead_.size()) {
    const std::size_t count = std::min(into.size(), ahead_.size() - ahead_given_);
    std::memcpy(into.data(), ahead_.data() + ahead_given_, count);
    ahead_given_ += count;
    return count;
  }
  if (!pictures_open_) {
    return finish();
  }
  if (!wait_for(Awaited::kPicture)) {
    message_ = std::strerror(errno);
    return Unexpected(Error::kIo);
  }
  ssize_t count = 0;
  do {
    count = ::read(ffmpeg_.output(), into.data(), into.size());
  } while (count < 0 && errno == EINTR);
  if (count < 0) {
    message_ = std::strerror(errno);
    return Unexpected(Error::kIo);
  }
  return count > 0 ? Result<std::size_t>(static_cast<std::size_t>(count)) : finish();
}

/// At the end of the pictures: whether they are all.
Result<std::size_t> FfmpegDecoder::finish() {
  ended_ = true;
  static_cast<void>(wait_for(Awaited::kEnd));
  const int status = ffmpeg_.wait();
  if (status == 0 && words_.empty()) {
    return std::size_t{0};
  }
  message_ = "ffmpeg: " + (words_.empty() ? "ended with status " + std::to_string(status)
                                          : words_.in_one_line(kFile));
  return Unexpected(Error::kDisconnected);
}

std::optional<FrameStamp> FfmpegDecoder::next_stamp() {
  while (wait_for(Awaited::kNotes)) {
    const auto stamp = stamps_.next();
    if (late_stamps_ == 0) {
      return stamp;
    }
    --late_stamps_;
  }
  // Should it still come, it is this frame's and not the next one's.
  late_stamps_ += notes_open_ ? 1 : 0;
  return std::nullopt;
}

}  // namespace tubesight::drivers
