#include "core/calibration/tsai_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {
namespace {

/// What the radial alignment tells of a view: all of its pose but the distance, of which the tilt's
/// sense is open.
struct Alignment {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< Tx, Ty of the template's origin
  bool flat = true;  ///< of a plane template; of another the tilt is told
};

Eigen::Vector2d on_sensor(const Sensor& sensor, const Eigen::Vector2d& pixel) {
  return {sensor.column_mm * (pixel.x() - 0.5 * (sensor.width_px - 1.0)),
          sensor.row_mm * (pixel.y() - 0.5 * (sensor.height_px - 1.0))};
}

/// The rotation of the upper left 2 x 2 part; r3 is not negative.
Eigen::Matrix3d complete(double r1, double r2, double r4, double r5) {
  const double r3 = std::sqrt(std::max(0.0, 1.0 - r1 * r1 - r2 * r2));
  const double r6 =
      (r1 * r4 + r2 * r5 > 0.0 ? -1.0 : 1.0) * std::sqrt(std::max(0.0, 1.0 - r4 * r4 - r5 * r5));
  Eigen::Vector3d x(r1, r2, r3);
  Eigen::Vector3d y(r4, r5, r6);
  x.normalize();
  y = (y - y.dot(x) * x).normalized();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), y.transpose(), x.cross(y).transpose();
  return rotation;
}

/// A dot's place on the template, and its image on the sensor from the picture's middle.
struct Origin {
  Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();
  Eigen::Vector2d image_mm = Eigen::Vector2d::Zero();
};

/// The dot that is farthest from the axis in v: Ty divides all, so the origin goes there.
Origin farthest_dot(const CalibrationData& data, const CalibrationView& view) {
  Origin farthest{data.dots[view.first].place_mm,
                  on_sensor(data.sensor, data.dots[view.first].seen_px)};
  for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
    const Eigen::Vector2d image_mm = on_sensor(data.sensor, data.dots[i].seen_px);
    if (std::abs(image_mm.y()) > std::abs(farthest.image_mm.y())) {
      farthest = {data.dots[i].place_mm, image_mm};
    }
  }
  return farthest;
}

/// The radial alignment's equations row . a = d_x of all dots, by least squares; `row_of` makes a
/// row of a dot's place from the origin w and its image d. False: they do not tell all of a.
template <int N, typename RowOf>
bool solve_alignment(const CalibrationData& data, const CalibrationView& view,
                     const Eigen::Vector3d& origin, const RowOf& row_of,
                     Eigen::Matrix<double, N, 1>& a) {
  Eigen::Matrix<double, N, N> normal = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> right = Eigen::Matrix<double, N, 1>::Zero();
  for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
    const Eigen::Vector2d d = on_sensor(data.sensor, data.dots[i].seen_px);
    const Eigen::Matrix<double, N, 1> row = row_of(data.dots[i].place_mm - origin, d);
    normal += row * row.transpose();
    right += d.x() * row;
  }
  math::Cholesky<N> factor;
  if (!factor.factor(normal, 1e-12)) {
    return false;
  }
  a = factor.solve(right);
  return true;
}

/// Of dots that do not lie in a plane, all of the rotation is linear [Tsai1987 sec. II-B]:
/// d_x (r4 X + r5 Y + r6 Z + Ty) = d_y (r1 X + r2 Y + r3 Z + Tx), over Ty.
bool align_solid(const CalibrationData& data, const CalibrationView& view, const Origin& origin,
                 Alignment& alignment) {
  using Row = Eigen::Matrix<double, 7, 1>;
  const auto row_of = [](const Eigen::Vector3d& w, const Eigen::Vector2d& d) {
    Row row;
    row << d.y() * w, d.y(), -d.x() * w;
    return row;
  };
  Row a;
  if (!solve_alignment<7>(data, view, origin.place_mm, row_of, a)) {
    return false;
  }
  const double scale = a.head<3>().squaredNorm() + a.tail<3>().squaredNorm();  // 2 / Ty^2
  const double ty = std::copysign(std::sqrt(2.0 / scale), origin.image_mm.y());
  const Eigen::Vector3d x = (a.head<3>() * ty).normalized();
  Eigen::Vector3d y = a.tail<3>() * ty;
  y = (y - y.dot(x) * x).normalized();
  alignment.flat = false;
  alignment.rotation << x.transpose(), y.transpose(), x.cross(y).transpose();
  alignment.shift << a(3) * ty, ty;
  return true;
}

/// Of a plane, of whose rotation the upper left 2 x 2 part is linear, over Ty; its sense is open.
bool align_flat(const CalibrationData& data, const CalibrationView& view, const Origin& origin,
                Alignment& alignment) {
  using Row = Eigen::Matrix<double, 5, 1>;
  const auto row_of = [](const Eigen::Vector3d& w, const Eigen::Vector2d& d) {
    Row row;
    row << d.y() * w.x(), d.y() * w.y(), d.y(), -d.x() * w.x(), -d.x() * w.y();
    return row;
  };
  Row a;  // r1/Ty, r2/Ty, Tx/Ty, r4/Ty, r5/Ty
  if (!solve_alignment<5>(data, view, origin.place_mm, row_of, a)) {
    return false;
  }
  const double sum = a(0) * a(0) + a(1) * a(1) + a(3) * a(3) + a(4) * a(4);
  const double cross = a(0) * a(4) - a(3) * a(1);
  const double ty2 = 2.0 / (sum + std::sqrt(std::max(0.0, sum * sum - 4.0 * cross * cross)));
  // The sense in which the images lie on the side of the axis that their places lie on.
  const double ty = std::copysign(std::sqrt(ty2), origin.image_mm.y());
  alignment.rotation = complete(a(0) * ty, a(1) * ty, a(3) * ty, a(4) * ty);
  alignment.shift << a(2) * ty, ty;
  return cross > 0.0;
}

/// All that the radial alignment tells of a view. False: its dots do not tell it.
bool align(const CalibrationData& data, const CalibrationView& view, Alignment& alignment) {
  const Origin origin = farthest_dot(data, view);
  if (!(is_solid(data, view) ? align_solid(data, view, origin, alignment)
                             : align_flat(data, view, origin, alignment))) {
    return false;
  }
  // From the farthest dot's place in the camera to that of the template's own origin.
  alignment.shift -= (alignment.rotation * origin.place_mm).head<2>();
  return alignment.rotation.allFinite();
}

/// Sums of the linear equations f p - d Tz = d (w + height), of EFL f and the distance Tz of the
/// template's origin.
struct Distance {
  double ff = 0.0;
  double fz = 0.0;
  double zz = 0.0;
  double f_right = 0.0;
  double z_right = 0.0;
  double right_right = 0.0;

  void add(const CalibrationData& data, const CalibrationView& view, const Alignment& alignment,
           double height_mm) {
    for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
      const Eigen::Vector2d d = on_sensor(data.sensor, data.dots[i].seen_px);
      const Eigen::Vector3d w = alignment.rotation * data.dots[i].place_mm;
      const Eigen::Vector2d p = w.head<2>() + alignment.shift;
      const Eigen::Vector2d right = d * (w.z() + height_mm);
      ff += p.squaredNorm();
      fz -= p.dot(d);
      zz += d.squaredNorm();
      f_right += p.dot(right);
      z_right -= d.dot(right);
      right_right += right.squaredNorm();
    }
  }
  /// What is left for EFL once the distance follows it: how well it is told, and its sum.
  [[nodiscard]] double weight() const { return ff - fz * fz / zz; }
  [[nodiscard]] double sum() const { return f_right - fz * z_right / zz; }
  [[nodiscard]] double distance(double focal) const { return (z_right - fz * focal) / zz; }
  /// What the equations leave at their best.
  [[nodiscard]] double rest() const {
    const double focal = sum() / weight();
    return right_right - focal * f_right - distance(focal) * z_right;
  }
};

/// The other tilt that shows the same by parallel projection.
Alignment mirrored(Alignment alignment) {
  if (!alignment.flat) {
    return alignment;
  }
  alignment.rotation(0, 2) *= -1.0;
  alignment.rotation(1, 2) *= -1.0;
  alignment.rotation(2, 0) *= -1.0;
  alignment.rotation(2, 1) *= -1.0;
  return alignment;
}

void set_pose(const Alignment& alignment, double distance, TargetPose& pose) {
  pose.R_camera_target = alignment.rotation;
  pose.t_camera_target << alignment.shift, distance;
}

}  // namespace

bool is_solid(const CalibrationData& data, const CalibrationView& view) {
  constexpr double kShare = 0.03;  // of its width: below, noise tilts the linear solution
  Eigen::Array3d least = Eigen::Array3d::Constant(HUGE_VAL);
  Eigen::Array3d most = -least;
  for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
    least = least.min(data.dots[i].place_mm.array());
    most = most.max(data.dots[i].place_mm.array());
  }
  const Eigen::Array3d size = most - least;
  return size.z() > kShare * std::max(size.x(), size.y());
}

bool start_from_views(const CalibrationData& data, CalibrationState& state) {
  StaticVector<Alignment, kMaxViews> alignments;
  std::array<Distance, 2> stage;  // of the tilts as they are, and mirrored
  double weight = 0.0;
  double sum = 0.0;
  std::int32_t first_staged = -1;
  for (std::int32_t i = 0; i < data.views.size(); ++i) {
    const CalibrationView& view = data.views[i];
    Alignment alignment;
    if (!align(data, view, alignment)) {
      return false;
    }
    if (view.staged) {
      first_staged = first_staged < 0 ? i : first_staged;
      stage[0].add(data, view, alignment, view.height_mm);
      stage[1].add(data, view, mirrored(alignment), view.height_mm);
    } else {
      Distance one;
      one.add(data, view, alignment, 0.0);
      if (one.sum() < 0.0) {
        alignment = mirrored(alignment);
        one = {};
        one.add(data, view, alignment, 0.0);
      }
      weight += one.weight();
      sum += one.sum();
    }
    static_cast<void>(alignments.try_push_back(alignment));
  }
  const bool other_way = first_staged >= 0 && stage[1].rest() < stage[0].rest();
  if (first_staged >= 0) {
    weight += stage[other_way ? 1 : 0].weight();
    sum += stage[other_way ? 1 : 0].sum();
  }
  const double focal = sum / weight;
  if (!(weight > 0.0) || !(focal > 0.0) || !std::isfinite(focal)) {
    return false;
  }
  state = {};
  state.camera << focal, 1.0, 0.5 * (data.sensor.width_px - 1.0),
      0.5 * (data.sensor.height_px - 1.0), 0.0, 0.0;
  for (std::int32_t i = 0; i < data.views.size(); ++i) {
    const CalibrationView& view = data.views[i];
    const Alignment alignment = view.staged && other_way ? mirrored(alignments[i]) : alignments[i];
    Distance one;
    one.add(data, view, alignment, 0.0);
    TargetPose pose;
    set_pose(alignment, one.distance(focal), pose);
    if (!(pose.t_camera_target.z() > 0.0)) {
      return false;
    }
    if (i == first_staged) {
      state.stage = pose;
      state.stage.t_camera_target -= view.height_mm * state.stage_axis;
    }
    static_cast<void>(state.poses.try_push_back(pose));
  }
  return true;
}

}  // namespace tubesight::core::calibration
