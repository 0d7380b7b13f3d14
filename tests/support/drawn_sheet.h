#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/settings.h"
#include "core/rendering/renderer.h"
#include "core/rendering/truth.h"

namespace tubesight::tests {

/// A plain scene of core/rendering for tests and benchmarks: the source's camera (635 by 480, even
/// lines first) on an ordinary tool 60 mm below a square sheet of 25.4 mm pitch.
class DrawnSheet {
 public:
  /// Configured as it stands; change `scene()` and configure again for anything else.
  DrawnSheet();

  /// The scene, to be changed before configure().
  [[nodiscard]] core::rendering::Scene& scene() { return *scene_; }
  /// Passes the scene to renderer and truth; false when they refuse it.
  [[nodiscard]] bool configure();

  [[nodiscard]] core::rendering::Renderer& renderer() { return *renderer_; }
  [[nodiscard]] const core::rendering::Truth& truth() const { return *truth_; }

  /// Below tube (40, 60) and `along_mm` off it along the columns, level, heading 2 degrees; the
  /// shutter closes `way_mm` further on. All lines.
  [[nodiscard]] core::rendering::Exposure exposure(double along_mm = 0.0,
                                                   double way_mm = 0.0) const;

  /// A picture of the camera's size, exactly as many bytes on the heap as it has pixels.
  [[nodiscard]] std::vector<std::uint8_t> picture(std::uint8_t fill = 0) const;
  [[nodiscard]] core::rendering::GreyImageView view(std::vector<std::uint8_t>& picture) const;
  /// Draws into a new picture.
  [[nodiscard]] std::vector<std::uint8_t> draw(const core::rendering::Exposure& exposure);

 private:
  std::unique_ptr<core::rendering::Scene> scene_;
  std::unique_ptr<core::rendering::Renderer> renderer_;
  std::unique_ptr<core::rendering::Truth> truth_;
};

/// Takes everything away that is not light on plate and bores: noise, texture, veil, blooming,
/// welds' rings, nicks, spread of the bores.
void make_plain(core::rendering::Scene& scene);

}  // namespace tubesight::tests
