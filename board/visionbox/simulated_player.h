#pragma once

#include <memory>

#include "board/visionbox/field_player.h"
#include "drivers/simulated/scenario.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::board {

/// Plays a scenario: draws each field shortly before its instant, in the light that the box wants.
/// With `script` its robot and its operator say what the scenario tells.
class SimulatedPlayer final : public FieldPlayer {
 public:
  /// `scenario` was read by load_scenario() and outlives the player.
  SimulatedPlayer(const drivers::Scenario& scenario, bool script);

  [[nodiscard]] core::Result<void> start(drivers::Messages& messages) override;
  void stop() override {}
  [[nodiscard]] core::Result<void> next(std::int32_t lamp_permille, PlayedField& out,
                                        drivers::Messages& messages) override;
  [[nodiscard]] core::FieldTime span() const override;
  [[nodiscard]] bool has_lamp() const override { return true; }
  [[nodiscard]] std::int32_t fields_ahead() const override { return 2; }

 private:
  const drivers::Scenario* scenario_;
  bool script_;
  std::unique_ptr<drivers::SimulatedWorld> world_;
  drivers::SimulatedField field_;
};

}  // namespace tubesight::board
