#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "core/base/static_vector.h"

namespace tubesight::core::calibration {

/// Local corrections that one field takes: "during an outage, there may be hundreds of these"
/// [Fallon sec. 5.3].
inline constexpr std::int32_t kMaxZones = 256;

/// What was seen at one place: vision's less the calibrated base's.
struct ZonePoint {
  Eigen::Vector2d at_mm = Eigen::Vector2d::Zero();
  Eigen::Vector3d off_mm = Eigen::Vector3d::Zero();
  double sigma_mm = 0.0;  ///< of that, one sigma an axis; above 0
};

/// One of them by a row of a file.
[[nodiscard]] inline ZonePoint zone_point(const std::array<double, 2>& at_mm,
                                          const std::array<double, 3>& off_mm, double sigma_mm) {
  return {{at_mm[0], at_mm[1]}, {off_mm[0], off_mm[1], off_mm[2]}, sigma_mm};
}

using ZonePoints = StaticVector<ZonePoint, kMaxZones>;

/// How what is seen at two places hangs together, by their distance.
enum class ZoneShape : std::uint8_t {
  kExponential,  ///< exp(-d): rough
  kMatern,       ///< (1 + d) exp(-d), with d = sqrt(3) distance / length: once differentiable
  kGaussian,     ///< exp(-d^2 / 2): smooth
};

/// What a place is to be corrected by.
struct ZoneCorrection {
  Eigen::Vector3d off_mm = Eigen::Vector3d::Zero();
  double across_mm = 0.0;  ///< one sigma an axis of the sheet
  double along_mm = 0.0;
};

/// Corrections between the places where they were seen: a Gaussian process [Rasmussen2006 ch. 2, 5]
/// whose covariance is the one, of three shapes and of lengths and sizes in steps, that makes what
/// was seen most likely. Far from all points the correction is 0, as uncertain as its size.
///
/// 0.6 MB: static or on the heap.
class ZoneField {
 public:
  /// Takes the points over and chooses. One point at least (asserted). Some 5 ms for 30 points, 3 s
  /// for 256.
  void choose(const ZonePoints& points);

  [[nodiscard]] ZoneCorrection at(const Eigen::Vector2d& place_mm) const;

  /// How far point i is from what all others say there: its square in the variances that it must
  /// have, of three axes, near 3. Large: it contradicts them.
  [[nodiscard]] double contradiction(std::int32_t i) const;
  /// The same of a point that is not one of the field's.
  [[nodiscard]] double contradiction(const ZonePoint& point) const;

  [[nodiscard]] ZoneShape shape() const { return shape_; }
  [[nodiscard]] double length_mm() const { return length_mm_; }
  [[nodiscard]] double across_mm() const { return size_mm_[0]; }
  [[nodiscard]] double along_mm() const { return size_mm_[1]; }

 private:
  static constexpr auto kMost = static_cast<std::size_t>(kMaxZones);

  [[nodiscard]] double correlation(double distance_mm) const;
  bool factor(std::size_t axis);
  void substitute(double* values) const;
  void forward(double* values) const;
  [[nodiscard]] double likelihood(std::size_t axis);
  void solve_for(std::size_t axis);

  ZonePoints points_;
  ZoneShape shape_ = ZoneShape::kMatern;
  double length_mm_ = 0.0;
  std::array<double, 2> size_mm_{};             ///< across, along: one sigma
  std::array<double, kMost * kMost> factor_{};  ///< lower triangle, of one of the two
  /// K^-1 y of x, y and z, and of each of the two kinds the diagonal of K^-1.
  std::array<std::array<double, kMost>, 3> weights_{};
  std::array<std::array<double, kMost>, 2> precision_{};
};

/// Beyond that a point contradicts a field: chi-square of three, one in 10^5.
inline constexpr double kZoneContradiction = 26.0;

}  // namespace tubesight::core::calibration
