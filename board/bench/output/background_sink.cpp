#include "board/bench/output/background_sink.h"

#include <algorithm>
#include <cstring>

#include "drivers/files/commit_together.h"

namespace tubesight::board {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> BackgroundSink::open(const drivers::Y4mHeader& recording, bool interlaced) {
  TUBESIGHT_TRY(sink_->open(recording, interlaced));
  for (std::thread& worker : workers_) {
    worker = std::thread([this] { work(); });
  }
  return {};
}

Result<void> BackgroundSink::add(std::int64_t field, const core::RgbImageView& picture) {
  std::unique_lock lock(mutex_);
  Slot* free = nullptr;
  changed_.wait(lock, [&] { return failed_ || (free = find_free()) != nullptr; });
  if (failed_) {
    lock.unlock();
    finish(false);  // nobody else uses its message then
    drivers::CommitTogether::fail_current();
    return Unexpected(Error::kIo);
  }
  lock.unlock();
  Slot& slot = *free;
  const std::size_t line_bytes = 3 * static_cast<std::size_t>(picture.width_px);
  slot.field = field;
  slot.pixels.resize(line_bytes * static_cast<std::size_t>(picture.height_px));
  for (std::int32_t line = 0; line < picture.height_px; ++line) {
    std::memcpy(slot.pixels.data() + static_cast<std::size_t>(line) * line_bytes,
                picture.pixels + std::ptrdiff_t{line} * picture.stride_bytes, line_bytes);
  }
  slot.picture = {slot.pixels.data(), picture.width_px, picture.height_px, 3 * picture.width_px};
  lock.lock();
  slot.state = State::kWaiting;
  slot.number = added_++;
  lock.unlock();
  changed_.notify_all();
  return {};
}

BackgroundSink::Slot* BackgroundSink::find_free() {
  const auto slot = std::find_if(slots_.begin(), slots_.end(),
                                 [](const Slot& each) { return each.state == State::kFree; });
  return slot == slots_.end() ? nullptr : &*slot;
}

BackgroundSink::Slot* BackgroundSink::find_oldest() {
  Slot* oldest = nullptr;
  for (Slot& slot : slots_) {
    if (slot.state == State::kWaiting && (oldest == nullptr || slot.number < oldest->number)) {
      oldest = &slot;
    }
  }
  return oldest;
}

void BackgroundSink::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    Slot* next = nullptr;
    changed_.wait(lock, [&] { return (next = find_oldest()) != nullptr || closing_ || failed_; });
    if (next == nullptr || dropping_ || failed_) {
      return;
    }
    next->state = State::kInWork;
    lock.unlock();
    const bool good = static_cast<bool>(sink_->add(next->field, next->picture));
    lock.lock();
    next->state = State::kFree;
    failed_ = failed_ || !good;
    changed_.notify_all();
  }
}

void BackgroundSink::finish(bool all) {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
    dropping_ = !all;
  }
  changed_.notify_all();
  for (std::thread& worker : workers_) {
    if (worker.joinable()) {
      worker.join();
    }
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
