#pragma once

#include <array>
#include <cstdint>

#include "core/base/result.h"
#include "core/pose/calibration_uncertainty.h"
#include "core/pose/pose_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::board {

/// What adds to the tool's position as vision tells it.
enum class VisionItem : std::uint8_t {
  kFocalLength,
  kHorizontalScale,
  kCenterU,
  kCenterV,
  kDistortion,
  kDistortion2,
  kCamera,      ///< the six together, with their correlations
  kToolPlace,   ///< the tip in the camera frame
  kToolAxis,    ///< the guidetube's direction, where its axis meets the sheet
  kPicture,     ///< noise of a tube-end's centre in the picture
  kTubePlaces,  ///< tube-ends beside their places of the drawing
  kTogether,    ///< with what tip, axis and EFL have in common
};
inline constexpr std::size_t kVisionItems = 12;

/// Assumptions, one sigma.
struct VisionAssumptions {
  double height_mm = 40.0;     ///< of the sheet above the tip
  double center_px = 0.05;     ///< of a centre, each coordinate
  double tube_place_mm = 0.1;  ///< of a tube-end, each axis
};

/// One sigma of an item's share.
struct BudgetShare {
  double across_mm = 0.0;  ///< radially
  double along_mm = 0.0;
};

struct VisionBudget {
  std::array<BudgetShare, kVisionItems> shares{};
  std::int32_t tubes = 0;  ///< in the picture
};

/// The budget of a tool square below a tube in the middle of the sheet: each item's error is
/// carried through the fit of the pose to all tube-ends in the picture. Errors: kIllConditioned
/// fewer than four tube-ends are in view, or they do not tell the pose; kOutOfRange a changed
/// camera can't be made.
[[nodiscard]] core::Result<VisionBudget> vision_budget(
    const core::pose::PoseModel& model, const core::TubesheetSettings& sheet,
    const core::pose::CalibrationUncertainty& uncertainty, const VisionAssumptions& assumptions);

}  // namespace tubesight::board
