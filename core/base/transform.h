#pragma once

#include <array>

#include <Eigen/Core>

#include "core/base/frames.h"
#include "core/base/trigonometry.h"

namespace tubesight::core {

/// T_to_from: turns coordinates written in frame From into frame To, `p_to = T_to_from * p_from`.
///
/// Millimetres, double. Adjacent frames meet in a product; a wrong chain does not compile.
template <typename To, typename From>
class Transform {
 public:
  Transform() = default;
  /// `rotation` is a proper rotation matrix (not checked).
  Transform(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation_mm)
      : rotation_(rotation), translation_mm_(translation_mm) {}

  [[nodiscard]] const Eigen::Matrix3d& rotation() const { return rotation_; }
  [[nodiscard]] const Eigen::Vector3d& translation_mm() const { return translation_mm_; }

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point_mm) const {
    return rotation_ * point_mm + translation_mm_;
  }
  template <typename Further>
  [[nodiscard]] Transform<To, Further> operator*(const Transform<From, Further>& other) const {
    return {rotation_ * other.rotation(), rotation_ * other.translation_mm() + translation_mm_};
  }
  [[nodiscard]] Transform<From, To> inverse() const {
    return {rotation_.transpose(), -(rotation_.transpose() * translation_mm_)};
  }

 private:
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_mm_ = Eigen::Vector3d::Zero();
};

/// The rotation of the files: R = Rz(alpha) Ry(beta) Rx(gamma), angles in degrees [Fallon eq. 4.1].
/// The same bits on every machine.
[[nodiscard]] Eigen::Matrix3d rotation_from_degrees(const std::array<double, 3>& angles_deg);

}  // namespace tubesight::core
