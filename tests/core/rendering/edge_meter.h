#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "core/base/settings.h"
#include "core/base/transform.h"

namespace tubesight::core::rendering::tests_of_edges {

/// Where a camera's rays go, from the formulas of conventions.md and the settings alone.
class Rays {
 public:
  Rays(const CameraSettings& camera, const ToolSettings& tool,
       const Transform<frames::Sheet, frames::Tool>& T_sheet_tool)
      : camera_(camera), R_tool_camera_(rotation_from_degrees(tool.rotation_deg).transpose()) {
    const Eigen::Vector3d tip(tool.position_mm[0], tool.position_mm[1], tool.position_mm[2]);
    eye_tool_ = R_tool_camera_ * (-tip);
    R_sheet_tool_ = T_sheet_tool.rotation();
    eye_sheet_ = T_sheet_tool * eye_tool_;
  }

  /// Of a pixel: eye and direction, tool frame.
  [[nodiscard]] const Eigen::Vector3d& eye_tool() const { return eye_tool_; }
  [[nodiscard]] Eigen::Vector3d way_tool(double u, double v) const {
    const double x = camera_.cell_width_mm / camera_.horizontal_scale * camera_.sensor_columns /
                     camera_.frame_columns * (u - camera_.center_px[0]);
    const double y = camera_.cell_height_mm * (v - camera_.center_px[1]);
    const double m = 1.0 + camera_.distortion_per_mm2 * (x * x + y * y);
    return R_tool_camera_ * Eigen::Vector3d(x * m, y * m, camera_.focal_length_mm);
  }

  /// Where a pixel's ray meets the plane z of the sheet frame.
  [[nodiscard]] std::array<double, 2> on_sheet(double u, double v, double z_mm) const {
    const Eigen::Vector3d way = R_sheet_tool_ * way_tool(u, v);
    const double along = (z_mm - eye_sheet_.z()) / way.z();
    return {eye_sheet_.x() + along * way.x(), eye_sheet_.y() + along * way.y()};
  }

 private:
  CameraSettings camera_;
  Eigen::Matrix3d R_tool_camera_;
  Eigen::Matrix3d R_sheet_tool_;
  Eigen::Vector3d eye_tool_;
  Eigen::Vector3d eye_sheet_;
};

/// Distance of what a pixel shows from an edge in mm, negative inside, at a share 0..1 of the
/// exposure; far from all edges anything beyond `kNoEdge`.
using Beyond = std::function<double(double u, double v, double share)>;
inline constexpr double kNoEdge = 1e3;

/// How a picture's edges are looked at.
struct EdgeLook {
  double bell_px = 1.85;   ///< an edge is felt up to here on both sides
  double motion_px = 0.0;  ///< most that an edge moves in the exposure
  double inner_mm = 1e3;   ///< the level is even up to here inwards of the edge ...
  double outer_mm = 1e3;   ///< ... and outwards
  int border_px = 12;      ///< pixels left out along the sides
  int instants = 1;        ///< of the exposure that an edge is averaged over; 1: its middle
};

/// What was found.
struct EdgeErrors {
  int count = 0;   ///< edges measured
  int missed = 0;  ///< places where an edge must be and none was found
  double largest_px = 0.0;
  double square_sum = 0.0;

  [[nodiscard]] double rms_px() const { return std::sqrt(square_sum / std::max(count, 1)); }
};

/// The inverse of 1/2 + 15/16 t - 5/8 t^3 + 3/16 t^5, what an edge looks like across.
inline double distance_of(double share) {
  double low = -1.0;
  double high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double t = 0.5 * (low + high);
    const double value = 0.5 + t * (15.0 / 16.0 + t * t * (-5.0 / 8.0 + t * t * 3.0 / 16.0));
    (value < share ? low : high) = t;
  }
  return 0.5 * (low + high);
}

/// Measures the edges of one picture along its lines or columns against where they must be.
class EdgeMeter {
 public:
  /// `levels`: `width` by `height` values that are even on both sides of the edge.
  EdgeMeter(const std::vector<double>& levels, int width, int height, const Beyond& beyond,
            const EdgeLook& look)
      : levels_(levels), width_(width), height_(height), beyond_(beyond), look_(look) {}

  [[nodiscard]] EdgeErrors measure(bool along_columns) {
    along_columns_ = along_columns;
    const int lines = along_columns ? width_ : height_;
    const int length = along_columns ? height_ : width_;
    for (line_ = look_.border_px; line_ < lines - look_.border_px; line_ += 3) {
      double here = f(look_.border_px);
      for (int at = look_.border_px; at + 1 < length - look_.border_px; ++at) {
        const double next = f(at + 1);
        if ((here < 0.0) != (next < 0.0) && here < kNoEdge && next < kNoEdge) {
          measure_at(at, here < 0.0 ? 1 : -1, length);
        }
        here = next;
      }
    }
    return errors_;
  }

 private:
  [[nodiscard]] double f(double at, double share = 0.5) const {
    const auto line = static_cast<double>(line_);
    return along_columns_ ? beyond_(line, at, share) : beyond_(at, line, share);
  }
  [[nodiscard]] double level(int at) const {
    const int u = along_columns_ ? line_ : at;
    const int v = along_columns_ ? at : line_;
    return levels_[static_cast<std::size_t>(v * width_ + u)];
  }

  /// Slope of the distance across the edge, mm/px; 0 where the line crosses it less squarely than
  /// `least` says, the cosine of the angle.
  [[nodiscard]] double slope_across(double at, double least) const {
    const auto line = static_cast<double>(line_);
    const double u = along_columns_ ? line : at;
    const double v = along_columns_ ? at : line;
    const double by_u = beyond_(u + 0.5, v, 0.5) - beyond_(u - 0.5, v, 0.5);
    const double by_v = beyond_(u, v + 0.5, 0.5) - beyond_(u, v - 0.5, 0.5);
    const double slope = std::hypot(by_u, by_v);
    if (slope > kNoEdge / 2.0) {
      return 0.0;  // beside what is an edge
    }
    return std::abs(along_columns_ ? by_v : by_u) >= least * slope ? slope : 0.0;
  }

  /// The first two pixels wholly on one side of the edge and within its even part; false: none.
  /// By the geometry alone, whatever the picture shows.
  [[nodiscard]] bool plateau(int edge, int step, double felt_mm, double even_mm, int length,
                             double& level_there) const {
    constexpr int kFarthest = 30;
    int at = edge;
    for (int k = 0; k < kFarthest && std::abs(f(at)) < felt_mm; ++k) {
      at += step;
    }
    const int next = at + step;
    if (next < 0 || next >= length || at < 0 || at >= length) {
      return false;
    }
    const double sign = f(edge) < 0.0 ? -1.0 : 1.0;
    for (const int there : {at, next}) {
      const double distance = sign * f(there);
      if (!(distance >= felt_mm && distance <= even_mm - felt_mm)) {
        return false;
      }
    }
    level_there = 0.5 * (level(at) + level(next));
    return true;
  }

  /// Where the edge is on the average over the exposure.
  [[nodiscard]] double exact(int at) const {
    double sum = 0.0;
    for (int i = 0; i < look_.instants; ++i) {
      const double share = (i + 0.5) / look_.instants;
      double low = at - look_.motion_px;
      double high = at + 1 + look_.motion_px;
      const bool rises = f(high, share) > f(low, share);
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        ((f(middle, share) < 0.0) == rises ? low : high) = middle;
      }
      sum += low;
    }
    return sum / look_.instants;
  }

  /// Pixels from an edge at which a level stands, positive outwards, along the normal.
  [[nodiscard]] double told(int at, double inside, double outside) const {
    const double share = (level(at) - inside) / (outside - inside);
    return look_.bell_px * distance_of(std::clamp(share, 0.0, 1.0));
  }

  void measure_at(int at, int outwards, int length) {
    const double slope = slope_across(at + 0.5, 0.7);
    const double felt_mm = slope * (look_.bell_px + 0.5 * look_.motion_px + 0.2);
    const int inner = outwards > 0 ? at : at + 1;
    double inside = 0.0;
    double outside = 0.0;
    if (slope == 0.0 || !plateau(inner, -outwards, felt_mm, look_.inner_mm, length, inside) ||
        !plateau(inner + outwards, outwards, felt_mm, look_.outer_mm, length, outside)) {
      return;
    }
    if (!(std::abs(outside - inside) > 0.05)) {
      ++errors_.missed;  // no edge at all
      return;
    }
    const double truth = exact(at);
    for (int first = at - 3; first <= at + 3; ++first) {
      const double a = outwards * told(first, inside, outside);
      const double b = outwards * told(first + 1, inside, outside);
      if (a <= 0.0 && b > 0.0) {
        // Each pixel tells where the edge is; the nearer one counts for more.
        const double by_a = crossing(first, a, truth);
        const double by_b = crossing(first + 1, b, truth);
        const double error = (by_a * b - by_b * a) / (b - a) - truth;
        errors_.largest_px = std::max(errors_.largest_px, std::abs(error));
        errors_.square_sum += error * error;
        ++errors_.count;
        return;
      }
    }
    ++errors_.missed;
  }

  /// The place on the line that is the told distance off pixel `at`, both in directions of the
  /// line; `near` tells along which stretch of it the slope is taken.
  [[nodiscard]] double crossing(int at, double told_px, double near) const {
    const double along = f(0.5 * (at + near) + 0.01) - f(0.5 * (at + near) - 0.01);
    return at - told_px * slope_across(at, 0.0) / (std::abs(along) / 0.02);
  }

  const std::vector<double>& levels_;
  int width_;
  int height_;
  const Beyond& beyond_;
  EdgeLook look_;
  bool along_columns_ = false;
  int line_ = 0;
  EdgeErrors errors_;
};

}  // namespace tubesight::core::rendering::tests_of_edges
