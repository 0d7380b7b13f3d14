#include "drivers/modbus/modbus_robot_link.h"

#include <sched.h>
#include <signal.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Event;
using core::Result;
using core::Unexpected;

/// The thread inherits the loop's real-time priority and the program's signals, and may have
/// neither; but a mistake's own signals, when they are blocked, kill without any handler.
void be_ordinary() {
  const sched_param ordinary{};
  static_cast<void>(sched_setscheduler(0, SCHED_OTHER, &ordinary));
  sigset_t all;
  sigfillset(&all);
  for (const int deadly : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS, SIGXCPU}) {
    sigdelset(&all, deadly);
  }
  static_cast<void>(pthread_sigmask(SIG_BLOCK, &all, nullptr));
}

}  // namespace

ModbusRobotLink::ModbusRobotLink(const ModbusSettings& settings, const LinkIdentity& identity,
                                 const hal::Clock& clock, void (*at_thread_start)())
    : server_(settings, identity, exchange_, clock), at_thread_start_(at_thread_start) {}

Result<void> ModbusRobotLink::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  if (exchange_.wake_descriptor() < 0) {
    return Unexpected(Error::kIo);
  }
  TUBESIGHT_TRY(server_.open());
  exchange_.stopping.store(false);
  losses_told_ = exchange_.losses.load();
  thread_ = std::thread([this] {
    be_ordinary();
    if (at_thread_start_ != nullptr) {
      at_thread_start_();
    }
    server_.run();
  });
  started_ = true;
  return {};
}

void ModbusRobotLink::stop() {
  if (!started_) {
    return;
  }
  started_ = false;
  exchange_.stopping.store(true);
  exchange_.wake();
  thread_.join();
  server_.close();
  Event event;
  while (exchange_.events.try_pop(event)) {
  }
  core::Reply reply;
  while (exchange_.replies.try_pop(reply)) {
  }
}

Result<void> ModbusRobotLink::usable() const {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  return exchange_.connected.load() ? Result<void>() : Unexpected(Error::kDisconnected);
}

Result<std::optional<Event>> ModbusRobotLink::poll_event() {
  if (const auto ready = usable(); !ready) {
    return Unexpected(ready.error());
  }
  if (const std::uint32_t losses = exchange_.losses.load(); losses != losses_told_) {
    losses_told_ = losses;
    return Unexpected(Error::kDataLoss);
  }
  Event event;
  return exchange_.events.try_pop(event) ? std::optional<Event>(event) : std::optional<Event>();
}

Result<void> ModbusRobotLink::send_reply(const core::Reply& reply) {
  TUBESIGHT_TRY(usable());
  if (!exchange_.replies.try_push(reply)) {
    return Unexpected(Error::kBufferTooSmall);
  }
  exchange_.wake();
  return {};
}

Result<void> ModbusRobotLink::send_sighting(const core::Sighting& sighting) {
  TUBESIGHT_TRY(usable());
  sequence_ = sequence_ == UINT32_MAX ? 1 : sequence_ + 1;
  exchange_.shown.publish({sighting, sequence_});
  return {};
}

}  // namespace tubesight::drivers
