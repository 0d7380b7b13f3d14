#include "core/rendering/renderer.h"

#include <algorithm>
#include <cmath>

#include "core/rendering/scene_ranges.h"
#include "core/rendering/view.h"

namespace tubesight::core::rendering {
namespace {

bool possible(const Scene& scene) {
  return within(kSheetLookRanges, scene.look) && within(kLampLookRanges, scene.lamp) &&
         within(kSensorLookRanges, scene.sensor) && within(kGuidetubeLookRanges, scene.guidetube) &&
         scene.look.land_mm <= scene.look.fillet_mm;
}

void fill_rays(const Projection& projection, std::int32_t v, std::int32_t first, std::int32_t last,
               float* __restrict ray_x, float* __restrict ray_y) {
  const auto center_u = static_cast<float>(projection.center_u_px());
  const auto unit_u = static_cast<float>(projection.unit_u());
  const auto k = static_cast<float>(projection.k());
  const auto k2 = static_cast<float>(projection.k2());
  const auto y = static_cast<float>((v - projection.center_v_px()) * projection.unit_v());
  for (std::int32_t u = first; u <= last; ++u) {
    const float x = (static_cast<float>(u) - center_u) * unit_u;
    const float r2 = x * x + y * y;
    const float factor = 1.0F + r2 * (k + r2 * k2);
    ray_x[u] = x * factor;
    ray_y[u] = y * factor;
  }
}

/// The picture without tube-ends: light and grain.
void fill_plate(const SurfaceTexture& texture, float spread, std::int32_t first, std::int32_t last,
                Row& row) {
  const std::int32_t count = (last - first + 1) / 4 * 4;  // whole cells: nothing is left over
  const float* __restrict x = row.sheet_x.data() + first;
  const float* __restrict y = row.sheet_y.data() + first;
  const float* __restrict light = row.light.data() + first;
  const float* __restrict fineness = row.fineness.data() + first;
  std::int32_t* __restrict texel = row.texel.data() + first;
  float* __restrict plate = row.plate.data() + first;
  float* __restrict signal = row.signal.data() + first;
  for (std::int32_t i = 0; i < count; ++i) {
    texel[i] =
        SurfaceTexture::index(static_cast<std::int32_t>(x[i]), static_cast<std::int32_t>(y[i]));
  }
  for (std::int32_t i = 0; i < count; ++i) {
    texel[i] = texture.at_index(texel[i]);
  }
  const float fine = spread * SurfaceTexture::kStep;
  for (std::int32_t i = 0; i < count; ++i) {
    const float level = light[i] * (1.0F + fine * static_cast<float>(texel[i]) * fineness[i]);
    plate[i] = level;
    signal[i] = level;
  }
}

}  // namespace

Result<void> Renderer::configure(const Scene& scene) {
  const Result<Projection> made = Projection::make(scene.camera);
  if (!made.has_value() || scene.camera.width_px < 16 || scene.camera.height_px < 16 ||
      scene.camera.width_px > kMaxPictureSide || scene.camera.height_px > kMaxPictureSide) {
    return Unexpected(Error::kOutOfRange);
  }
  if (!possible(scene)) {
    return Unexpected(Error::kInvalidArgument);
  }
  if (const Result<void> ends = tube_ends_.configure(scene); !ends.has_value()) {
    return Unexpected(ends.error());
  }
  scene_ = scene;
  projection_ = *made;
  T_camera_tool_ = camera_tool_of(scene.tool);
  if (!made_) {
    texture_.make();
    noise_.make();
    made_ = true;
  }
  light_.configure(scene_, projection_);
  return {};
}

void Renderer::prepare_line(std::int32_t v, std::int32_t first, std::int32_t last, bool moves) {
  light_.expand(v, first, last, moves, row_);
  fill_rays(projection_, v, first, last, row_.ray_x.data(), row_.ray_y.data());
  fill_plate(texture_, static_cast<float>(scene_.look.texture), first, last, row_);
}

void Renderer::render(const Exposure& exposure, const GreyImageView& picture) {
  TUBESIGHT_ASSERT(picture.width_px == scene_.camera.width_px &&
                   picture.height_px == scene_.camera.height_px);
  const std::int32_t left = std::max(exposure.window.left, 0);
  const std::int32_t right = std::min(exposure.window.right, picture.width_px - 1);
  const std::int32_t top = std::max(exposure.window.top, 0);
  const std::int32_t bottom = std::min(exposure.window.bottom, picture.height_px - 1);
  if (left > right || top > bottom) {
    return;
  }
  const View view(projection_, T_camera_tool_, exposure);
  light_.light(scene_, view, exposure, texture_);
  discs_.fill(scene_, tube_ends_, view, exposure, light_, top, bottom);
  guidetube_.place(scene_, view, exposure);
  if (!view.moves()) {
    row_.motion_u.fill(0.0F);
    row_.motion_v.fill(0.0F);
  }
  // Whole cells are drawn, so that a window shows what the whole picture would.
  const std::int32_t first = left / LightGrid::kStepU * LightGrid::kStepU;
  const std::int32_t last = (right / LightGrid::kStepU + 1) * LightGrid::kStepU - 1;
  const std::int32_t step = exposure.parity == Parity::kProgressive ? 1 : 2;
  const std::int32_t odd = exposure.parity == Parity::kOdd ? 1 : 0;
  for (std::int32_t v = step == 1 ? top : top + ((top ^ odd) & 1); v <= bottom; v += step) {
    prepare_line(v, first, last, view.moves());
    discs_.draw(v, first, last, view.moves(), row_);
    guidetube_.draw(light_, v, first, last, row_);
    noise_.develop(row_, scene_.sensor, exposure, v, left, right,
                   picture.pixels + static_cast<std::ptrdiff_t>(v) * picture.stride_px);
  }
}

}  // namespace tubesight::core::rendering
