#pragma once

#include <cstdint>
#include <span>

#include "core/base/settings.h"
#include "core/base/transform.h"
#include "core/calibration/camera_calibration.h"
#include "core/calibration/imaging.h"
#include "core/calibration/tool_calibration.h"
#include "core/math/small_matrix.h"
#include "core/picture/rim.h"
#include "core/pose/pose_estimate.h"
#include "core/pose/pose_model.h"

namespace tubesight::core::calibration {

/// The effective focal length (EFL) by one picture of tube-ends.
struct DockingFocal {
  bool solved = false;
  double focal_length_mm = 0.0;
  double sigma_mm = 0.0;  ///< the other parameters of the camera taken as exact
  /// Derivatives by h_sx, c_u, c_v, k, k2 of the camera taken (its own, by EFL, stays 0).
  math::Vector6d by_camera = math::Vector6d::Zero();
};

/// The EFL that fits the tube-ends' centres best, with the camera's pose [Fallon 4.4.2, 5.2.3].
///
/// Distance and EFL are told apart by perspective alone: a camera that looks square at the sheet
/// leaves both open, and the deviation says so. `estimate` is the pose by these rims with the
/// model's EFL; a centre weighs by its edge and by how far centres are off as found there. Where
/// the EFL found differs by more than its deviation, measure and call again with it.
[[nodiscard]] DockingFocal focal_by_docking(const pose::PoseModel& model,
                                            const picture::RimList& rims,
                                            const pose::PoseEstimate& estimate,
                                            pose::PoseWorkspace& workspace);

/// The EFL of one camera by several dockings, weighed by their deviations; where they scatter more
/// than these promise, the deviation grows with it. At least one, each solved.
[[nodiscard]] DockingFocal combined_focal(std::span<const DockingFocal> dockings);

/// Goes from EFL to EFL until one stays where it is found: what is measured with a wrong EFL leads
/// to a better one only.
class FocalWalk {
 public:
  enum class Step : std::uint8_t {
    kGoOn,       ///< measure with the EFL found
    kSettled,    ///< it is the one that was measured with, to a twentieth of its deviation; after
                 ///< twelve steps to half of it
    kElsewhere,  ///< more than a tenth beside that of the type: it is another type, or not told
    kRestless,   ///< after twelve steps it still moves by more
  };
  static constexpr int kMostSteps = 12;
  static constexpr double kMostChange = 0.1;

  explicit FocalWalk(double type_mm) : type_mm_(type_mm) {}

  /// Of what was found with the EFL `with_mm`.
  [[nodiscard]] Step take(const DockingFocal& found, double with_mm);

  /// How far what was found last is from what was measured with.
  [[nodiscard]] double change_mm() const { return change_mm_; }

 private:
  double type_mm_;
  int steps_ = 0;
  double change_mm_ = 0.0;
};

/// The covariance of all six parameters of the camera: EFL by dockings, the others as `covariance`
/// has them (its row and column of the EFL do not count). What is wrong with the others moves the
/// EFL found, so that they are correlated.
[[nodiscard]] math::Matrix6d camera_covariance(const DockingFocal& focal,
                                               const math::Matrix6d& covariance);

/// The uncertainty of the map from pixels to rays as map_uncertainty() tells it, but for what a
/// turn of the camera as a whole makes up for: docking takes such a turn into the tool's axes, so
/// that a centre that is off does little. For cameras that are used with a tool docked by
/// themselves.
[[nodiscard]] MapUncertainty map_beside_turn(const Sensor& sensor, const CameraValues& camera,
                                             const math::Matrix6d& covariance);

/// Derivatives of the tool's values (as of ToolCalibration) by the EFL, by those of each docking's
/// T_sheet_camera, (tau, theta) in the sheet frame to the millimetre of EFL.
[[nodiscard]] math::Vector6d tool_by_focal(const DockingList& dockings,
                                           std::span<const math::Vector6d> by_focal,
                                           const DockingAssumption& assumption);

}  // namespace tubesight::core::calibration
