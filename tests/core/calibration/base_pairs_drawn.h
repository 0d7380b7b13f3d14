#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "core/calibration/base_pairs.h"

namespace tubesight::core::calibration {

inline Eigen::Matrix3d turned_by(double alpha_deg, double beta_deg, double gamma_deg) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(alpha_deg * kDegree, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(beta_deg * kDegree, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(gamma_deg * kDegree, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// What pairs are drawn from.
struct PairDraw {
  Transform<frames::Sheet, frames::Base> T_sheet_base{turned_by(35.0, 0.3, -0.2),
                                                      {310.0, -140.0, -1003.0}};
  double turn_deg = 25.0;  ///< of X
  double across_mm = 0.0;  ///< noise of the robot, one sigma
  double along_mm = 0.0;
  double turn_rad = 0.0;
  bool turned = true;
};

/// A pair at each of these places, the tool 30 mm below the sheet and turned from pair to pair.
inline void draw_pairs(const std::vector<Eigen::Vector2d>& places, const PairDraw& draw,
                       std::uint32_t seed, BasePairs& pairs) {
  std::mt19937 source(seed);
  std::normal_distribution<double> normal;
  const auto draw3 = [&](double x, double y, double z) {
    return Eigen::Vector3d(x * normal(source), y * normal(source), z * normal(source));
  };
  pairs.clear();
  double heading = 10.0;
  for (const Eigen::Vector2d& place : places) {
    BasePair pair;
    pair.turned = draw.turned;
    pair.T_sheet_tool = {turned_by(heading, 0.4, -0.3), {place.x(), place.y(), -30.0}};
    const Eigen::Vector3d off = draw3(draw.across_mm, draw.across_mm, draw.along_mm);
    const Eigen::Vector3d turn = draw3(draw.turn_rad, draw.turn_rad, draw.turn_rad);
    const Transform<frames::Sheet, frames::Tool> robot{
        Eigen::AngleAxisd(turn.norm(), turn.norm() > 0.0 ? Eigen::Vector3d(turn.normalized())
                                                         : Eigen::Vector3d::UnitX()) *
            pair.T_sheet_tool.rotation() * turned_by(-draw.turn_deg, 0.0, 0.0),
        pair.T_sheet_tool.translation_mm() + off};
    pair.T_base_tool = draw.T_sheet_base.inverse() * robot;
    static_cast<void>(pairs.try_push_back(pair));
    heading += 47.0;
  }
}

/// Eight places over a generator.
inline std::vector<Eigen::Vector2d> eight_places() {
  return {{-600.0, -500.0}, {650.0, -420.0}, {580.0, 610.0}, {-540.0, 480.0},
          {40.0, -30.0},    {20.0, 700.0},   {-700.0, 20.0}, {300.0, -710.0}};
}

/// Every 200 mm of a square of 1.6 m.
inline std::vector<Eigen::Vector2d> generator_places() {
  std::vector<Eigen::Vector2d> places;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      places.emplace_back(200.0 * x, 200.0 * y);
    }
  }
  return places;
}

}  // namespace tubesight::core::calibration
