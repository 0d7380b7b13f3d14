#include "board/visionbox/pairs_writer.h"

#include <chrono>
#include <utility>

#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/wakeup.h"
#include "drivers/files/pairs_file.h"

namespace tubesight::board {
namespace {

// A pair is seldom: its request takes fields of standing still.
constexpr std::chrono::milliseconds kLookEvery{50};

}  // namespace

PairsWriter::PairsWriter(PairDesk& desk, std::string file, Tell tell)
    : desk_(&desk), file_(std::move(file)), tell_(std::move(tell)) {}

void PairsWriter::start() {
  stopping_ = false;
  thread_ = std::thread([this] {
    use_signal_stack();
    run();
  });
}

void PairsWriter::stop() {
  stopping_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void PairsWriter::run() {
  while (true) {
    // Asked before the last look, so that nothing handed over before stop() is left.
    const bool last = stopping_;
    write_all();
    if (last) {
      return;
    }
    sleep_until(monotonic_now() + kLookEvery);
  }
}

void PairsWriter::write_all() {
  while (const auto pair = desk_->take_pair()) {
    std::string message;
    const bool written = static_cast<bool>(drivers::append_pair(file_, *pair, message));
    ++(written ? written_ : failed_);
    {
      const std::lock_guard lock(mutex_);
      trouble_ = message;
    }
    if (!written) {
      tell_("a pair of poses is lost: " + message);
    }
  }
}

PairsReport PairsWriter::report() const {
  const std::lock_guard lock(mutex_);
  return {file_, written(), lost(), trouble_};
}

}  // namespace tubesight::board
