#include "tests/support/drawn_template.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tubesight::tests {
namespace {

/// Smears lines, then columns, by a Gaussian of whole pixels.
void smear(std::vector<float>& light, std::int32_t width, std::int32_t height, double sigma) {
  constexpr int kReach = 4;
  std::array<float, 2 * kReach + 1> weights{};
  float sum = 0.0F;
  for (int i = -kReach; i <= kReach; ++i) {
    const auto at = static_cast<std::size_t>(i + kReach);
    weights[at] = static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)));
    sum += weights[at];
  }
  std::vector<float> from;
  for (const bool across : {true, false}) {
    from = light;
    for (std::int32_t v = 0; v < height; ++v) {
      for (std::int32_t u = 0; u < width; ++u) {
        float value = 0.0F;
        for (int i = -kReach; i <= kReach; ++i) {
          const std::int32_t x = std::clamp(u + (across ? i : 0), 0, width - 1);
          const std::int32_t y = std::clamp(v + (across ? 0 : i), 0, height - 1);
          value += weights[static_cast<std::size_t>(i + kReach)] *
                   from[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(x)];
        }
        light[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
              static_cast<std::size_t>(u)] = value / sum;
      }
    }
  }
}

/// Moves along the lines while the picture is exposed.
void move_along(std::vector<float>& light, std::int32_t width, std::int32_t moved_px) {
  const std::vector<float> from = light;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const auto u = static_cast<std::int32_t>(i % static_cast<std::size_t>(width));
    float sum = 0.0F;
    for (std::int32_t k = 0; k < moved_px; ++k) {
      const std::int32_t x = std::clamp(u + k - moved_px / 2, 0, width - 1);
      sum += from[i - static_cast<std::size_t>(u) + static_cast<std::size_t>(x)];
    }
    light[i] = sum / static_cast<float>(moved_px);
  }
}

}  // namespace

Eigen::Vector2d DrawnTemplate::on_template(double u, double v) const {
  const Eigen::Vector2d distorted(column_mm / scale * (u - center_px.x()),
                                  row_mm * (v - center_px.y()));
  const Eigen::Vector2d ideal = distorted * (1.0 + k_per_mm2 * distorted.squaredNorm());
  const Eigen::Vector3d ray(ideal.x(), ideal.y(), efl_mm);
  const Eigen::Vector3d normal = R_camera_target.col(2);
  const Eigen::Vector3d place = ray * (normal.dot(t_camera_target) / normal.dot(ray));
  return (R_camera_target.transpose() * (place - t_camera_target)).head<2>();
}

double DrawnTemplate::depth_mm(double u, double v) const {
  const Eigen::Vector2d at = on_template(u, v);
  const Eigen::Vector2d index(std::clamp(std::round(at.x() / spacing_mm), 0.0, columns - 1.0),
                              std::clamp(std::round(at.y() / spacing_mm), 0.0, rows - 1.0));
  return 0.5 * dot_mm - (at - spacing_mm * index).norm();
}

double DrawnTemplate::cover_of(std::int32_t u, std::int32_t v) const {
  constexpr double kStep_px = 0.05;
  const double here = depth_mm(u, v);
  const auto per_px = [&](double x, double y) {
    return std::hypot(depth_mm(x + kStep_px, y) - depth_mm(x - kStep_px, y),
                      depth_mm(x, y + kStep_px) - depth_mm(x, y - kStep_px)) /
           (2.0 * kStep_px);
  };
  // A pixel is nowhere larger than a third of a dot; its slope tells the rest.
  if (std::abs(here) > dot_mm / 3.0 || std::abs(here) > 1.5 * per_px(u, v)) {
    return here > 0.0 ? 1.0 : 0.0;
  }
  constexpr int kParts = 4;
  double sum = 0.0;
  for (int i = 0; i < kParts * kParts; ++i) {
    const double x = u + (i % kParts + 0.5) / kParts - 0.5;
    const double y = v + (i / kParts + 0.5) / kParts - 0.5;
    sum += std::clamp(0.5 + kParts * depth_mm(x, y) / per_px(x, y), 0.0, 1.0);
  }
  return sum / (kParts * kParts);
}

core::picture::AveragedPicture DrawnTemplate::draw(std::mt19937_64& random,
                                                   std::vector<std::uint16_t>& pixels) const {
  std::vector<float> light(static_cast<std::size_t>(width_px) *
                           static_cast<std::size_t>(height_px));
  std::size_t at = 0;
  const double corner2 = 0.25 * (width_px * width_px + height_px * height_px);
  for (std::int32_t v = 0; v < height_px; ++v) {
    for (std::int32_t u = 0; u < width_px; ++u) {
      const double r2 = (Eigen::Vector2d(u, v) - center_px).squaredNorm();
      light[at++] = static_cast<float>((background + (inside - background) * cover_of(u, v)) *
                                       (1.0 - falling_off * r2 / corner2));
    }
  }
  smear(light, width_px, height_px, smear_px);
  if (moved_px > 1) {
    move_along(light, width_px, moved_px);
  }
  std::normal_distribution<float> spread(0.0F, static_cast<float>(noise));
  pixels.resize(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    float sum = 0.0F;
    for (std::int32_t frame = 0; frame < frames; ++frame) {
      sum += std::round(std::clamp(light[i] + spread(random), 0.0F, 255.0F));
    }
    pixels[i] = static_cast<std::uint16_t>(std::lround(
        static_cast<float>(core::picture::kGreyScale) * sum / static_cast<float>(frames)));
  }
  return {pixels.data(), width_px, height_px};
}

}  // namespace tubesight::tests
