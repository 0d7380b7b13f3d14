#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/tracking/sheet_observer.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"
#include "core/tracking/tracking_setup.h"
#include "core/tubesheet/sheet_map.h"
#include "tests/support/scalars.h"
#include "tests/support/synthetic_sheet.h"

namespace tubesight::core::tracking {

using tests::Frame;
using tests::SyntheticSheet;
using tests::ToolPlace;

using tests::Scalars;

/// One bound for each kind of arithmetic.
template <typename S>
[[nodiscard]] constexpr double bound(double of_double, double of_float, double of_fixed) {
  if constexpr (std::is_same_v<S, double>) {
    return of_double;
  } else if constexpr (std::is_same_v<S, float>) {
    return of_float;
  } else {
    return of_fixed;
  }
}

template <typename T>
[[nodiscard]] double number(T value) {
  return static_cast<double>(value);
}
template <typename T>
[[nodiscard]] Eigen::Vector3d vector(const Vector3<T>& v) {
  return {number(v.x), number(v.y), number(v.z)};
}
template <typename T>
[[nodiscard]] Vector3<T> vector3(const Eigen::Vector3d& v) {
  return {T(v.x()), T(v.y()), T(v.z())};
}
template <typename T>
[[nodiscard]] double distance(const Vector2<T>& a, const std::array<double, 2>& b) {
  return std::hypot(number(a.x) - b[0], number(a.y) - b[1]);
}

/// A rotation matrix Rz(alpha) Ry(beta) Rx(gamma) by libm.
[[nodiscard]] inline Eigen::Matrix3d rotation_deg(double alpha, double beta, double gamma) {
  const double k = 3.14159265358979323846 / 180.0;
  const double a = alpha * k;
  const double b = beta * k;
  const double g = gamma * k;
  Eigen::Matrix3d z;
  z << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
  Eigen::Matrix3d y;
  y << std::cos(b), 0, std::sin(b), 0, 1, 0, -std::sin(b), 0, std::cos(b);
  Eigen::Matrix3d x;
  x << 1, 0, 0, 0, std::cos(g), -std::sin(g), 0, std::sin(g), std::cos(g);
  return z * y * x;
}

/// The pose that a tool place gives, from T_camera_sheet = T_camera_tool T_tool_sheet.
template <typename S>
[[nodiscard]] SheetPose<S> pose_at(const SessionSettings& settings, const SyntheticSheet& sheet,
                                   const ToolPlace& place, TubeAddress anchor) {
  const auto& r = settings.tool.rotation_deg;
  const auto& t = settings.tool.position_mm;
  const Eigen::Matrix3d R_camera_tool = rotation_deg(r[0], r[1], r[2]);
  const Eigen::Matrix3d R_sheet_tool =
      rotation_deg(place.alpha_deg, place.beta_deg, place.gamma_deg);
  const Eigen::Matrix3d R = R_camera_tool * R_sheet_tool.transpose();
  const auto center = sheet.center_of(anchor);
  const Eigen::Vector3d from_tip(center[0] - place.x_mm, center[1] - place.y_mm, place.height_mm);
  SheetPose<S> pose;
  pose.anchor = anchor;
  pose.x_axis = vector3<Unit<S>>(R.col(0));
  pose.y_axis = vector3<Unit<S>>(R.col(1));
  pose.normal = vector3<Unit<S>>(R.col(2));
  pose.origin = vector3<Mm<S>>(R * from_tip + Eigen::Vector3d(t[0], t[1], t[2]));
  return pose;
}

/// A session's settings, its drawn sheet and the model of the path, ready to use.
///
/// The settings are large: on the heap.
template <typename S>
struct Scene {
  std::unique_ptr<SessionSettings> settings = std::make_unique<SessionSettings>();
  TrackingModel<S> model{};
  std::unique_ptr<tubesheet::SheetMap> map = std::make_unique<tubesheet::SheetMap>();

  Scene() { tests::make_synthetic_settings(*settings); }

  /// After changes of the settings.
  void make() {
    ASSERT_TRUE(make_tracking_model<S>(*settings, model).has_value());
    ASSERT_TRUE(map->assign(settings->tubesheet).has_value());
  }
};

/// Over tube (20, 10), 60 mm below, turned by 2 degrees.
inline constexpr ToolPlace kOverTube{10 * 25.4, 20 * 25.4, 60.0, 2.0, 0.0, 0.0};
inline constexpr TubeAddress kTube{20, 10};

/// A scene with an observer that has begun, and the sheet that its pictures are drawn from.
template <typename S>
class ObservedScene : public ::testing::Test {
 protected:
  void SetUp() override {
    tests::make_synthetic_settings(*scene_.settings, 2);
    make();
  }
  /// After changes of the settings.
  void make() {
    scene_.make();
    sheet_ = std::make_unique<SyntheticSheet>(*scene_.settings);
    observer_ = std::make_unique<SheetObserver<S>>(scene_.model, *scene_.map);
    observer_->begin();
  }
  /// What is off in the tool's place by an observation of the tool at kOverTube.
  [[nodiscard]] double error_mm(const Observation<S>& seen) const {
    const auto axis = sheet_->axis_point(kOverTube);
    const auto center = sheet_->center_of(seen.pose.anchor);
    return distance(seen.tool.local, {axis[0] - center[0], axis[1] - center[1]});
  }

  Scene<S> scene_;
  std::unique_ptr<SyntheticSheet> sheet_;
  std::unique_ptr<SheetObserver<S>> observer_;
  Frame frame_;
};

}  // namespace tubesight::core::tracking
