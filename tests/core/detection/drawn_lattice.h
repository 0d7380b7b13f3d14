#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// A plane of equal circles as a camera with a radial distortion sees it, drawn pixel by pixel from
/// the picture back to the plane; nothing of it comes from the code under test.
struct DrawnLattice {
  int width_px = 640;
  int height_px = 480;
  double focal_px = 500.0;
  double distortion = 0.0;  ///< of x and y over the focal length: ideal = distorted (1 + k r^2)
  double tilt_deg = 0.0;    ///< of the plane's normal away from the axis
  double tilt_towards_deg = 90.0;
  double turn_deg = 0.0;
  double distance = 20.0;  ///< of the plane's origin, in diameters
  Eigen::Vector2d shift{0.0, 0.0};
  Eigen::Vector2d column{2.0, 0.0};  ///< steps in diameters
  Eigen::Vector2d row{0.0, 2.0};
  int rows = 8;
  int columns = 9;
  double background = 180.0;
  double inside = 30.0;
  double noise = 0.0;
  double veil = 0.0;    ///< light that the lens scatters over all of the picture
  double shadow = 0.0;  ///< light lost from the left edge to the right one
  bool (*absent)(int row, int column) = nullptr;
  std::vector<std::uint16_t> pixels;

  [[nodiscard]] Eigen::Vector2d center(int row_number, int column_number) const {
    return (column_number - 0.5 * (columns - 1)) * column + (row_number - 0.5 * (rows - 1)) * row +
           shift;
  }

  /// From plane coordinates (x, y, 1) to the ideal image over the focal length.
  [[nodiscard]] Eigen::Matrix3d homography() const {
    constexpr double kDegree = 3.14159265358979 / 180.0;
    const Eigen::Vector3d axis(std::sin(tilt_towards_deg * kDegree),
                               -std::cos(tilt_towards_deg * kDegree), 0.0);
    const Eigen::Matrix3d rotation =
        (Eigen::AngleAxisd(tilt_deg * kDegree, axis) *
         Eigen::AngleAxisd(turn_deg * kDegree, Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
    Eigen::Matrix3d map;
    map << rotation.col(0), rotation.col(1), Eigen::Vector3d(0.0, 0.0, distance);
    return map;
  }

  /// The image of a place of the plane.
  [[nodiscard]] Eigen::Vector2d pixel_of(const Eigen::Vector2d& place) const {
    const Eigen::Vector3d p = homography() * Eigen::Vector3d(place.x(), place.y(), 1.0);
    const Eigen::Vector2d ideal = p.head<2>() / p.z();
    Eigen::Vector2d seen = ideal;
    for (int i = 0; i < 60; ++i) {
      seen = ideal / (1.0 + distortion * seen.squaredNorm());
    }
    return focal_px * seen + Eigen::Vector2d(0.5 * (width_px - 1.0), 0.5 * (height_px - 1.0));
  }

  /// How far a place in the picture is from the middle of the nearest circle, in diameters.
  [[nodiscard]] double off_center(const Eigen::Matrix3d& back, const Eigen::Matrix2d& to_index,
                                  double u, double v) const {
    const Eigen::Vector2d seen((u - 0.5 * (width_px - 1.0)) / focal_px,
                               (v - 0.5 * (height_px - 1.0)) / focal_px);
    const Eigen::Vector2d ideal = seen * (1.0 + distortion * seen.squaredNorm());
    const Eigen::Vector3d place = back * Eigen::Vector3d(ideal.x(), ideal.y(), 1.0);
    double least = 1e9;
    if (place.z() <= 0.0) {
      return least;
    }
    const Eigen::Vector2d at = place.head<2>() / place.z();
    const Eigen::Vector2d index =
        to_index * (at - shift) + Eigen::Vector2d(0.5 * (columns - 1), 0.5 * (rows - 1));
    for (int r = static_cast<int>(std::floor(index.y())); r <= std::ceil(index.y()); ++r) {
      for (int c = static_cast<int>(std::floor(index.x())); c <= std::ceil(index.x()); ++c) {
        if (r >= 0 && r < rows && c >= 0 && c < columns && (absent == nullptr || !absent(r, c))) {
          least = std::fmin(least, (at - center(r, c)).norm());
        }
      }
    }
    return least;
  }

  /// The share of a pixel that circles cover, by 4 x 4 samples where an edge is near.
  [[nodiscard]] double cover_of(const Eigen::Matrix3d& back, const Eigen::Matrix2d& to_index, int u,
                                int v) const {
    constexpr double kNear = 0.2;
    const double middle = off_center(back, to_index, u, v);
    if (std::abs(middle - 0.5) > kNear) {
      return middle < 0.5 ? 1.0 : 0.0;
    }
    int hits = 0;
    for (int i = 0; i < 16; ++i) {
      hits +=
          off_center(back, to_index, u + 0.25 * (i % 4) - 0.375, v + 0.25 * (i / 4) - 0.375) < 0.5
              ? 1
              : 0;
    }
    return hits / 16.0;
  }

  /// Draws it.
  picture::AveragedPicture draw() {
    const Eigen::Matrix3d back = homography().inverse();
    Eigen::Matrix2d steps;
    steps << column, row;
    const Eigen::Matrix2d to_index = steps.inverse();
    std::mt19937 random(1);
    std::normal_distribution<double> spread(0.0, 1.0);
    pixels.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    std::size_t at = 0;
    for (int v = 0; v < height_px; ++v) {
      for (int u = 0; u < width_px; ++u) {
        const double light = 1.0 - shadow * u / width_px;
        const double grey =
            light * (background + (inside - background) * cover_of(back, to_index, u, v)) + veil +
            noise * spread(random);
        pixels[at++] =
            static_cast<std::uint16_t>(std::lround(256.0 * std::fmin(255.0, std::fmax(0.0, grey))));
      }
    }
    return {pixels.data(), width_px, height_px};
  }

  /// Fills a box of the picture drawn.
  void cover(int left, int top, int right, int bottom, int grey) {
    for (int v = top; v <= bottom; ++v) {
      for (int u = left; u <= right; ++u) {
        pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) +
               static_cast<std::size_t>(u)] = static_cast<std::uint16_t>(256 * grey);
      }
    }
  }
};

}  // namespace tubesight::core::detection
