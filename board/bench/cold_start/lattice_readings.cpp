#include "board/bench/cold_start/lattice_readings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "core/pose/n_point.h"
#include "core/pose/planar_pose.h"
#include "core/tubesheet/addresses.h"
#include "core/tubesheet/sheet_places.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::board {
namespace {

using core::TubeAddress;
using core::detection::FoundLattice;
using core::detection::LatticeElement;

// The steps found, which know no camera, are those of the sheet to these shares and this angle; the
// elements' radius is half the bore to a quarter. The next larger lattice of the same form has
// steps 1.41 times as long.
constexpr double kLengths = 0.15;
constexpr double kAngle_rad = 12.0 / 180.0 * std::numbers::pi;
constexpr double kSize = 0.25;

// A reading's residuals are at most this share of the step in the picture, and within this of those
// of the best one: two lattices of nearly the same form stay two readings.
constexpr double kMostOfStep = 0.05;
constexpr double kOfBest = 3.0;
constexpr double kOfBest_px = 0.3;

// Each element stands on a tube of the sheet's numbering to this share of its shortest step.
constexpr double kOnTube = 0.1;

// Addresses that a step leads to at most: neighbours of any numbering, also with long steps.
constexpr std::int32_t kReach = 4;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// The lattice's steps as a reading has them on the sheet.
struct SheetSteps {
  Eigen::Vector2d column_mm;
  Eigen::Vector2d row_mm;
};

bool agree(const SheetSteps& sheet, const core::detection::Steps& found, double bore_mm) {
  const double column = sheet.column_mm.norm() / found.column.norm();
  const double row = sheet.row_mm.norm() / found.row.norm();
  const double radius_mm = std::sqrt(column * row);
  return std::abs(column / row - 1.0) < kLengths &&
         std::abs(2.0 * radius_mm / bore_mm - 1.0) < kSize &&
         cross(sheet.column_mm, sheet.row_mm) > 0.0 &&
         std::abs(angle_between(sheet.column_mm, sheet.row_mm) -
                  angle_between(found.column, found.row)) < kAngle_rad;
}

/// Whether steps lead to every tube of a kind: a lattice of every other one is none that a picture
/// shows.
bool leave_out_none(const SheetSteps& steps, TubeAddress address,
                    const core::pose::PoseModel& model) {
  const auto& basis = model.lattice.parameters().basis;
  const Eigen::Vector2d here = model.center_mm(address);
  const Eigen::Vector2d a = model.center_mm(core::tubesheet::sum(address, basis[0])) - here;
  const Eigen::Vector2d b = model.center_mm(core::tubesheet::sum(address, basis[1])) - here;
  return cross(steps.column_mm, steps.row_mm) < 1.01 * std::abs(cross(a, b));
}

/// All pairs of steps of the sheet that look like the lattice's.
std::vector<SheetSteps> find_steps(const core::detection::Steps& found, TubeAddress address,
                                   const core::pose::PoseModel& model) {
  std::vector<Eigen::Vector2d> ways;
  for (std::int32_t row = -kReach; row <= kReach; ++row) {
    for (std::int32_t column = -kReach; column <= kReach; ++column) {
      const TubeAddress to = core::tubesheet::sum(address, {row, column});
      if ((row != 0 || column != 0) && model.lattice.has(to)) {
        ways.push_back(model.center_mm(to) - model.center_mm(address));
      }
    }
  }
  std::vector<SheetSteps> steps;
  for (const Eigen::Vector2d& column : ways) {
    for (const Eigen::Vector2d& row : ways) {
      if (agree({column, row}, found, model.bore_mm) &&
          leave_out_none({column, row}, address, model)) {
        steps.push_back({column, row});
      }
    }
  }
  return steps;
}

/// Where a pair of steps puts an element, from the anchor.
Eigen::Vector2d place_of(const SheetSteps& steps, const LatticeElement& anchor,
                         const LatticeElement& element) {
  return (element.column - anchor.column) * steps.column_mm +
         (element.row - anchor.row) * steps.row_mm;
}

/// The tubes of all elements; nothing when one stands on none of the numbering.
bool find_tubes(const FoundLattice& found, std::int32_t anchor, TubeAddress address,
                const SheetSteps& steps, const core::TubesheetSettings& sheet,
                std::vector<TubeAddress>& tubes) {
  const double most = kOnTube * core::tubesheet::shortest_step_mm(sheet);
  const auto from = core::tubesheet::center_mm(sheet, address);
  tubes.clear();
  for (const LatticeElement& element : found.elements) {
    const Eigen::Vector2d at =
        Eigen::Vector2d(from[0], from[1]) + place_of(steps, found.elements[anchor], element);
    const TubeAddress tube = core::tubesheet::nearest_address(sheet, {at.x(), at.y()});
    const auto center = core::tubesheet::center_mm(sheet, tube);
    if (std::hypot(center[0] - at.x(), center[1] - at.y()) > most) {
      return false;
    }
    tubes.push_back(tube);
  }
  return true;
}

/// The pose that a pair of steps gives, with its residuals.
bool fit_pose(const FoundLattice& found, std::int32_t anchor, const SheetSteps& steps,
              const core::pose::PoseModel& model, LatticeReading& reading) {
  std::vector<core::pose::PointPair> pairs;
  for (const LatticeElement& element : found.elements) {
    const Eigen::Vector2d at = place_of(steps, found.elements[anchor], element);
    const auto plane = model.camera.to_plane({element.center_px.x(), element.center_px.y()});
    core::pose::PointPair pair;
    pair.object_mm = {at.x(), at.y(), 0.0};
    pair.plane = {plane.x, plane.y};
    pairs.push_back(pair);
  }
  const auto planar = core::pose::planar_poses(pairs);
  if (!planar) {
    return false;
  }
  double best = std::numeric_limits<double>::infinity();
  for (const core::pose::PoseCandidate& candidate : planar->candidates) {
    const auto pose = core::pose::solve_n_point(pairs, candidate.T_camera_sheet, {});
    if (pose && pose->rms < best) {
      best = pose->rms;
      reading.R_camera_sheet = pose->T_camera_sheet.rotation();
    }
  }
  reading.rms_px = best * model.camera.parameters().scale_px.x;
  return std::isfinite(best);
}

/// The median distance of elements that follow each other in a row or a column.
double step_px(const FoundLattice& found) {
  std::vector<double> steps;
  for (const LatticeElement& a : found.elements) {
    for (const LatticeElement& b : found.elements) {
      if (std::abs(a.row - b.row) + std::abs(a.column - b.column) == 1) {
        steps.push_back((a.center_px - b.center_px).norm());
      }
    }
  }
  if (steps.empty()) {
    return 0.0;
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

std::vector<LatticeReading> find_readings(const FoundLattice& found, std::int32_t anchor,
                                          TubeAddress address, const core::pose::PoseModel& model,
                                          const core::TubesheetSettings& sheet) {
  std::vector<LatticeReading> readings;
  double best = kMostOfStep * step_px(found);
  for (const SheetSteps& steps : find_steps(found.steps, address, model)) {
    LatticeReading reading;
    const auto from = core::tubesheet::center_mm(sheet, address);
    reading.column_mm = steps.column_mm;
    reading.row_mm = steps.row_mm;
    reading.origin_mm = Eigen::Vector2d(from[0], from[1]) -
                        found.elements[anchor].column * steps.column_mm -
                        found.elements[anchor].row * steps.row_mm;
    if (find_tubes(found, anchor, address, steps, sheet, reading.tubes) &&
        fit_pose(found, anchor, steps, model, reading) &&
        std::none_of(readings.begin(), readings.end(),
                     [&](const LatticeReading& other) { return other.tubes == reading.tubes; })) {
      readings.push_back(std::move(reading));
    }
  }
  for (const LatticeReading& reading : readings) {
    best = std::min(best, kOfBest * reading.rms_px + kOfBest_px);
  }
  readings.erase(std::remove_if(readings.begin(), readings.end(),
                                [&](const LatticeReading& r) { return r.rms_px > best; }),
                 readings.end());
  return readings;
}

}  // namespace tubesight::board
