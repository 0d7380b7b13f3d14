#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/overlay/painter.h"

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
  /// What is left of the miss once it is corrected.
  std::optional<Eigen::Vector2d> left_mm = std::nullopt;
};

/// What stands below the plan and its caption.
struct PlanFoot {
  std::int32_t height_px = 0;
  /// Draws it from this line of the picture down.
  std::function<void(core::overlay::Painter&, std::int32_t top_px)> draw;
};

/// A tubesheet as a plan, x to the right and y up: boxes from green (0) to red (1.25 mm and more),
/// arrows and misses 200 times as long as they are; what is left of a miss is green over it.
struct PlanPicture {
  std::vector<PlanPlace> places;  ///< one at least, or a mark
  std::vector<PlanPoint> marks;
  std::vector<std::string> caption;
  PlanFoot foot;
};

/// Draws it as a PNG. False, with one line in `message`, when it cannot be written.
[[nodiscard]] bool write_plan(const std::string& path, const PlanPicture& picture,
                              std::string& message);

}  // namespace tubesight::board
