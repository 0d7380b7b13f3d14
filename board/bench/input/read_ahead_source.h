#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "drivers/files/byte_source.h"

namespace tubesight::board {

/// Reads another source ahead on a thread of its own: decompression beside what is done with the
/// bytes. Holds 4 MB.
///
/// Bytes, end and failure come in the order of the other source. That must not block for ever, as a
/// pipe may: the destructor waits for the read that is going on.
class ReadAheadSource final : public drivers::ByteSource {
 public:
  explicit ReadAheadSource(std::unique_ptr<drivers::ByteSource> from);
  ReadAheadSource(const ReadAheadSource&) = delete;
  ReadAheadSource& operator=(const ReadAheadSource&) = delete;
  ~ReadAheadSource() override;

  [[nodiscard]] core::Result<std::size_t> read(std::span<std::byte> into) override;
  [[nodiscard]] double share_read() const override { return share_read_; }
  [[nodiscard]] const std::string& message() const override { return message_; }

 private:
  void work();

  std::unique_ptr<drivers::ByteSource> from_;
  std::atomic<double> share_read_;  ///< a little ahead of what was given
  std::string message_;             ///< of the reader's side

  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  std::vector<std::byte> ring_;
  std::size_t begin_ = 0;  ///< of the bytes that wait
  std::size_t count_ = 0;
  bool ended_ = false;  ///< nothing comes after them, or the failure
  std::optional<core::Error> failure_;
  bool stopping_ = false;

  std::thread thread_;  ///< last: it uses all of the above
};

}  // namespace tubesight::board
