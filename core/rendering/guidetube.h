#pragma once

#include <array>
#include <cstdint>

#include "core/rendering/exposure.h"
#include "core/rendering/light_grid.h"
#include "core/rendering/row.h"
#include "core/rendering/scene.h"
#include "core/rendering/view.h"

namespace tubesight::core::rendering {

/// The guidetube in front of the sheet: a cylinder from its tip down to the lighthouse.
class Guidetube {
 public:
  /// Prepares its outline for a camera that sits as `view` says.
  void place(const Scene& scene, const View& view, const Exposure& exposure);

  /// Draws its part of line `v`, columns first..last, over `row.signal`.
  void draw(const LightGrid& light, std::int32_t v, std::int32_t first, std::int32_t last,
            Row& row) const;

 private:
  /// A plane through the eye as a function of a pixel's ray: inside where positive.
  struct Side {
    float x = 0, y = 0, one = 0;
  };
  static constexpr std::size_t kLevels = 33;

  [[nodiscard]] Side side_of(const Eigen::Vector3d& normal_tool, bool inside) const;
  [[nodiscard]] float share(const Side& side, float ray_x, float ray_y) const;
  void find_lines(const View& view, std::int32_t height_px);
  [[nodiscard]] float tip_share(const Eigen::Vector3f& way) const;
  [[nodiscard]] float level(const Eigen::Vector3f& way) const;

  bool shown_ = false;
  std::int32_t top_ = 0;  // lines that it may show in
  std::int32_t bottom_ = 0;
  Side left_, right_;  // tangent planes
  Side below_;         // of the tip's tangent points: towards the base
  float unit_u_ = 1, unit_v_ = 1;
  float per_bell_ = 1;
  float radius_ = 0, length_ = 1;
  float led_ = 0;
  std::array<float, kLevels> levels_{};            // light on its side, from the tip to the base
  Eigen::Vector3f eye_ = Eigen::Vector3f::Zero();  // camera in the tool frame
  Eigen::Matrix3f to_tool_ = Eigen::Matrix3f::Zero();
};

}  // namespace tubesight::core::rendering
