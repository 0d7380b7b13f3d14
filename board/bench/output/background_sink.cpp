#include "board/bench/output/background_sink.h"

#include <cstring>

#include "drivers/files/commit_together.h"

namespace tubesight::board {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> BackgroundSink::open(const drivers::Y4mHeader& recording, bool interlaced) {
  TUBESIGHT_TRY(sink_->open(recording, interlaced));
  worker_ = std::thread([this] { work(); });
  return {};
}

Result<void> BackgroundSink::add(std::int64_t field, const core::RgbImageView& picture) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failed_ || count_ < kMostWaiting; });
  if (failed_) {
    lock.unlock();
    finish(false);  // nobody else uses its message then
    drivers::CommitTogether::fail_current();
    return Unexpected(Error::kIo);
  }
  Waiting& slot = ring_[(first_ + count_) % kMostWaiting];
  lock.unlock();
  const std::size_t line_bytes = 3 * static_cast<std::size_t>(picture.width_px);
  slot.field = field;
  slot.pixels.resize(line_bytes * static_cast<std::size_t>(picture.height_px));
  for (std::int32_t line = 0; line < picture.height_px; ++line) {
    std::memcpy(slot.pixels.data() + static_cast<std::size_t>(line) * line_bytes,
                picture.pixels + std::ptrdiff_t{line} * picture.stride_bytes, line_bytes);
  }
  slot.picture = {slot.pixels.data(), picture.width_px, picture.height_px, 3 * picture.width_px};
  lock.lock();
  ++count_;
  lock.unlock();
  changed_.notify_all();
  return {};
}

void BackgroundSink::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return count_ > 0 || closing_; });
    if (count_ == 0 || dropping_) {
      return;
    }
    const Waiting& next = ring_[first_];
    lock.unlock();
    const bool good = static_cast<bool>(sink_->add(next.field, next.picture));
    lock.lock();
    first_ = (first_ + 1) % kMostWaiting;
    --count_;
    failed_ = !good;
    changed_.notify_all();
    if (failed_) {
      return;
    }
  }
}

void BackgroundSink::finish(bool all) {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
    dropping_ = !all;
  }
  changed_.notify_all();
  if (worker_.joinable()) {
    worker_.join();
  }
}

Result<void> BackgroundSink::commit() {
  finish(true);
  if (failed_) {
    drivers::CommitTogether::fail_current();  // of this thread, where the worker's is none
    return Unexpected(Error::kIo);
  }
  return sink_->commit();
}

}  // namespace tubesight::board
