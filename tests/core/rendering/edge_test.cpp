// Where drawn edges are, against the conic worked out here from the formulas of conventions.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/drawn_sheet.h"

namespace tubesight::core::rendering {
namespace {

using tests::DrawnSheet;

/// The place on the sheet that a pixel shows, from the settings and the pose alone.
std::array<double, 2> sheet_point(const Scene& scene, const Exposure& exposure, double u,
                                  double v) {
  const CameraSettings& c = scene.camera;
  const double x = c.cell_width_mm / c.horizontal_scale * c.sensor_columns / c.frame_columns *
                   (u - c.center_px[0]);
  const double y = c.cell_height_mm * (v - c.center_px[1]);
  const double m = 1.0 + c.distortion_per_mm2 * (x * x + y * y);
  const Eigen::Vector3d ray(x * m, y * m, c.focal_length_mm);
  const Eigen::Matrix3d R_camera_tool = rotation_from_degrees(scene.tool.rotation_deg);
  const Eigen::Vector3d tip(scene.tool.position_mm[0], scene.tool.position_mm[1],
                            scene.tool.position_mm[2]);
  const Eigen::Vector3d way = exposure.opened.rotation() * (R_camera_tool.transpose() * ray);
  const Eigen::Vector3d eye = exposure.opened * (R_camera_tool.transpose() * (-tip));
  const double along = -eye.z() / way.z();
  return {eye.x() + along * way.x(), eye.y() + along * way.y()};
}

/// Distance of the place that a pixel shows from a circle, mm; negative inside.
double beyond(const Scene& scene, const Exposure& exposure, const TubeEnd& end, double u,
              double v) {
  const std::array<double, 2> point = sheet_point(scene, exposure, u, v);
  return std::hypot(point[0] - end.center_mm[0], point[1] - end.center_mm[1]) - end.radius_mm;
}

/// The inverse of 1/2 + 15/16 t - 5/8 t^3 + 3/16 t^5, the edge's profile.
double distance_of(double share) {
  double low = -1.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.5 * (low + high);
    const double value = 0.5 + t * (15.0 / 16.0 + t * t * (-5.0 / 8.0 + t * t * 3.0 / 16.0));
    (value < share ? low : high) = t;
  }
  return 0.5 * (low + high);
}

/// Level of the plate extrapolated to pixel `at` from pixels 5 to 12 outwards of the edge.
double plate_at(const std::vector<double>& line, int edge, int outwards, int at) {
  double s0 = 0, s1 = 0, s2 = 0, y0 = 0, y1 = 0;
  for (int k = 5; k <= 12; ++k) {
    const double x = edge + outwards * k;
    const double y = line[static_cast<std::size_t>(edge + outwards * k)];
    s0 += 1;
    s1 += x;
    s2 += x * x;
    y0 += y;
    y1 += x * y;
  }
  const double slope = (s0 * y1 - s1 * y0) / (s0 * s2 - s1 * s1);
  return (y0 - slope * s1) / s0 + slope * at;
}

/// Whether those pixels are bright and on a straight line.
bool even_plate(const std::vector<double>& line, int edge, int outwards) {
  bool even = true;
  for (int k = 5; k <= 12; ++k) {
    const int at = edge + outwards * k;
    const double level = line[static_cast<std::size_t>(at)];
    even = even && level > 60.0 && std::abs(level - plate_at(line, edge, outwards, at)) < 0.7;
  }
  return even;
}

/// Where the parabola through (0, a), (1, b), (2, c) is zero between 0 and 1; along a line the
/// distance from a curved edge is bent. Where c tells nothing (all plate), where the straight line
/// is.
double zero_of(double a, double b, double c) {
  const double bend = std::abs(c) < 0.95 ? 0.5 * (a - 2.0 * b + c) : 0.0;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double x = 0.5 * (low + high);
    (a + (b - a) * x + bend * x * (x - 1.0) > 0.0 ? high : low) = x;
  }
  return low;
}

/// Measures where a line of levels crosses an edge near pixel `edge`; plate lies `outwards`.
std::optional<double> crossing(const std::vector<double>& line, int edge, int outwards) {
  double inside = 0.0;
  for (int k = 5; k <= 8; ++k) {
    inside += 0.25 * line[static_cast<std::size_t>(edge - outwards * k)];
  }
  const auto distance_at = [&](int at) {
    const double plate = plate_at(line, edge, outwards, at);
    const double share = (line[static_cast<std::size_t>(at)] - inside) / (plate - inside);
    return distance_of(std::clamp(share, 0.0, 1.0)) * outwards;
  };
  for (int at = edge - 3; at < edge + 3; ++at) {
    if (distance_at(at) <= 0.0 && distance_at(at + 1) > 0.0) {
      return zero_of(distance_at(at), distance_at(at + 1), distance_at(at + 2)) + at;
    }
  }
  return std::nullopt;
}

class DrawnEdges : public ::testing::Test {
 protected:
  DrawnEdges() {
    tests::make_plain(sheet_.scene());
    sheet_.scene().guidetube.radius_mm = 0.0;
    sheet_.scene().lamp.ring_radius_mm = 0.0;  // smooth light
    sheet_.scene().sensor.vignetting = 0.0;
    sheet_.scene().lamp.strength = 0.6;
    EXPECT_TRUE(sheet_.configure());
  }

  /// The mean of many pictures whose black levels differ by parts of a grey level: what eight bits
  /// round is told again.
  std::vector<double> fine_picture(Exposure exposure) {
    constexpr int kSteps = 32;
    std::vector<double> mean(sheet_.picture().size(), 0.0);
    for (int step = 0; step < kSteps; ++step) {
      exposure.offset = static_cast<double>(step) / kSteps;
      const std::vector<std::uint8_t> drawn = sheet_.draw(exposure);
      for (std::size_t i = 0; i < mean.size(); ++i) {
        mean[i] += (drawn[i] - exposure.offset) / kSteps;
      }
    }
    return mean;
  }

  /// Largest and mean difference of measured and exact crossings along lines (or columns).
  void measure(const Exposure& drawn, const Exposure& middle, bool along_columns) {
    const std::vector<double> picture = fine_picture(drawn);
    const CameraSettings& camera = sheet_.scene().camera;
    const int length = along_columns ? camera.height_px : camera.width_px;
    const int lines = along_columns ? camera.width_px : 300;
    for (int line = 20; line < lines - 20; line += 2) {
      std::vector<double> levels(static_cast<std::size_t>(length));
      for (int at = 0; at < length; ++at) {
        const int u = along_columns ? line : at;
        const int v = along_columns ? at : line;
        levels[static_cast<std::size_t>(at)] =
            picture[static_cast<std::size_t>(v * camera.width_px + u)];
      }
      measure_line(levels, middle, line, along_columns ? 300 : length, along_columns);
    }
  }

  void measure_line(const std::vector<double>& levels, const Exposure& exposure, int line,
                    int length, bool along_columns) {
    const auto place = [&](double at) {
      return along_columns ? std::array<double, 2>{static_cast<double>(line), at}
                           : std::array<double, 2>{at, static_cast<double>(line)};
    };
    const auto from_rim = [&](const TubeEnd& end, double at) {
      const std::array<double, 2> pixel = place(at);
      return beyond(sheet_.scene(), exposure, end, pixel[0], pixel[1]);
    };
    for (int at = 20; at < length - 20; ++at) {
      const std::array<double, 2> pixel = place(at);
      const TubeEnd end = sheet_.truth().tube_ends().at(
          sheet_.truth()
              .tube_ends()
              .nearest(sheet_point(sheet_.scene(), exposure, pixel[0], pixel[1]))
              .address);
      if ((from_rim(end, at) < 0.0) == (from_rim(end, at + 1) < 0.0)) {
        continue;
      }
      const int outwards = from_rim(end, at) < 0.0 ? 1 : -1;
      // Steep enough, and nothing else near: dark inwards, even plate outwards.
      const double along = std::abs(from_rim(end, at + 0.5) - from_rim(end, at - 0.5));
      const double across =
          std::abs(beyond(sheet_.scene(), exposure, end, pixel[0] + (along_columns ? 0.5 : 0.0),
                          pixel[1] + (along_columns ? 0.0 : 0.5)) -
                   beyond(sheet_.scene(), exposure, end, pixel[0] - (along_columns ? 0.5 : 0.0),
                          pixel[1] - (along_columns ? 0.0 : 0.5)));
      if (along < 0.7 * std::hypot(along, across) || from_rim(end, at - outwards * 9) > -1.0 ||
          !even_plate(levels, at, outwards)) {
        continue;
      }
      double low = at;
      double high = at + 1;
      for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        ((from_rim(end, middle) < 0.0) == (from_rim(end, low) < 0.0) ? low : high) = middle;
      }
      const auto found = crossing(levels, at, outwards);
      if (found) {
        const double error = *found - low;
        largest_ = std::max(largest_, std::abs(error));
        sum_ += error * error;
        ++count_;
      }
    }
  }

  DrawnSheet sheet_;
  double largest_ = 0.0;
  double sum_ = 0.0;
  int count_ = 0;
};

TEST_F(DrawnEdges, LieOnTheConicToAHundredthOfAPixelAlongLines) {
  const Exposure exposure = sheet_.exposure(3.3);

  measure(exposure, exposure, false);

  ASSERT_GT(count_, 600);
  EXPECT_LT(std::sqrt(sum_ / count_), 0.003);
  EXPECT_LT(largest_, 0.01);
  RecordProperty("largest_um_px", static_cast<int>(largest_ * 1e6));
  RecordProperty("rms_um_px", static_cast<int>(std::sqrt(sum_ / count_) * 1e6));
}

TEST_F(DrawnEdges, LieOnTheConicToAHundredthOfAPixelAlongColumns) {
  const Exposure exposure = sheet_.exposure(-7.1);

  measure(exposure, exposure, true);

  ASSERT_GT(count_, 600);
  EXPECT_LT(std::sqrt(sum_ / count_), 0.003);
  EXPECT_LT(largest_, 0.01);
}

TEST_F(DrawnEdges, AreNoticedWhenTheyAreATwentiethOfAPixelOff) {
  const Exposure exposure = sheet_.exposure(0.0);
  const Exposure wrong = sheet_.exposure(0.014);  // 0.05 px in the middle of the picture

  measure(exposure, wrong, false);

  ASSERT_GT(count_, 600);
  EXPECT_GT(largest_, 0.03);
}

TEST_F(DrawnEdges, KeepTheirMiddleWhenTheyMove) {
  const Exposure moving = sheet_.exposure(0.0, 0.4);  // 24 mm/s in a field: 1.5 px
  const Exposure middle = sheet_.exposure(0.2);

  measure(moving, middle, false);

  ASSERT_GT(count_, 600);
  EXPECT_LT(std::sqrt(sum_ / count_), 0.01);
  EXPECT_LT(largest_, 0.03);
}

}  // namespace
}  // namespace tubesight::core::rendering
