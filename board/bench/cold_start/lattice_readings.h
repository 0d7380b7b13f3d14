#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/settings.h"
#include "core/base/tube_address.h"
#include "core/detection/lattice_finder.h"
#include "core/pose/pose_model.h"

namespace tubesight::board {

/// One way in which the lattice found in a picture can lie on the sheet's, with one of its elements
/// on a given tube. A square sheet has four, a triangular one six, any other two.
struct LatticeReading {
  std::vector<core::TubeAddress> tubes;  ///< of the elements, as they are listed
  /// The tube (0, 0) of the lattice found and its steps, sheet frame.
  Eigen::Vector2d origin_mm = Eigen::Vector2d::Zero();
  Eigen::Vector2d column_mm = Eigen::Vector2d::Zero();
  Eigen::Vector2d row_mm = Eigen::Vector2d::Zero();
  /// Turns the sheet's directions into the camera's; by all elements.
  Eigen::Matrix3d R_camera_sheet = Eigen::Matrix3d::Identity();
  double rms_px = 0.0;  ///< of the elements' centres from where the reading puts them
};

/// Finds all readings of a lattice with element `anchor` on the tube `address`.
///
/// Sheet and picture turn the same way (both z axes point away from the tool), so that no reading
/// is a mirror image of another one. The elements' size tells the scale, to a quarter; the camera's
/// model tells a square lattice from one that is seen aslant. Empty: the lattice is none of this
/// sheet, or of this camera.
[[nodiscard]] std::vector<LatticeReading> find_readings(const core::detection::FoundLattice& found,
                                                        std::int32_t anchor,
                                                        core::TubeAddress address,
                                                        const core::pose::PoseModel& model,
                                                        const core::TubesheetSettings& sheet);

}  // namespace tubesight::board
