#include "drivers/modbus/serial_master.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>

#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::FieldTime;
using core::Result;

/// Time between two attempts to open a line that vanished.
constexpr std::chrono::milliseconds kReopenEvery{250};

/// 3.5 characters of 11 bits.
std::chrono::nanoseconds shortest_gap(std::int32_t baud) {
  constexpr std::int64_t kBits_ns = 38'500'000'000;
  return std::chrono::nanoseconds(kBits_ns / std::max(baud, 1));
}

/// Bytes of 11 bits on the line.
std::chrono::nanoseconds time_of(std::int32_t bytes, std::int32_t baud) {
  constexpr std::int64_t kBits_ns = 11'000'000'000;
  return std::chrono::nanoseconds(bytes * kBits_ns / std::max(baud, 1));
}

}  // namespace

void count_answer(const ReadyAnswer& answer, FieldTime now, LinkCounters& counters) {
  ++counters.answers;
  counters.exceptions += answer.refused ? 1 : 0;
  const std::int64_t took_us = (now - answer.arrival).count() / 1000;
  const auto took = static_cast<std::uint32_t>(std::clamp<std::int64_t>(took_us, 0, INT32_MAX));
  counters.response_last_us = took;
  std::uint32_t& worst =
      answer.judged ? counters.claim_response_worst_us : counters.response_worst_us;
  worst = std::max(worst, took);
}

SerialMaster::SerialMaster(const SerialService& service, WordOrder order, LinkState& state,
                           Outbox& outbox, const hal::Clock& clock)
    : service_(service),
      state_(&state),
      clock_(&clock),
      gap_(std::max<std::chrono::nanoseconds>(service.frame_gap, shortest_gap(service.line.baud))),
      framer_(service.unit, state.counters),
      conversation_(order, state, outbox) {}

Result<void> SerialMaster::open() {
  TUBESIGHT_TRY(line_.open(service_.line));
  echo_ = {};
  framer_.reset();
  conversation_.reset();
  answer_.reset();
  return {};
}

void SerialMaster::close() {
  line_.close();
  silence_.cancel();
  reopen_.cancel();
}

void SerialMaster::lose_line() {
  close();
  reopen_.set(kReopenEvery);
}

void SerialMaster::add_to(PollSet& poll) const {
  poll.add(line_.descriptor());
  poll.add(silence_.descriptor());
  poll.add(reopen_.descriptor());
  poll.add(conversation_.deadline().descriptor());
}

void SerialMaster::serve(const PollSet& poll) {
  if (!line_.is_open()) {
    if (poll.readable(reopen_.descriptor()) && reopen_.went_off()) {
      if (open()) {
        ++state_->counters.reopenings;
      } else {
        reopen_.set(kReopenEvery);
      }
    }
    return;
  }
  const int line = line_.descriptor();
  if (poll.readable(line)) {
    receive();
  } else if (poll.readable(silence_.descriptor()) && silence_.went_off()) {
    end_with_silence();
  }
  if (line_.is_open() && poll.gone(line)) {
    lose_line();
  }
}

void SerialMaster::receive() {
  std::array<std::uint8_t, kMostFrameBytes> chunk{};
  const ssize_t count = read(line_.descriptor(), chunk.data(), chunk.size());
  if (count < 0 && errno != EAGAIN && errno != EINTR) {
    lose_line();
    return;
  }
  const FieldTime arrival = clock_->now();
  const std::uint32_t others = state_->counters.other_units;
  for (const std::uint8_t byte :
       std::span(chunk).first(count > 0 ? static_cast<std::size_t>(count) : 0)) {
    receive_byte(byte, arrival);
  }
  if (state_->counters.other_units != others) {
    abandon();  // the line belongs to somebody else by now
  }
  if (framer_.waits() || echo_.holds()) {
    silence_.set(gap_);
  } else {
    silence_.cancel();
  }
  send();
}

void SerialMaster::receive_byte(std::uint8_t byte, FieldTime arrival) {
  switch (echo_.take(byte, arrival)) {
    case EchoFilter::Byte::kHeld: break;
    case EchoFilter::Byte::kEcho:
      state_->counters.stray_bytes += static_cast<std::uint32_t>(echo_.answer_bytes());
      break;
    case EchoFilter::Byte::kOther: read_held(arrival); break;
  }
}

void SerialMaster::read_held(FieldTime arrival) {
  for (const std::uint8_t byte : echo_.held()) {
    framer_.append(byte);
    for (Found found = framer_.next(); found != Found::kNothing; found = framer_.next()) {
      take(found, arrival);
    }
  }
}

void SerialMaster::end_with_silence() {
  const FieldTime now = clock_->now();
  if (echo_.holds()) {
    echo_.let_go();
    read_held(now);
  }
  take(framer_.silence(), now);
  send();
}

void SerialMaster::take(Found found, FieldTime arrival) {
  if (found == Found::kNothing) {
    return;
  }
  if (found == Found::kRequest && echo_.is_echo(framer_.request(), arrival)) {
    state_->counters.stray_bytes += static_cast<std::uint32_t>(echo_.answer_bytes());
    return;
  }
  // A master that asks again has given up what it asked before, and would take an answer to that
  // for one to this.
  abandon();
  if (found == Found::kRequest) {
    answer_ = conversation_.take(framer_.request(), arrival);
    return;
  }
  const std::uint8_t function = framer_.request().front();
  if (function == kWriteOneFunction || function == kWriteManyFunction) {
    static_cast<void>(conversation_.take(framer_.request(), arrival));  // obeyed, not answered
  }
}

void SerialMaster::abandon() {
  if (answer_ || conversation_.waits()) {
    ++state_->counters.abandoned_answers;
  }
  answer_.reset();
  conversation_.abandon();
}

void SerialMaster::finish() {
  if (auto answer = conversation_.finish(clock_->now())) {
    answer_ = answer;
    if (framer_.waits() || echo_.holds()) {
      abandon();  // the master speaks already, and would not hear it
    }
    send();
  }
}

void SerialMaster::send() {
  if (!answer_ || !line_.is_open()) {
    return;
  }
  RtuFrame frame;
  RtuFramer::wrap(service_.unit, answer_->pdu.view(), frame);
  const auto size = static_cast<std::size_t>(frame.size());
  if (write(line_.descriptor(), frame.begin(), size) == static_cast<ssize_t>(size)) {
    const FieldTime now = clock_->now();
    // The answer is on its way for as long as a request of as many bytes after it.
    echo_.expect(frame, now + 2 * time_of(frame.size(), service_.line.baud));
    count_answer(*answer_, now, state_->counters);
  } else {
    ++state_->counters.abandoned_answers;
  }
  answer_.reset();
}

}  // namespace tubesight::drivers
