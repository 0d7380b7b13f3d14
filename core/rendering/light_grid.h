#pragma once

#include <array>
#include <cstdint>

#include "core/rendering/exposure.h"
#include "core/rendering/renderer_limits.h"
#include "core/rendering/row.h"
#include "core/rendering/scene.h"
#include "core/rendering/surface_texture.h"
#include "core/rendering/view.h"

namespace tubesight::core::rendering {

/// Light of the lamps at one place, per unit of reflectance and before vignetting.
struct LampLight {
  double wall = 0.0;       ///< on a surface that faces the lighthouse, grey levels
  double led = 0.0;        ///< on a surface that faces the camera, grey levels
  double direction_x = 0;  ///< horizontal unit vector from the place to the lighthouse, sheet frame
  double direction_y = 0;
  double slope = 0.0;  ///< height over horizontal distance of that direction
};

/// What changes slowly over the picture, worked out at nodes and interpolated in between: the
/// plate's light, texture coordinates, veil and motion.
class LightGrid {
 public:
  static constexpr std::int32_t kStepU = 16;
  static constexpr std::int32_t kStepV = 8;
  static constexpr std::int32_t kMaxColumns = kMaxPictureSide / kStepU + 2;
  static constexpr std::int32_t kMaxRows = kMaxPictureSide / kStepV + 2;
  static constexpr std::int32_t kMaxNodes = kMaxColumns * kMaxRows;
  using Values = std::array<float, kMaxNodes>;

  /// What depends on the camera alone: rays and vignetting.
  void configure(const Scene& scene, const Projection& projection);

  /// Everything for one exposure.
  void light(const Scene& scene, const View& view, const Exposure& exposure,
             const SurfaceTexture& texture);

  /// Fills a row's light, texture coordinates, glow and motion for columns first..last.
  void expand(std::int32_t v, std::int32_t first, std::int32_t last, bool moves, Row& row) const;

  /// Light at a place of the sheet frame.
  [[nodiscard]] LampLight at(const Scene& scene, const View& view, const Exposure& exposure,
                             const std::array<double, 3>& sheet_mm) const;
  /// Share of the light that the lens lets through at a pixel.
  [[nodiscard]] double vignette(double u_px, double v_px) const;

  [[nodiscard]] std::int32_t nodes() const { return columns_ * rows_; }
  /// Place of a node on the plate, sheet frame, and whether any light worth drawing comes from
  /// there.
  [[nodiscard]] std::array<double, 2> sheet_mm(std::int32_t node) const {
    const auto n = static_cast<std::size_t>(node);
    return {static_cast<double>(sheet_x_[n]), static_cast<double>(sheet_y_[n])};
  }
  [[nodiscard]] bool lit(std::int32_t node) const {
    return light_[static_cast<std::size_t>(node)] > kDark;
  }

 private:
  static constexpr float kDark = 0.5F;  // grey levels, less than noise

  void place_nodes(const View& view, double plate_z_mm);
  void add_lamp(const Scene& scene, std::int32_t lamp, float strength);
  void finish(const Scene& scene, const Exposure& exposure, const SurfaceTexture& texture);
  void add_glow(const SensorLook& look);
  void spread_blooming(double reach_px);
  void find_motion(const View& view, double plate_z_mm);

  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  double center_u_px_ = 0.0;
  double center_v_px_ = 0.0;
  double vignetting_per_px2_ = 0.0;
  std::array<float, 3> normal_{};  // of the sheet, tool frame
  std::array<float, 3> camera_{};  // in the tool frame
  std::array<float, 16> beam_{};   // coefficients of the powers of a beam's cosine
  Values ray_x_{}, ray_y_{}, vignette_{};
  Values sheet_x_{}, sheet_y_{};           // mm
  Values tool_x_{}, tool_y_{}, tool_z_{};  // mm
  Values range_{};  // z of the node in the camera frame, mm; 0: no plate seen
  Values slant_{};  // cosine between ray and normal, times the ray's length
  Values lamps_{};
  Values light_{}, texel_x_{}, texel_y_{}, fineness_{}, glow_{}, motion_u_{}, motion_v_{};
};

}  // namespace tubesight::core::rendering
