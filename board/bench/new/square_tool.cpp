#include "board/bench/new/square_tool.h"

#include <cmath>
#include <numbers>

#include "board/bench/calibrate/camera_text.h"
#include "core/calibration/imaging.h"
#include "core/math/rotation.h"
#include "core/pose/planar_pose.h"
#include "core/tubesheet/sheet_places.h"

namespace tubesight::board {
namespace {

constexpr double kBelow_mm = 50.0;     // of the tip, an ordinary height
constexpr double kLeastCosine = 0.26;  // of 75 degrees

core::pose::PointPairList pairs_of(const core::CameraSettings& camera,
                                   const core::TubesheetSettings& sheet,
                                   const LatticeFacts& lattice) {
  const core::calibration::Sensor sensor = core::calibration::sensor_of(camera);
  const core::calibration::CameraValues values = values_of(camera);
  core::pose::PointPairList pairs;
  for (const MeasuredPlace& place : lattice.places) {
    const auto from_middle = core::tubesheet::move_mm(sheet, place.from_middle);
    core::pose::PointPair pair;
    pair.object_mm = {from_middle[0], from_middle[1], 0.0};
    pair.plane = core::calibration::ideal_of(sensor, values, place.at_px) / camera.focal_length_mm;
    if (!pairs.try_push_back(pair)) {
      break;
    }
  }
  return pairs;
}

}  // namespace

std::optional<core::ToolSettings> square_tool(const core::CameraSettings& camera,
                                              const core::TubesheetSettings& sheet,
                                              const LatticeFacts& lattice) {
  const core::pose::PointPairList pairs = pairs_of(camera, sheet, lattice);
  const auto poses = core::pose::planar_poses({pairs.begin(), pairs.end()});
  if (!poses) {
    return {};
  }
  const auto& T_camera_sheet = poses->candidates[0].T_camera_sheet;
  const Eigen::Vector3d normal = T_camera_sheet.rotation().col(2);
  const Eigen::Vector3d tip = T_camera_sheet.translation_mm() - kBelow_mm * normal;
  constexpr double kFarthest_mm = 1000.0;
  if (normal.z() < kLeastCosine || !(tip.cwiseAbs().maxCoeff() < kFarthest_mm)) {
    return {};
  }
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  constexpr double kDigits = 1e4;  // more would be nobody's knowledge
  core::ToolSettings tool;
  const auto angles = core::math::angles_of(T_camera_sheet.rotation());
  for (std::size_t i = 0; i < 3; ++i) {
    tool.position_mm[i] = std::round(tip[static_cast<Eigen::Index>(i)] * kDigits) / kDigits;
    tool.rotation_deg[i] = std::round(angles[i] * kDegrees * kDigits) / kDigits;
  }
  return tool;
}

}  // namespace tubesight::board
