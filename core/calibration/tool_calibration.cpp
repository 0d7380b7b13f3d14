#include "core/calibration/tool_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/base/assert.h"
#include "core/calibration/angle_slope.h"
#include "core/math/rotation.h"

namespace tubesight::core::calibration {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

constexpr double kDegrees = 180.0 / std::numbers::pi;

Transform<frames::Sheet, frames::Tool> docked(const Docking& docking,
                                              const DockingAssumption& assumption) {
  return {Eigen::AngleAxisd(assumption.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
          {docking.tip_mm.x(), docking.tip_mm.y(), -assumption.height_mm}};
}

/// The covariance of T_camera_tool = T_sheet_camera^-1 T_sheet_tool, perturbed on the left in the
/// camera frame: with p the camera's place, delta tip = R^T (-delta + (tip - p) x theta), and the
/// rotation vector is -R^T theta.
math::Matrix6d covariance_of(const Docking& docking, const DockingAssumption& assumption) {
  const Eigen::Matrix3d back = docking.T_sheet_camera.rotation().transpose();
  const Eigen::Vector3d arm =
      docked(docking, assumption).translation_mm() - docking.T_sheet_camera.translation_mm();
  math::Matrix6d slope = math::Matrix6d::Zero();
  slope.topLeftCorner<3, 3>() = -back;
  slope.topRightCorner<3, 3>() = back * math::skew(arm);
  slope.bottomRightCorner<3, 3>() = -back;
  return slope * docking.covariance * slope.transpose();
}

/// Of the tip in the camera frame and the offset o on the sheet that all dockings have: a docking's
/// tip, computed as if there were no offset, is t_i = t - R_i^T o - R_i^T e_i + noise, with e_i its
/// own error in the tube. Least squares weighed by the covariances, o known to the clearance.
class TipFit {
 public:
  explicit TipFit(double clearance_mm) : share_(0.5 * clearance_mm * clearance_mm) {
    normal_.bottomRightCorner<2, 2>().diagonal().setConstant(1.0 / std::max(share_, kLeast));
  }

  void add(const Docking& docking, const Eigen::Vector3d& tip, const Eigen::Matrix3d& noise) {
    Row row;
    row.slope = slope_of(docking);
    const auto across = row.slope.rightCols<2>();
    const Eigen::Matrix3d variance =
        noise + share_ * across * across.transpose() + kLeast * Eigen::Matrix3d::Identity();
    math::Cholesky<3> factor;
    const bool factored = factor.factor(variance);
    TUBESIGHT_ASSERT(factored);  // the diagonal is above 0
    row.weight = factor.inverse();
    normal_ += row.slope.transpose() * row.weight * row.slope;
    right_ += row.slope.transpose() * row.weight * tip;
    static_cast<void>(rows_.try_push_back(row));
  }

  void solve() {
    math::Cholesky<5> factor;
    const bool factored = factor.factor(normal_);
    TUBESIGHT_ASSERT(factored);  // each docking tells the tip, and the offset is known before
    covariance_ = factor.inverse();
    values_ = covariance_ * right_;
  }

  [[nodiscard]] const Vector5d& values() const { return values_; }
  [[nodiscard]] const Matrix5d& covariance() const { return covariance_; }
  /// What docking i's tip is off by, all told.
  [[nodiscard]] Eigen::Vector3d residual(std::int32_t i, const Eigen::Vector3d& tip) const {
    return tip - rows_[i].slope * values_;
  }
  /// d(tip) / d(tip of docking i).
  [[nodiscard]] Eigen::Matrix3d gain(std::int32_t i) const {
    return covariance_.topRows<3>() * rows_[i].slope.transpose() * rows_[i].weight;
  }

 private:
  using Slope = Eigen::Matrix<double, 3, 5>;
  struct Row {
    Slope slope;
    Eigen::Matrix3d weight;
  };
  static constexpr double kLeast = 1e-12;  // (1 nm)^2, where everything is given as known

  static Slope slope_of(const Docking& docking) {
    Slope slope;
    slope.leftCols<3>().setIdentity();
    slope.rightCols<2>() = -docking.T_sheet_camera.rotation().transpose().leftCols<2>();
    return slope;
  }

  double share_;
  Matrix5d normal_ = Matrix5d::Zero();
  Vector5d right_ = Vector5d::Zero();
  Vector5d values_ = Vector5d::Zero();
  Matrix5d covariance_ = Matrix5d::Zero();
  StaticVector<Row, kMaxDockings> rows_;
};

}  // namespace

ToolCalibration calibrate_tool(const DockingList& dockings, const DockingAssumption& assumption) {
  TUBESIGHT_ASSERT(!dockings.empty());
  StaticVector<Transform<frames::Camera, frames::Tool>, kMaxDockings> tools;
  StaticVector<math::Matrix6d, kMaxDockings> covariances;
  TipFit fit(assumption.clearance_mm);
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  for (const Docking& docking : dockings) {
    const auto tool = docking.T_sheet_camera.inverse() * docked(docking, assumption);
    const math::Matrix6d covariance = covariance_of(docking, assumption);
    fit.add(docking, tool.translation_mm(), covariance.topLeftCorner<3, 3>());
    axis += tool.rotation().col(2);
    static_cast<void>(tools.try_push_back(tool));
    static_cast<void>(covariances.try_push_back(covariance));
  }
  fit.solve();
  axis.normalize();

  ToolCalibration result;
  const Eigen::Vector3d tip = fit.values().head<3>();
  result.offset_mm = fit.values().tail<2>();
  result.offset_sigma_mm = fit.covariance().diagonal().tail<2>().cwiseSqrt();
  Eigen::Matrix3d rotation;
  const Eigen::Vector3d x = tools[0].rotation().col(0);
  rotation.col(0) = (x - x.dot(axis) * axis).normalized();
  rotation.col(2) = axis;
  rotation.col(1) = axis.cross(Eigen::Vector3d(rotation.col(0)));
  result.T_camera_tool = {rotation, tip};

  math::Matrix6d covariance = math::Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = fit.covariance().topLeftCorner<3, 3>();
  const double count = dockings.size();
  for (std::int32_t i = 0; i < tools.size(); ++i) {
    covariance.topRightCorner<3, 3>() +=
        fit.gain(i) * covariances[i].topRightCorner<3, 3>() / count;
    covariance.bottomRightCorner<3, 3>() +=
        covariances[i].bottomRightCorner<3, 3>() / (count * count);
    result.tip_spread_mm =
        std::max(result.tip_spread_mm, fit.residual(i, tools[i].translation_mm()).norm());
    result.axis_spread_rad =
        std::max(result.axis_spread_rad, tools[i].rotation().col(2).cross(axis).norm());
  }
  covariance.bottomLeftCorner<3, 3>() = covariance.topRightCorner<3, 3>().transpose();

  const std::array<double, 3> angles = math::angles_of(rotation);
  result.values << tip, kDegrees * angles[0], kDegrees * angles[1], kDegrees * angles[2];
  math::Matrix6d slope = math::Matrix6d::Identity();
  slope.bottomRightCorner<3, 3>() = angle_slope_deg(rotation);
  result.covariance = slope * covariance * slope.transpose();
  return result;
}

}  // namespace tubesight::core::calibration
