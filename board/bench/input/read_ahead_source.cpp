#include "board/bench/input/read_ahead_source.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tubesight::board {
namespace {

using core::Result;
using core::Unexpected;

constexpr std::size_t kRoom = std::size_t{4} << 20;
constexpr std::size_t kChunk = std::size_t{256} << 10;

}  // namespace

ReadAheadSource::ReadAheadSource(std::unique_ptr<drivers::ByteSource> from)
    : from_(std::move(from)),
      share_read_(from_->share_read()),
      ring_(kRoom),
      thread_([this] { work(); }) {}

ReadAheadSource::~ReadAheadSource() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ReadAheadSource::work() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    changed_.wait(lock, [this] { return stopping_ || count_ + kChunk <= ring_.size(); });
    if (stopping_) {
      return;
    }
    const std::size_t end = (begin_ + count_) % ring_.size();
    const std::span<std::byte> room(ring_.data() + end, std::min(kChunk, ring_.size() - end));
    // Nobody else touches what is free.
    lock.unlock();
    const auto read = from_->read(room);
    share_read_ = from_->share_read();
    lock.lock();
    count_ += read.value_or(0);
    ended_ = !read || *read == 0;
    if (!read) {
      failure_ = read.error();
    }
    changed_.notify_all();
  }
}

Result<std::size_t> ReadAheadSource::read(std::span<std::byte> into) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return count_ > 0 || ended_; });
  if (count_ == 0) {
    if (failure_) {
      message_ = from_->message();
      return Unexpected(*failure_);
    }
    return std::size_t{0};
  }
  const std::size_t given = std::min({into.size(), count_, ring_.size() - begin_});
  std::memcpy(into.data(), ring_.data() + begin_, given);
  begin_ = (begin_ + given) % ring_.size();
  count_ -= given;
  changed_.notify_all();
  return given;
}

}  // namespace tubesight::board
