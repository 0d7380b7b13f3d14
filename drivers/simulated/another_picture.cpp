#include "drivers/simulated/another_picture.h"

#include <Eigen/Core>

#include "core/tubesheet/sheet_places.h"
#include "drivers/simulated/dice.h"

namespace tubesight::drivers {

void AnotherPicture::show(const core::Field& field, const FieldFaults& faults,
                          const core::TubesheetSettings& sheet, const AnotherLamp& lamp,
                          std::uint64_t seed, core::rendering::Exposure& exposure) {
  std::optional<core::rendering::Exposure>& held = held_[static_cast<std::size_t>(field.parity)];
  if (!faults.frozen && !faults.other_camera) {
    held.reset();
    return;
  }
  if (!held) {
    held = exposure;
    const auto step_mm =
        core::tubesheet::move_mm(sheet, {faults.elsewhere[0], faults.elsewhere[1]});
    const core::Transform<core::frames::Sheet, core::frames::Sheet> elsewhere(
        Eigen::Matrix3d::Identity(), Eigen::Vector3d(step_mm[0], step_mm[1], 0.0));
    held->opened = elsewhere * held->opened;
    held->closed = elsewhere * held->closed;
  }
  const std::uint64_t noise_seed = exposure.noise_seed;
  exposure = *held;
  exposure.noise_seed = noise_seed;
  if (faults.other_camera) {
    constexpr std::int64_t kChip_ns = 50'000'000;
    const std::int64_t chip = (field.mid_exposure.count() + kChip_ns / 3) / kChip_ns;
    Dice dice(derived_seed(seed ^ 0x07E2'CA4EU, static_cast<std::uint64_t>(chip)));
    const double swing = dice.share() < 0.5 ? -lamp.swing : lamp.swing;
    swing_ += (swing - swing_) * lamp.following;
    exposure.lamp *= 1.0 + swing_;
  }
}

}  // namespace tubesight::drivers
