#include "core/picture/tube_scan.h"

#include <algorithm>
#include <cmath>

#include "core/edges/dynamic_threshold.h"
#include "core/picture/scan_path.h"

namespace tubesight::core::picture {
namespace {

using edges::DynamicThreshold;

// Tries of one edge, each at half the threshold of the one before.
constexpr int kAttempts = 4;

// A threshold that followed a bright edge would walk over the dim one on the other side: 20 grey
// levels of step under Eq. 5.1 are more than the inside of a tube-end ever shows.
constexpr std::int32_t kMostFollowed = 240;

// Rows and columns are scanned this far from the middle, as a share of the half height or width:
// beyond, the edge runs too nearly along the search.
constexpr double kScannedShare = 0.78;

// Neighbouring scans may differ by this much and the edge's slope.
constexpr double kContinuity_px = 2.5;

constexpr std::int32_t kFewestPoints = 12;

ScanEdge find_edge(const ScanPath& path, std::int32_t first, std::int32_t reach,
                   DynamicThreshold& threshold) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const ScanEdge edge = find_scan_edge(path, first, reach, threshold.for_taps(kScanTaps));
    if (edge.found) {
      threshold.follow(edge.gradient, kScanTaps, kMostFollowed);
      return edge;
    }
    if (threshold.at_least()) {
      break;
    }
    threshold.halve();
  }
  return {};
}

/// The dark around a place along one row or column.
struct Chord {
  bool found = false;
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] double middle() const { return (low + high) / 2.0; }
  [[nodiscard]] double half() const { return (high - low) / 2.0; }
};

/// Searches around a start point for the box of the dark.
class BoundarySearch {
 public:
  BoundarySearch(const AveragedPicture& picture, const ScanOptions& options,
                 DynamicThreshold& threshold)
      : picture_(picture), options_(options), threshold_(threshold) {}

  ScanRefusal run(double u_px, double v_px, Chord& across, Chord& down) {
    const auto inside = [](double place, std::int32_t size) {
      return place >= 3.0 && place <= size - 4.0;
    };
    if (!inside(u_px, picture_.width_px) || !inside(v_px, picture_.height_px)) {
      return ScanRefusal::kOutside;
    }
    down = chord(u_px, v_px, false);
    if (!down.found) {
      return ScanRefusal::kNoBoundary;
    }
    across = chord(u_px, down.middle(), true);
    if (!across.found) {
      return ScanRefusal::kNoBoundary;
    }
    const double click_level = level(u_px, v_px);
    down = chord(across.middle(), down.middle(), false);
    if (!down.found || across.half() < 5.0 || down.half() < 5.0) {
      return ScanRefusal::kNoBoundary;
    }
    // Between the level of the inside and that of the rim; a click on the sheet is above.
    const double inside_level = level(across.middle(), down.middle());
    if (click_level > inside_level + 0.5 * (rim_level(across, down) - inside_level)) {
      return ScanRefusal::kNotDark;
    }
    return ScanRefusal::kNone;
  }

 private:
  Chord chord(double u_px, double v_px, bool horizontal) {
    const auto u = static_cast<std::int32_t>(
        std::clamp<double>(std::round(u_px), 2.0, picture_.width_px - 3.0));
    const auto v = static_cast<std::int32_t>(
        std::clamp<double>(std::round(v_px), 2.0, picture_.height_px - 3.0));
    const double place = horizontal ? u : v;
    const ScanEdge low =
        find_edge(scan_path(picture_, u, v, horizontal, -1), 0, options_.reach_px, threshold_);
    const ScanEdge high =
        find_edge(scan_path(picture_, u, v, horizontal, 1), 0, options_.reach_px, threshold_);
    return {low.found && high.found, place - low.position, place + high.position};
  }

  /// Mean grey level of 3 by 3 pixels.
  [[nodiscard]] double level(double u_px, double v_px) const {
    const auto u = static_cast<std::int32_t>(
        std::clamp<double>(std::round(u_px), 1.0, picture_.width_px - 2.0));
    const auto v = static_cast<std::int32_t>(
        std::clamp<double>(std::round(v_px), 1.0, picture_.height_px - 2.0));
    std::int32_t sum = 0;
    for (std::int32_t dv = -1; dv <= 1; ++dv) {
      for (std::int32_t du = -1; du <= 1; ++du) {
        sum += picture_.at(u + du, v + dv);
      }
    }
    return sum / (9.0 * kGreyScale);
  }

  /// Mean level just outside the four boundaries.
  [[nodiscard]] double rim_level(const Chord& across, const Chord& down) const {
    constexpr double kOut_px = 3.0;
    return (level(across.low - kOut_px, down.middle()) +
            level(across.high + kOut_px, down.middle()) +
            level(across.middle(), down.low - kOut_px) +
            level(across.middle(), down.high + kOut_px)) /
           4.0;
  }

  const AveragedPicture& picture_;
  const ScanOptions& options_;
  DynamicThreshold& threshold_;
};

/// Scans rows or columns from the middle line outwards, moving away from the middle.
class OutwardScan {
 public:
  OutwardScan(const AveragedPicture& picture, const Chord& across, const Chord& down,
              DynamicThreshold threshold, Rim& rim)
      : picture_(picture), across_(across), down_(down), threshold_(threshold), rim_(rim) {}

  void run(bool horizontal, std::int32_t stride_px) {
    for (const std::int32_t side : {-1, 1}) {
      for (const std::int32_t away : {-1, 1}) {
        run_quarter(horizontal, side, away, stride_px);
      }
    }
  }

 private:
  void run_quarter(bool horizontal, std::int32_t side, std::int32_t away, std::int32_t stride_px) {
    const Chord& along = horizontal ? across_ : down_;
    const Chord& over = horizontal ? down_ : across_;
    const auto middle = static_cast<std::int32_t>(std::lround(over.middle()));
    const auto start = static_cast<std::int32_t>(std::lround(along.middle()));
    const auto last = static_cast<std::int32_t>(kScannedShare * over.half());
    const std::int32_t size = horizontal ? picture_.height_px : picture_.width_px;
    // The first scan follows from the boundary, each other from the one before.
    double previous = along.half();
    std::int32_t skipped = 0;
    for (std::int32_t i = away > 0 ? 0 : stride_px; i <= last; i += stride_px) {
      const std::int32_t line = middle + away * i;
      if (line < 2 || line > size - 3) {
        break;
      }
      const std::int32_t u = horizontal ? start : line;
      const std::int32_t v = horizontal ? line : start;
      const ScanPath path = scan_path(picture_, u, v, horizontal, side);
      // Start shortly inside the edge expected: what lies deeper in the tube-end is of no interest.
      const auto first = static_cast<std::int32_t>(std::max(0.0, previous - 12.0));
      const ScanEdge edge = find_edge(path, first, 24 + stride_px * 2, threshold_);
      const double share = i / std::max(1.0, over.half());
      const double slope = along.half() / std::max(1.0, over.half()) * share /
                           std::sqrt(std::max(0.1, 1.0 - share * share));
      const double allowed = kContinuity_px + 2.0 * (slope + 0.5) * stride_px * (skipped + 1);
      if (!edge.found || std::abs(edge.position - previous) > allowed) {
        ++skipped;
        continue;
      }
      skipped = 0;
      previous = edge.position;
      const double place = start + side * edge.position;
      static_cast<void>(rim_.points.try_push_back(
          horizontal ? RimPoint{place, static_cast<double>(line), 0.0, 0.0, 0.3}
                     : RimPoint{static_cast<double>(line), place, 0.0, 0.0, 0.3}));
    }
  }

  const AveragedPicture& picture_;
  const Chord& across_;
  const Chord& down_;
  DynamicThreshold threshold_;
  Rim& rim_;
};

}  // namespace

TubeScan scan_tube(const AveragedPicture& picture, double u_px, double v_px,
                   const ScanOptions& options, Rim& rim) {
  rim.points.clear();
  DynamicThreshold threshold(options.initial_threshold);
  TubeScan scan;
  Chord across;
  Chord down;
  BoundarySearch search(picture, options, threshold);
  scan.refusal = search.run(u_px, v_px, across, down);
  if (scan.refusal != ScanRefusal::kNone) {
    return scan;
  }
  scan.box_px = {across.low, down.low, across.high, down.high};
  OutwardScan outward(picture, across, down, threshold, rim);
  // All scans together must fit the rim: 2 (rows + columns) points.
  const double lines = 4.0 * kScannedShare * (across.half() + down.half()) + 4.0;
  const auto stride_px = static_cast<std::int32_t>(std::ceil(lines / kMaxRimPoints));
  outward.run(true, stride_px);
  outward.run(false, stride_px);
  if (rim.points.size() < kFewestPoints) {
    scan.refusal = ScanRefusal::kFewEdges;
  }
  return scan;
}

}  // namespace tubesight::core::picture
