#include "core/rendering/view.h"

#include <cmath>

namespace tubesight::core::rendering {
namespace {

/// The rotation halfway between two that differ by less than a few degrees: their mean, made
/// orthonormal again. Halfway is exact to the third order of the angle.
Eigen::Matrix3d halfway(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  Eigen::Vector3d x;
  Eigen::Vector3d y;
  Eigen::Vector3d z;
  for (int row = 0; row < 3; ++row) {
    x(row) = a(row, 0) + b(row, 0);
    y(row) = a(row, 1) + b(row, 1);
    z(row) = 0.0;
  }
  const double xx = std::sqrt(x(0) * x(0) + x(1) * x(1) + x(2) * x(2));
  for (int row = 0; row < 3; ++row) {
    x(row) /= xx;
  }
  const double xy = x(0) * y(0) + x(1) * y(1) + x(2) * y(2);
  for (int row = 0; row < 3; ++row) {
    y(row) -= xy * x(row);
  }
  const double yy = std::sqrt(y(0) * y(0) + y(1) * y(1) + y(2) * y(2));
  for (int row = 0; row < 3; ++row) {
    y(row) /= yy;
  }
  z(0) = x(1) * y(2) - x(2) * y(1);
  z(1) = x(2) * y(0) - x(0) * y(2);
  z(2) = x(0) * y(1) - x(1) * y(0);
  Eigen::Matrix3d middle;
  for (int row = 0; row < 3; ++row) {
    middle(row, 0) = x(row);
    middle(row, 1) = y(row);
    middle(row, 2) = z(row);
  }
  return middle;
}

bool same(const Transform<frames::Sheet, frames::Tool>& a,
          const Transform<frames::Sheet, frames::Tool>& b) {
  double difference = 0.0;
  for (int row = 0; row < 3; ++row) {
    difference += std::abs(a.translation_mm()(row) - b.translation_mm()(row));
    for (int column = 0; column < 3; ++column) {
      difference += 300.0 * std::abs(a.rotation()(row, column) - b.rotation()(row, column));
    }
  }
  return difference < 1e-6;
}

}  // namespace

View::View(const Projection& projection,
           const Transform<frames::Camera, frames::Tool>& T_camera_tool, const Exposure& exposure)
    : projection_(projection), T_camera_tool_(exposure.knock * T_camera_tool) {
  moves_ = !same(exposure.opened, exposure.closed);
  Transform<frames::Sheet, frames::Tool> middle = exposure.opened;
  if (moves_) {
    Eigen::Vector3d between;
    for (int row = 0; row < 3; ++row) {
      between(row) =
          0.5 * (exposure.opened.translation_mm()(row) + exposure.closed.translation_mm()(row));
    }
    middle = {halfway(exposure.opened.rotation(), exposure.closed.rotation()), between};
  }
  T_tool_sheet_ = middle.inverse();
  T_camera_sheet_ = T_camera_tool_ * T_tool_sheet_;
  T_sheet_camera_ = T_camera_sheet_.inverse();
  const Transform<frames::Camera, frames::Sheet> opened =
      T_camera_tool_ * exposure.opened.inverse();
  const Transform<frames::Camera, frames::Sheet> closed =
      T_camera_tool_ * exposure.closed.inverse();
  for (Eigen::Index row = 0; row < 3; ++row) {
    change_(row) = closed.translation_mm()(row) - opened.translation_mm()(row);
    for (Eigen::Index column = 0; column < 3; ++column) {
      change_by_point_(row, column) =
          closed.rotation()(row, column) - opened.rotation()(row, column);
    }
  }
}

std::array<double, 2> View::motion(const std::array<double, 2>& pixel,
                                   const Eigen::Vector3d& sheet_mm) const {
  const Eigen::Vector3d at = T_camera_sheet_ * sheet_mm;
  if (!moves_ || !(at.z() > 1.0)) {
    return {0.0, 0.0};
  }
  const Eigen::Vector3d change = change_by_point_ * sheet_mm + change_;
  const double by_x = (change.x() - at.x() / at.z() * change.z()) / at.z();
  const double by_y = (change.y() - at.y() / at.z() * change.z()) / at.z();
  const RaySlopes slopes = projection_.ray_slopes(pixel[0], pixel[1]);
  const double determinant = slopes.xu * slopes.yv - slopes.xv * slopes.yu;
  return {(by_x * slopes.yv - by_y * slopes.xv) / determinant,
          (by_y * slopes.xu - by_x * slopes.yu) / determinant};
}

}  // namespace tubesight::core::rendering
