#include "board/visionbox/simulated_player.h"

namespace tubesight::board {

using core::Error;
using core::Result;
using core::Unexpected;

SimulatedPlayer::SimulatedPlayer(const drivers::Scenario& scenario, bool script)
    : scenario_(&scenario), script_(script), world_(std::make_unique<drivers::SimulatedWorld>()) {}

Result<void> SimulatedPlayer::start(drivers::Messages& messages) {
  const auto configured = world_->configure(*scenario_);
  if (!configured) {
    messages.push_back("source: the scenario cannot be played");
  }
  return configured;
}

/// The scenario's own lamp commands reach the box as events, and the lamp by way of the box.
Result<void> SimulatedPlayer::next(std::int32_t lamp_permille, PlayedField& out,
                                   drivers::Messages& /*messages*/) {
  world_->set_lamp_permille(lamp_permille);
  if (!world_->next(field_)) {
    return Unexpected(Error::kEndOfData);
  }
  out.field = field_.field;
  out.events.clear();
  if (script_) {
    out.events = field_.events;
  }
  return {};
}

core::FieldTime SimulatedPlayer::span() const {
  return world_->slot_time(1) - world_->slot_time(0);
}

}  // namespace tubesight::board
