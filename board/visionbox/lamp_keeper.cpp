#include "board/visionbox/lamp_keeper.h"

#include <algorithm>
#include <chrono>

#include "board/visionbox/real_time.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// From one change of the level to the next while it is led to another.
constexpr MonotonicTime kStep = std::chrono::milliseconds(10);
constexpr MonotonicTime kIdle = std::chrono::milliseconds(100);
/// A level that stays is said again so often: a device that is gone is found out by that alone.
constexpr MonotonicTime kProof = std::chrono::seconds(1);

}  // namespace

Result<void> LampKeeper::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  started_ = true;
  stopping_ = false;
  failed_ = false;
  asked_ = false;
  wanted_permille_ = 0;
  next_try_ = MonotonicTime{0};
  told_.clear();
  thread_ = std::thread([this] {
    name_this_thread("lamp");
    keep();
  });
  return {};
}

void LampKeeper::stop() {
  if (!started_) {
    return;
  }
  wanted_permille_ = 0;
  stopping_ = true;
  stirred_.wake();
  thread_.join();
  started_ = false;
}

Result<void> LampKeeper::set_level(std::int32_t permille) {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  if (permille < 0 || permille > hal::kFullLevel_permille) {
    return Unexpected(Error::kOutOfRange);
  }
  const bool refused = failed_ && asked_;
  wanted_permille_ = permille;
  asked_ = true;
  stirred_.wake();
  return refused ? Result<void>(Unexpected(Error::kIo)) : Result<void>();
}

void LampKeeper::set_most(std::int32_t permille) {
  if (most_permille_.exchange(permille) != permille) {
    stirred_.wake();
  }
}

std::int32_t LampKeeper::level_permille() const {
  return !started_ || failed_ ? 0 : wanted_permille_.load();
}

bool LampKeeper::opened() {
  const MonotonicTime now = monotonic_now();
  if (open_ || now < next_try_ || stopping_) {
    return open_;
  }
  next_try_ = now + between_tries_;
  if (!lamp_->dimmer().start()) {
    lose(lamp_->message());
    return false;
  }
  if (!told_.empty()) {
    tell_("lamp: is there again");
    told_.clear();
  }
  ramp_.begin(now);
  remember(0, now);
  shining_permille_ = 0;
  next_proof_ = now + kProof;
  failed_ = false;
  open_ = true;
  return true;
}

/// One that is tried again and again fails in the same way.
void LampKeeper::lose(const std::string& why) {
  ++failures_;
  failed_ = true;
  open_ = false;
  shine(0, monotonic_now());  // nobody knows; dark is what is told of a lamp that cannot be had
  if (why != told_) {
    tell_(why);
    told_ = why;
  }
}

void LampKeeper::apply(std::int32_t permille, MonotonicTime now) {
  next_proof_ = now + kProof;
  if (lamp_->dimmer().set_level(permille)) {
    shine(permille, now);
    return;
  }
  lamp_->dimmer().stop();
  lose("lamp: the device refuses a level, to be opened again");
}

void LampKeeper::shine(std::int32_t permille, MonotonicTime now) {
  if (permille != shining_permille_) {
    shining_permille_ = permille;
    remember(permille, now);
  }
}

void LampKeeper::keep() {
  MonotonicTime longest_end{0};
  while (true) {
    ++rounds_;
    const MonotonicTime now = monotonic_now();
    const std::int32_t wanted = std::min(wanted_permille_.load(), most_permille_.load());
    if (opened()) {
      const std::int32_t level = ramp_.next(wanted, now);
      resting_ = ramp_.resting();
      if (level != shining_permille_ || now >= next_proof_) {
        apply(level, now);
      }
    }
    const bool dark = !open_ || shining_permille_ == 0;
    if (stopping_) {
      longest_end = longest_end == MonotonicTime{0} ? now + care_.soft + kIdle : longest_end;
      if (dark || now >= longest_end) {
        break;
      }
    }
    const bool led = open_ && shining_permille_ != wanted && !resting_;
    stirred_.wait_until(now + (led || stopping_ ? kStep : kIdle));
  }
  if (open_) {
    lamp_->dimmer().stop();
    remember(0, monotonic_now());
  }
  open_ = false;
  shining_permille_ = 0;
}

void LampKeeper::remember(std::int32_t permille, MonotonicTime now) {
  history_.changes[history_.next % kRemembered] = {now.count(), permille};
  ++history_.next;
  latest_.publish(history_);
}

std::int32_t LampKeeper::level_permille_at(core::FieldTime instant) const {
  History history;
  if (!latest_.try_read(history)) {
    return shining_permille_;
  }
  std::int32_t level = 0;
  for (std::uint32_t back = 1; back <= kRemembered && back <= history.next; ++back) {
    const Change& change = history.changes[(history.next - back) % kRemembered];
    level = change.permille;
    if (change.at_ns <= instant.count()) {
      break;
    }
  }
  return level;
}

LampReport LampKeeper::report() const { return {open_, shining_permille_, resting_, failures_}; }

}  // namespace tubesight::board
