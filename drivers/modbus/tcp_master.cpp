#include "drivers/modbus/tcp_master.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>

#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/modbus/serial_master.h"

namespace tubesight::drivers {
namespace {

// A unit is for gateways; who speaks to the box itself says 255 or 0.
constexpr std::uint8_t kAnyUnit = 0;
constexpr std::uint8_t kNoUnit = 255;

/// Bytes that wait to be read; where the kernel does not say, all that will ever come.
std::size_t unread(int descriptor) {
  int count = 0;
  return ioctl(descriptor, FIONREAD, &count) == 0 && count >= 0 ? static_cast<std::size_t>(count)
                                                                : SIZE_MAX;
}

}  // namespace

void TcpMaster::open(int descriptor) {
  close();
  descriptor_ = descriptor;
  framer_.reset();
  conversation_.reset();
  count_ = 0;
  taken_ = 0;
  late_ = 0;
  late_unread_ = 0;
  heard_ = clock_->now();
}

void TcpMaster::close() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
  descriptor_ = -1;
  conversation_.abandon();
}

void TcpMaster::add_to(PollSet& poll) const {
  if (!conversation_.waits()) {
    poll.add(descriptor_);
  }
  poll.add(conversation_.deadline().descriptor());
}

void TcpMaster::serve(const PollSet& poll) {
  if (descriptor_ < 0 || conversation_.waits()) {
    return;
  }
  if (poll.readable(descriptor_)) {
    receive();
  } else if (poll.gone(descriptor_)) {
    close();
  }
}

void TcpMaster::receive() {
  const ssize_t count = read(descriptor_, received_.data(), received_.size());
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
    close();
    return;
  }
  heard_ = clock_->now();
  count_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  taken_ = 0;
  late_ = std::min(late_unread_, count_);
  late_unread_ -= late_;
  take_received();
}

void TcpMaster::take_received() {
  while (descriptor_ >= 0 && taken_ < count_ && !conversation_.waits()) {
    const bool late = taken_ < late_;
    framer_.append(received_[taken_++]);
    const TcpFramer::Found found = framer_.next();
    if (found == TcpFramer::Found::kBroken) {
      ++state_->counters.cut_frames;
      close();
      return;
    }
    if (found == TcpFramer::Found::kNothing) {
      continue;
    }
    if (framer_.unit() != unit_ && framer_.unit() != kAnyUnit && framer_.unit() != kNoUnit) {
      ++state_->counters.other_units;
      continue;
    }
    ++state_->counters.requests;
    const auto answer = late ? conversation_.take_late(framer_.request(), heard_)
                             : conversation_.take(framer_.request(), heard_);
    if (answer) {
      send(*answer);
    }
  }
}

void TcpMaster::finish() {
  if (const auto answer = conversation_.finish(clock_->now())) {
    late_unread_ = unread(descriptor_);
    send(*answer);
    take_received();
  }
}

void TcpMaster::send(const ReadyAnswer& answer) {
  TcpFrame frame;
  framer_.wrap(answer.pdu.view(), frame);
  const auto size = static_cast<std::size_t>(frame.size());
  if (::send(descriptor_, frame.begin(), size, MSG_NOSIGNAL) == static_cast<ssize_t>(size)) {
    count_answer(answer, clock_->now(), state_->counters);
  } else {
    ++state_->counters.abandoned_answers;
    close();  // the rest of the frame would be taken for the beginning of the next
  }
}

}  // namespace tubesight::drivers
