#include "board/bench/budget/vision_budget.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/camera/camera_setup.h"
#include "core/math/covariance.h"
#include "core/math/rotation.h"
#include "core/math/small_matrix.h"
#include "core/tubesheet/sheet_places.h"

namespace tubesight::board {
namespace {

using core::camera::CameraModel;
using Slope = Eigen::Matrix<double, 2, 6>;
using SheetToCamera = core::Transform<core::frames::Camera, core::frames::Sheet>;

/// A tube-end in view.
struct SeenTube {
  Eigen::Vector3d place_mm;  ///< sheet frame
  Eigen::Vector2d pixel;
};

Eigen::Vector2d on_plane(const Eigen::Vector3d& p) { return {p.x() / p.z(), p.y() / p.z()}; }

/// Derivatives of the image-plane point by a move (mm) and a turn (rad) of the sheet, both in the
/// camera frame.
Slope slope_at(const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 2, 3> by_place;
  by_place << 1.0 / p.z(), 0.0, -p.x() / (p.z() * p.z()), 0.0, 1.0 / p.z(),
      -p.y() / (p.z() * p.z());
  Slope slope;
  slope.leftCols<3>() = by_place;
  slope.rightCols<3>() = -by_place * core::math::skew(p);
  return slope;
}

class View {
 public:
  View(const core::pose::PoseModel& model, const core::TubesheetSettings& sheet,
       const VisionAssumptions& assumptions)
      : model_(model) {
    const core::TubeAddress middle{(sheet.rows[0] + sheet.rows[1]) / 2,
                                   (sheet.columns[0] + sheet.columns[1]) / 2};
    const Eigen::Vector2d under = model.center_mm(middle);
    T_sheet_tool_ = {Eigen::Matrix3d::Identity(), {under.x(), under.y(), -assumptions.height_mm}};
    T_camera_sheet_ = model.T_camera_tool * T_sheet_tool_.inverse();
    constexpr double kReach_mm = 400.0;
    const auto block = core::tubesheet::addresses_within(sheet, kReach_mm, {under.x(), under.y()});
    for (std::int32_t row = block.rows[0]; row <= block.rows[1]; ++row) {
      for (std::int32_t column = block.columns[0]; column <= block.columns[1]; ++column) {
        take({row, column}, sheet);
      }
    }
  }

  [[nodiscard]] const std::vector<SeenTube>& tubes() const { return tubes_; }

  /// The tip as the tube-ends tell it that a camera sees where ours does, mm. False: no pose.
  [[nodiscard]] bool tip_seen_by(const CameraModel<double>& camera, Eigen::Vector3d& tip) const {
    SheetToCamera pose = T_camera_sheet_;
    for (int step = 0; step < 8; ++step) {
      core::math::Matrix6d normal = core::math::Matrix6d::Zero();
      core::math::Vector6d right = core::math::Vector6d::Zero();
      for (const SeenTube& tube : tubes_) {
        const auto seen = camera.to_plane({tube.pixel.x(), tube.pixel.y()});
        const Eigen::Vector3d p = pose * tube.place_mm;
        const Slope slope = slope_at(p);
        normal += slope.transpose() * slope;
        right += slope.transpose() * (Eigen::Vector2d(seen.x, seen.y) - on_plane(p));
      }
      core::math::Cholesky<6> factor;
      if (!factor.factor(normal)) {
        return false;
      }
      const core::math::Vector6d move = factor.solve(right);
      const Eigen::Matrix3d turn = core::math::exp_rotation(move.tail<3>());
      pose = {turn * pose.rotation(), turn * pose.translation_mm() + move.head<3>()};
    }
    tip = (pose.inverse() * model_.T_camera_tool).translation_mm();
    return true;
  }

  /// The tip's covariance where each tube-end's image-plane point has that variance. The sheet's
  /// places count the same way, divided by their distance.
  [[nodiscard]] bool tip_spread(double plane_variance, Eigen::Matrix3d& spread) const {
    core::math::Matrix6d normal = core::math::Matrix6d::Zero();
    for (const SeenTube& tube : tubes_) {
      const Slope slope = slope_at(T_camera_sheet_ * tube.place_mm);
      normal += slope.transpose() * slope;
    }
    core::math::Cholesky<6> factor;
    if (!factor.factor(normal)) {
      return false;
    }
    const core::math::Matrix6d covariance = plane_variance * factor.inverse();
    // The tip stands still in the camera frame while the sheet moves by (m, theta): in the sheet
    // frame it goes by -R^T (m + theta x tip).
    Eigen::Matrix<double, 3, 6> by_pose;
    const Eigen::Matrix3d back = T_camera_sheet_.rotation().transpose();
    by_pose.leftCols<3>() = -back;
    by_pose.rightCols<3>() = back * core::math::skew(model_.T_camera_tool.translation_mm());
    spread = by_pose * covariance * by_pose.transpose();
    return true;
  }

  [[nodiscard]] double distance_mm() const {
    return (T_camera_sheet_ * tubes_.front().place_mm).z();
  }
  [[nodiscard]] const Eigen::Vector3d& tip() const { return T_sheet_tool_.translation_mm(); }
  [[nodiscard]] Eigen::Matrix3d R_sheet_camera() const {
    return T_camera_sheet_.rotation().transpose();
  }

 private:
  void take(core::TubeAddress address, const core::TubesheetSettings& sheet) {
    if (core::tubesheet::check_address(sheet, address) != core::tubesheet::AddressFault::kNone) {
      return;
    }
    const Eigen::Vector2d center = model_.center_mm(address);
    const Eigen::Vector3d place(center.x(), center.y(), 0.0);
    const Eigen::Vector3d p = T_camera_sheet_ * place;
    if (p.z() <= 0.0) {
      return;
    }
    const Eigen::Vector2d point = on_plane(p);
    const auto pixel = model_.camera.to_pixel({point.x(), point.y()});
    if (pixel && pixel->x >= 0.0 && pixel->y >= 0.0 &&
        pixel->x <= model_.camera_settings.width_px - 1.0 &&
        pixel->y <= model_.camera_settings.height_px - 1.0) {
      tubes_.push_back({place, {pixel->x, pixel->y}});
    }
  }

  const core::pose::PoseModel& model_;
  core::Transform<core::frames::Sheet, core::frames::Tool> T_sheet_tool_;
  SheetToCamera T_camera_sheet_;
  std::vector<SeenTube> tubes_;
};

BudgetShare share_of(const Eigen::Matrix3d& spread) {
  return {std::sqrt(std::max(0.0, spread(0, 0) + spread(1, 1))),
          std::sqrt(std::max(0.0, spread(2, 2)))};
}

/// Moves of the tip by one sigma of each parameter of the camera.
core::Result<Eigen::Matrix<double, 3, 6>> camera_moves(
    const View& view, const core::pose::PoseModel& model,
    const core::pose::CalibrationUncertainty& uncertainty) {
  Eigen::Matrix<double, 3, 6> moves = Eigen::Matrix<double, 3, 6>::Zero();
  for (std::size_t i = 0; i < uncertainty.camera_sigma.size(); ++i) {
    if (uncertainty.camera_sigma[i] == 0.0) {
      continue;
    }
    core::CameraSettings changed = model.camera_settings;
    core::pose::change_parameter(changed, static_cast<core::pose::CameraParameter>(i),
                                 uncertainty.camera_sigma[i]);
    const auto camera = core::camera::make_camera_model<double>(changed);
    if (!camera) {
      return core::Unexpected(camera.error());
    }
    Eigen::Vector3d tip;
    if (!view.tip_seen_by(*camera, tip)) {
      return core::Unexpected(core::Error::kIllConditioned);
    }
    moves.col(static_cast<Eigen::Index>(i)) = tip - view.tip();
  }
  return moves;
}

/// How the guidetube's direction on the sheet turns with the angles of `[tool]`, by degrees.
Eigen::Matrix3d axis_slope(const View& view, const core::pose::PoseModel& model) {
  // d(direction) = (turn) x (direction) = -skew(direction) (turn), and a turn by alpha, beta, gamma
  // is about z, Rz y, Rz Ry x.
  const Eigen::Matrix3d& R = model.T_camera_tool.rotation();
  const auto angles = core::math::angles_of(R);
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d::UnitZ();
  axes.col(1) = Eigen::Vector3d(-std::sin(angles[0]), std::cos(angles[0]), 0.0);
  axes.col(2) = R.col(0);
  return -view.R_sheet_camera() * core::math::skew(R.col(2)) * axes * (std::numbers::pi / 180.0);
}

/// Of the tool's six values with the EFL.
core::math::Vector6d tool_with_focal(const core::pose::CalibrationUncertainty& uncertainty) {
  core::math::Vector6d common;
  for (int i = 0; i < 6; ++i) {
    const auto at = static_cast<std::size_t>(i);
    common(i) = uncertainty.focal_length_correlation[at] * uncertainty.tool_sigma[at];
  }
  return common;
}

}  // namespace

core::Result<VisionBudget> vision_budget(const core::pose::PoseModel& model,
                                         const core::TubesheetSettings& sheet,
                                         const core::pose::CalibrationUncertainty& uncertainty,
                                         const VisionAssumptions& assumptions) {
  const View view(model, sheet, assumptions);
  if (view.tubes().size() < 4) {
    return core::Unexpected(core::Error::kIllConditioned);
  }
  const auto moves = camera_moves(view, model, uncertainty);
  if (!moves) {
    return core::Unexpected(moves.error());
  }
  VisionBudget budget;
  budget.tubes = static_cast<std::int32_t>(view.tubes().size());
  const auto put = [&](VisionItem item, const Eigen::Matrix3d& spread) {
    budget.shares[static_cast<std::size_t>(item)] = share_of(spread);
  };
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d move = moves->col(i);
    put(static_cast<VisionItem>(i), move * move.transpose());
  }
  const Eigen::Matrix3d camera = *moves * uncertainty.camera_correlation * moves->transpose();
  const core::math::Matrix6d tool =
      core::math::covariance_of(uncertainty.tool_sigma, uncertainty.tool_correlation);
  // By the tip, and by the axis where it meets the sheet; both together with what they have in
  // common, and with the EFL where one docking told it with them.
  const Eigen::Matrix3d at_sheet =
      Eigen::Vector3d(assumptions.height_mm, assumptions.height_mm, 0.0).asDiagonal() *
      axis_slope(view, model);
  Eigen::Matrix<double, 3, 6> by_tool;
  by_tool << view.R_sheet_camera(), at_sheet;
  const Eigen::Matrix3d place =
      by_tool.leftCols<3>() * tool.topLeftCorner<3, 3>() * by_tool.leftCols<3>().transpose();
  const Eigen::Matrix3d axis = at_sheet * tool.bottomRightCorner<3, 3>() * at_sheet.transpose();
  const Eigen::Matrix3d common =
      moves->col(0) * (by_tool * tool_with_focal(uncertainty)).transpose();
  const Eigen::Matrix3d calibrated =
      camera + by_tool * tool * by_tool.transpose() + common + common.transpose();
  const double pixels = model.camera.parameters().scale_px.x;
  const double in_plane = assumptions.center_px / pixels;
  const double tube_in_plane = assumptions.tube_place_mm / view.distance_mm();
  Eigen::Matrix3d picture;
  Eigen::Matrix3d tubes;
  if (!view.tip_spread(in_plane * in_plane, picture) ||
      !view.tip_spread(tube_in_plane * tube_in_plane, tubes)) {
    return core::Unexpected(core::Error::kIllConditioned);
  }
  put(VisionItem::kCamera, camera);
  put(VisionItem::kToolPlace, place);
  put(VisionItem::kToolAxis, axis);
  put(VisionItem::kPicture, picture);
  put(VisionItem::kTubePlaces, tubes);
  put(VisionItem::kTogether, calibrated + picture + tubes);
  return budget;
}

}  // namespace tubesight::board
