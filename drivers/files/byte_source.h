#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.h"

namespace tubesight::drivers {

/// A stream of bytes that is read once from its beginning: a file, memory, or decompressed data.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// Reads between 1 and into.size() bytes and says how many; 0 is the end. Blocks as the file
  /// does.
  ///
  /// Errors, after which no further read succeeds: kIo the operating system refused or compressed
  /// data is corrupt, kDataLoss compressed data ends early (what was read before is sound as far as
  /// can be known), kDisconnected the program that makes the bytes gave up (likewise). message()
  /// then says why.
  [[nodiscard]] virtual core::Result<std::size_t> read(std::span<std::byte> into) = 0;

  /// The share of all bytes that was read, 0..1; below 0 where that is not known.
  [[nodiscard]] virtual double share_read() const { return -1.0; }

  /// Why the last read failed, without the file's name; empty before.
  [[nodiscard]] virtual const std::string& message() const = 0;
};

/// Bytes that somebody else owns and keeps while this object lives.
class MemoryByteSource final : public ByteSource {
 public:
  explicit MemoryByteSource(std::span<const std::byte> bytes) : rest_(bytes) {}

  [[nodiscard]] core::Result<std::size_t> read(std::span<std::byte> into) override;
  [[nodiscard]] const std::string& message() const override { return message_; }

 private:
  std::span<const std::byte> rest_;
  std::string message_;
};

/// Opens the file `path` for reading, whatever it is: regular file, pipe or device.
///
/// Errors: kIo, and `message` says why without the file's name.
[[nodiscard]] core::Result<void> open_file(const std::string& path,
                                           std::unique_ptr<ByteSource>& source,
                                           std::string& message);

/// Puts decompression before `source` when its first bytes are those of an xz file.
///
/// Goes by the content, not by the name. Decompression takes at most 256 MiB of memory (the largest
/// preset of xz needs 65 MiB). Errors: those of ByteSource::read.
[[nodiscard]] core::Result<void> decompress_if_xz(std::unique_ptr<ByteSource>& source,
                                                  std::string& message);

/// Reads all of `path` into `text`. Errors: kIo, kOutOfRange when longer than `limit` bytes.
[[nodiscard]] core::Result<void> read_whole_file(const std::string& path, std::size_t limit,
                                                 std::string& text, std::string& message);

}  // namespace tubesight::drivers
