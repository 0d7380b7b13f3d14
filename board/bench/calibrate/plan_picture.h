#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tubesight::board {

/// A box of the sheet's plan: how well the tool is known there, and what it is corrected by.
struct PlanPlace {
  Eigen::Vector2d at_mm;
  double sigma_mm = 0.0;
  Eigen::Vector2d arrow_mm = Eigen::Vector2d::Zero();
};

enum class PlanMark : std::uint8_t { kPair, kCompared, kLeftOut, kBase, kNext };

/// What stands out on it.
struct PlanPoint {
  PlanMark mark = PlanMark::kPair;
  Eigen::Vector2d at_mm;
  Eigen::Vector2d miss_mm = Eigen::Vector2d::Zero();
  std::string name;
};

/// A tubesheet as a plan, x to the right and y up: boxes from green (0) to red (1.25 mm and more),
/// arrows and misses 200 times as long as they are.
struct PlanPicture {
  std::vector<PlanPlace> places;  ///< one at least
  std::vector<PlanPoint> marks;
  std::vector<std::string> caption;
};

/// Draws it as a PNG. False, with one line in `message`, when it cannot be written.
[[nodiscard]] bool write_plan(const std::string& path, const PlanPicture& picture,
                              std::string& message);

}  // namespace tubesight::board
