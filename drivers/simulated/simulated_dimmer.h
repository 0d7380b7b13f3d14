#pragma once

#include <cstdint>
#include <optional>

#include "core/base/result.h"
#include "drivers/simulated/simulated_world.h"
#include "hal/dimmer.h"

namespace tubesight::drivers {

/// The dimmer of a simulated world: the next field is exposed in the level's light, as far as the
/// lamp's lag (SimulatedLight::lag_s) lets it.
///
/// A lamp that the scenario's faults make fail takes every level all the same.
class SimulatedDimmer final : public hal::Dimmer {
 public:
  /// `world` outlives the dimmer. start() comes after that of the world's frame grabber, which
  /// resets the lamp to the scenario's level.
  explicit SimulatedDimmer(SimulatedWorld& world) : world_(&world) {}

  [[nodiscard]] core::Result<void> start() override;
  void stop() override;
  [[nodiscard]] core::Result<void> set_level(std::int32_t permille) override;
  [[nodiscard]] std::int32_t level_permille() const override { return level_permille_; }

  /// From now on the device answers every level with `error` and the lamp stays as it is.
  void break_down(core::Error error) { failure_ = error; }
  /// It obeys again.
  void repair() { failure_.reset(); }

 private:
  SimulatedWorld* world_;
  std::optional<core::Error> failure_;
  std::int32_t level_permille_ = 0;
  bool started_ = false;
};

}  // namespace tubesight::drivers
