#include "board/visionbox/kept_link.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/real_time.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr MonotonicTime kTryEvery = std::chrono::seconds(1);

std::string name_of(const drivers::ModbusSettings& settings) {
  std::string name = settings.serial.line.device;
  if (settings.tcp_port >= 0) {
    name += name.empty() ? "" : " and ";
    name += "TCP " + settings.tcp_address + ":" + std::to_string(settings.tcp_port);
  }
  return name;
}

void begin_like_others() {
  use_signal_stack();
  name_this_thread("link");
}

void begin_before_others() {
  begin_like_others();
  // Who may not, may not have the tracking thread in real time either, and that is told.
  static_cast<void>(schedule_before_others());
}

}  // namespace

KeptLink::KeptLink(const drivers::ModbusSettings& settings, const drivers::LinkIdentity& identity,
                   const hal::Clock& clock, Rank rank, Tell tell)
    : link_(settings, identity, clock,
            rank == Rank::kBeforeOthers ? begin_before_others : begin_like_others),
      where_(name_of(settings)),
      tell_(std::move(tell)) {}

Result<void> KeptLink::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  started_ = true;
  told_ = false;
  try_to_open(monotonic_now());
  return {};
}

void KeptLink::stop() {
  started_ = false;
  open_ = false;
  link_.stop();
}

void KeptLink::look_after(MonotonicTime now) {
  if (started_ && !open_ && now >= next_) {
    try_to_open(now);
  }
  if (open_ && connected_ != link_.connected()) {
    connected_ = !connected_;
    tell_(connected_ ? "link: the line is back" : "link: the line is gone, to be opened again");
  }
}

void KeptLink::try_to_open(MonotonicTime now) {
  next_ = now + kTryEvery;
  errno = 0;
  if (const auto opened = link_.start(); !opened) {
    const std::string why = opened.error() == Error::kUnsupported
                                ? "its driver cannot switch RS-485"
                            : errno != 0 ? std::strerror(errno)
                                         : "no reason given";
    if (!std::exchange(told_, true)) {
      tell_("link: cannot be opened: " + where_ + ": " + why +
            "; the box goes on without a robot and tries again");
    }
    return;
  }
  tell_("link: open: " + where_);
  open_ = true;
  connected_ = true;
}

Result<std::optional<core::Event>> KeptLink::poll_event() {
  if (!open_) {
    return Unexpected(Error::kDisconnected);
  }
  return link_.poll_event();
}

Result<void> KeptLink::send_reply(const core::Reply& reply) {
  return open_ ? link_.send_reply(reply) : Result<void>(Unexpected(Error::kDisconnected));
}

Result<void> KeptLink::send_sighting(const core::Sighting& sighting) {
  return open_ ? link_.send_sighting(sighting) : Result<void>(Unexpected(Error::kDisconnected));
}

LinkReport KeptLink::report() const {
  LinkReport report;
  report.open = open_ && link_.connected();
  if (!link_.counters(report.counters)) {
    report.counters = {};
  }
  return report;
}

}  // namespace tubesight::board
