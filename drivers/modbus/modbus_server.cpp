#include "drivers/modbus/modbus_server.h"

namespace tubesight::drivers {

using core::Result;

ModbusServer::ModbusServer(const ModbusSettings& settings, const LinkIdentity& identity,
                           Exchange& exchange, const hal::Clock& clock)
    : settings_(settings),
      exchange_(&exchange),
      clock_(&clock),
      state_{.identity = identity,
             .sighting = {},
             .sequence = 0,
             .health = {},
             .self_test = {},
             .journal = {},
             .counters = {}},
      outbox_(exchange.events),
      serial_(settings.serial, settings.word_order, state_, outbox_, clock),
      masters_{{{settings.serial.unit, settings.word_order, state_, outbox_, clock},
                {settings.serial.unit, settings.word_order, state_, outbox_, clock},
                {settings.serial.unit, settings.word_order, state_, outbox_, clock},
                {settings.serial.unit, settings.word_order, state_, outbox_, clock}}} {}

Result<void> ModbusServer::open() {
  const auto opened = [this]() -> Result<void> {
    if (!settings_.serial.line.device.empty()) {
      TUBESIGHT_TRY(serial_.open());
    }
    return settings_.tcp_port >= 0 ? listener_.open(settings_.tcp_address, settings_.tcp_port)
                                   : Result<void>();
  }();
  if (!opened) {
    close();
  }
  tell_loop();
  return opened;
}

void ModbusServer::close() {
  serial_.close();
  listener_.close();
  for (TcpMaster& master : masters_) {
    master.close();
  }
}

void ModbusServer::run() {
  while (!exchange_->stopping.load()) {
    wait();
    take_news();
    serial_.serve(poll_);
    serial_.finish();
    for (TcpMaster& master : masters_) {
      master.finish();
      master.serve(poll_);
    }
    if (poll_.readable(listener_.descriptor())) {
      accept_master();
    }
    tell_loop();
    ++exchange_->rounds;
  }
}

void ModbusServer::wait() {
  poll_.clear();
  poll_.add(exchange_->wake_descriptor());
  poll_.add(listener_.descriptor());
  serial_.add_to(poll_);
  for (const TcpMaster& master : masters_) {
    master.add_to(poll_);
  }
  poll_.wait();
}

/// What the loop has said since the last time, before anybody is answered from it.
void ModbusServer::take_news() {
  exchange_->clear_wake();
  Exchange::Shown shown;
  // In the rare case that the writer is at work for as long as 16 copies, the one before counts,
  // and grows old.
  if (exchange_->shown.try_read(shown)) {
    state_.sighting = shown.sighting;
    state_.sequence = shown.sequence;
  }
  LinkHealth health;
  if (exchange_->health.try_read(health)) {
    state_.health = health;
  }
  LinkSelfTest self_test;
  if (exchange_->self_test.try_read(self_test)) {
    state_.self_test = self_test;
  }
  LinkJournal journal;
  if (exchange_->journal.try_read(journal)) {
    state_.journal = journal;
  }
  core::Reply reply;
  while (exchange_->replies.try_pop(reply)) {
    const core::FieldTime now = clock_->now();
    serial_.hear(reply, now);
    for (TcpMaster& master : masters_) {
      master.hear(reply, now);
    }
  }
}

void ModbusServer::accept_master() {
  const int descriptor = listener_.accept();
  if (descriptor < 0) {
    return;
  }
  // Where there is no room the one that was silent longest goes: its other end may be long gone.
  TcpMaster* place = &masters_[0];
  for (TcpMaster& master : masters_) {
    if (!master.is_open()) {
      place = &master;
      break;
    }
    if (master.heard() < place->heard()) {
      place = &master;
    }
  }
  place->open(descriptor);
}

void ModbusServer::tell_loop() {
  const LinkCounters& counters = state_.counters;
  exchange_->counters.publish(counters);
  exchange_->losses.store(counters.crc_errors + counters.cut_frames + counters.dropped_events);
  exchange_->connected.store(serial_.is_open() || listener_.descriptor() >= 0);
}

}  // namespace tubesight::drivers
