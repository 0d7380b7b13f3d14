#include "drivers/files/byte_source.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <lzma.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::size_t kChunkBytes = 65536;
constexpr std::uint64_t kXzMemoryLimit = std::uint64_t{256} << 20;
constexpr std::array<std::byte, 6> kXzMagic = {std::byte{0xFD}, std::byte{'7'}, std::byte{'z'},
                                               std::byte{'X'},  std::byte{'Z'}, std::byte{0}};

class FileByteSource final : public ByteSource {
 public:
  explicit FileByteSource(int descriptor) : descriptor_(descriptor) {}
  FileByteSource(const FileByteSource&) = delete;
  FileByteSource& operator=(const FileByteSource&) = delete;
  ~FileByteSource() override { ::close(descriptor_); }

  Result<std::size_t> read(std::span<std::byte> into) override {
    ssize_t count = 0;
    do {
      count = ::read(descriptor_, into.data(), into.size());
    } while (count < 0 && errno == EINTR);
    if (count < 0) {
      message_ = std::strerror(errno);
      return Unexpected(Error::kIo);
    }
    return static_cast<std::size_t>(count);
  }
  const std::string& message() const override { return message_; }
  double share_read() const override {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode) || status.st_size == 0) {
      return -1.0;
    }
    return static_cast<double>(::lseek(descriptor_, 0, SEEK_CUR)) /
           static_cast<double>(status.st_size);
  }

 private:
  int descriptor_;
  std::string message_;
};

/// Gives back bytes that were read to look at them, then what follows.
class PrefixedByteSource final : public ByteSource {
 public:
  PrefixedByteSource(std::span<const std::byte> prefix, std::unique_ptr<ByteSource> rest)
      : prefix_(prefix.begin(), prefix.end()), rest_(std::move(rest)) {}

  Result<std::size_t> read(std::span<std::byte> into) override {
    if (given_ == prefix_.size()) {
      return rest_->read(into);
    }
    const std::size_t count = std::min(into.size(), prefix_.size() - given_);
    std::memcpy(into.data(), prefix_.data() + given_, count);
    given_ += count;
    return count;
  }
  const std::string& message() const override { return rest_->message(); }
  double share_read() const override { return rest_->share_read(); }

 private:
  std::vector<std::byte> prefix_;
  std::size_t given_ = 0;
  std::unique_ptr<ByteSource> rest_;
};

class XzByteSource final : public ByteSource {
 public:
  explicit XzByteSource(std::unique_ptr<ByteSource> compressed)
      : compressed_(std::move(compressed)), input_(kChunkBytes) {
    ready_ = lzma_stream_decoder(&stream_, kXzMemoryLimit, LZMA_CONCATENATED) == LZMA_OK;
  }
  XzByteSource(const XzByteSource&) = delete;
  XzByteSource& operator=(const XzByteSource&) = delete;
  ~XzByteSource() override { lzma_end(&stream_); }

  Result<std::size_t> read(std::span<std::byte> into) override {
    if (!ready_) {
      message_ = "no memory to decompress it";
      return Unexpected(Error::kIo);
    }
    if (failed_) {
      return Unexpected(failure_);
    }
    stream_.next_out = reinterpret_cast<std::uint8_t*>(into.data());
    stream_.avail_out = into.size();
    while (!ended_ && stream_.avail_out == into.size() && !into.empty()) {
      TUBESIGHT_TRY(refill());
      const lzma_ret outcome = lzma_code(&stream_, input_ended_ ? LZMA_FINISH : LZMA_RUN);
      if (outcome == LZMA_STREAM_END) {
        ended_ = true;
      } else if (outcome != LZMA_OK) {
        note_failure(outcome);
        break;
      }
    }
    // Bytes that came out before a failure are delivered first; the next read tells the failure.
    const std::size_t count = into.size() - stream_.avail_out;
    if (failed_ && count == 0) {
      return Unexpected(failure_);
    }
    return count;
  }
  const std::string& message() const override { return message_; }
  double share_read() const override { return compressed_->share_read(); }

 private:
  Result<void> refill() {
    if (stream_.avail_in > 0 || input_ended_) {
      return {};
    }
    const auto count = compressed_->read(input_);
    if (!count) {
      message_ = compressed_->message();
      failed_ = true;
      failure_ = count.error();
      return Unexpected(failure_);
    }
    input_ended_ = *count == 0;
    stream_.next_in = reinterpret_cast<const std::uint8_t*>(input_.data());
    stream_.avail_in = *count;
    return {};
  }

  void note_failure(lzma_ret outcome) {
    failed_ = true;
    failure_ = Error::kIo;
    switch (outcome) {
      case LZMA_BUF_ERROR:
        failure_ = Error::kDataLoss;
        message_ = "the compressed data ends early";
        break;
      case LZMA_MEMLIMIT_ERROR:
        message_ = "decompressing it takes more than 256 MiB of memory";
        break;
      case LZMA_MEM_ERROR: message_ = "no memory to decompress it"; break;
      case LZMA_OPTIONS_ERROR:
        message_ = "compressed with xz options that are not supported";
        break;
      default: message_ = "the xz data is corrupt"; break;
    }
  }

  std::unique_ptr<ByteSource> compressed_;
  std::vector<std::byte> input_;
  lzma_stream stream_ = LZMA_STREAM_INIT;
  std::string message_;
  bool ready_ = false;
  bool input_ended_ = false;
  bool ended_ = false;
  bool failed_ = false;
  Error failure_ = Error::kIo;
};

}  // namespace

Result<std::size_t> MemoryByteSource::read(std::span<std::byte> into) {
  const std::size_t count = std::min(into.size(), rest_.size());
  if (count > 0) {
    std::memcpy(into.data(), rest_.data(), count);
  }
  rest_ = rest_.subspan(count);
  return count;
}

Result<void> open_file(const std::string& path, std::unique_ptr<ByteSource>& source,
                       std::string& message) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    message = std::strerror(errno);
    return Unexpected(Error::kIo);
  }
  source = std::make_unique<FileByteSource>(descriptor);
  return {};
}

Result<void> decompress_if_xz(std::unique_ptr<ByteSource>& source, std::string& message) {
  std::array<std::byte, kXzMagic.size()> first{};
  std::size_t count = 0;
  while (count < first.size()) {
    const auto more = source->read(std::span(first).subspan(count));
    if (!more) {
      message = source->message();
      return Unexpected(more.error());
    }
    if (*more == 0) {
      break;
    }
    count += *more;
  }
  source = std::make_unique<PrefixedByteSource>(std::span(first).first(count), std::move(source));
  if (count == first.size() && first == kXzMagic) {
    source = std::make_unique<XzByteSource>(std::move(source));
  }
  return {};
}

Result<void> read_whole_file(const std::string& path, std::size_t limit, std::string& text,
                             std::string& message) {
  std::unique_ptr<ByteSource> source;
  TUBESIGHT_TRY(open_file(path, source, message));
  text.clear();
  std::vector<std::byte> chunk(kChunkBytes);
  while (true) {
    const auto count = source->read(chunk);
    if (!count) {
      message = source->message();
      return Unexpected(count.error());
    }
    if (*count == 0) {
      return {};
    }
    if (text.size() + *count > limit) {
      message = "longer than " + std::to_string(limit) + " bytes";
      return Unexpected(Error::kOutOfRange);
    }
    text.append(reinterpret_cast<const char*>(chunk.data()), *count);
  }
}

}  // namespace tubesight::drivers
