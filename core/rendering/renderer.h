#pragma once

#include <cstdint>

#include "core/base/result.h"
#include "core/rendering/disc_list.h"
#include "core/rendering/exposure.h"
#include "core/rendering/guidetube.h"
#include "core/rendering/light_grid.h"
#include "core/rendering/projection.h"
#include "core/rendering/renderer_limits.h"
#include "core/rendering/row.h"
#include "core/rendering/scene.h"
#include "core/rendering/sensor_noise.h"
#include "core/rendering/surface_texture.h"
#include "core/rendering/tube_ends.h"

namespace tubesight::core::rendering {

/// Draws what the camera sees, one field at a time.
///
/// Every rim is drawn by the signed distance of each pixel from its exact image, so that the edge's
/// 50 % crossing lies on the true conic to 0.01 px. Motion between the exposure's two poses blurs
/// each edge along its normal, exact to first order, about the middle of the motion. The same scene
/// and exposure give the same bytes on one machine. Single thread; no heap after configure(), nor
/// in it. Some MB: static or heap.
class Renderer {
 public:
  Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Prepares for a scene. kInvalidArgument: what TubeEnds::configure() refuses, or a value of the
  /// look out of its range; kOutOfRange: a picture below 16 or above kMaxPictureSide pixels a side,
  /// or an impossible camera.
  [[nodiscard]] Result<void> configure(const Scene& scene);

  /// Draws the lines of `exposure.parity` inside `exposure.window` into `picture`, which has the
  /// camera's size. Needs a configured renderer.
  void render(const Exposure& exposure, const GreyImageView& picture);

 private:
  void prepare_line(std::int32_t v, std::int32_t first, std::int32_t last, bool moves);

  Row row_;
  LightGrid light_;
  DiscList discs_;
  SensorNoise noise_;
  SurfaceTexture texture_;
  TubeEnds tube_ends_;
  Scene scene_;
  Projection projection_;
  Transform<frames::Camera, frames::Tool> T_camera_tool_;
  Guidetube guidetube_;
  bool made_ = false;  // tile and table are the same for all scenes
};

}  // namespace tubesight::core::rendering
