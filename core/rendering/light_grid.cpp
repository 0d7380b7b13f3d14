#include "core/rendering/light_grid.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tubesight::core::rendering {
namespace {

/// Grey levels times mm^2 per unit of reflectance, all lamps at full: fitted with the ring's place
/// to ray-traced stills from 0 to 90 mm height (residue 5 % RMS); 200 grey levels at 60 mm.
constexpr double kFullLight = 7.7e6;
constexpr double kPi = 3.14159265358979323846;
/// The edge of the guidetube's shadow, mm at the guidetube: lamps are no points.
constexpr float kPenumbra = 2.5F;

std::array<double, 3> lamp_place(const LampLook& look, std::int32_t lamp) {
  const double angle = 2.0 * kPi * lamp / kLighthouseLamps;
  return {look.ring_radius_mm * std::cos(angle), look.ring_radius_mm * std::sin(angle),
          -look.below_tip_mm};
}

double alive(const Exposure& exposure) {
  int count = 0;
  for (std::int32_t lamp = 0; lamp < kLighthouseLamps; ++lamp) {
    count += ((exposure.dead_lamps >> lamp) & 1U) == 0 ? 1 : 0;
  }
  return static_cast<double>(count) / kLighthouseLamps;
}

/// A lamp as the node loop wants it.
struct LoopLamp {
  float x, y, z;                 // tool frame, mm
  float axis_x, axis_y, axis_z;  // of its beam
  float strength;
  float tube_radius, tube_share, shadow;
};

void add_lamp_light(const float* __restrict x, const float* __restrict y, const float* __restrict z,
                    const std::array<float, 3>& normal, const std::array<float, 16>& beam,
                    const LoopLamp& lamp, std::int32_t count, float* __restrict sum) {
  for (std::int32_t n = 0; n < count; ++n) {
    const float dx = x[n] - lamp.x;
    const float dy = y[n] - lamp.y;
    const float dz = z[n] - lamp.z;
    const float d2 = dx * dx + dy * dy + dz * dz + 1.0F;
    const float per_d = 1.0F / std::sqrt(d2);
    const float facing = (dx * normal[0] + dy * normal[1] + dz * normal[2]) * per_d;
    const float along = (dx * lamp.axis_x + dy * lamp.axis_y + dz * lamp.axis_z) * per_d;
    const float c = along > 0.0F ? along : 0.0F;
    float power = beam[8];
    for (std::size_t k = 8; k-- > 0;) {
      power = power * c + beam[k];
    }
    // The closest that the light comes to the guidetube's axis below its tip.
    const float flat2 = dx * dx + dy * dy + 1e-3F;
    const float closest = -(lamp.x * dx + lamp.y * dy) / flat2;
    const float until = lamp.tube_share / dz;  // share of the way at the height of the tip
    const float low = closest < 0.0F ? 0.0F : closest;
    const float t = low > until ? until : low;
    const float px = lamp.x + t * dx;
    const float py = lamp.y + t * dy;
    const float gap = (std::sqrt(px * px + py * py) - lamp.tube_radius) / kPenumbra + 0.5F;
    const float open = gap < 0.0F ? 0.0F : (gap > 1.0F ? 1.0F : gap);
    const float shade = 1.0F - lamp.shadow * (1.0F - open);
    const float faced = facing > 0.0F ? facing : 0.0F;
    sum[n] += lamp.strength * power * faced * shade / d2;
  }
}

/// Which cells of a line are wanted, and how far down in their row it is.
struct Cells {
  std::int32_t first, last;
  float down;
};

/// Four pixels at once: g++ 12 does not see for itself that a cell's are alike.
using Four [[gnu::vector_size(16)]] = float;

/// Between the nodes above and below, and then from node to node along the line.
void expand_line(const float* __restrict top, const float* __restrict bottom, Cells cells,
                 float* __restrict line) {
  static_assert(LightGrid::kStepU == 16);
  std::array<float, LightGrid::kMaxColumns> nodes;
  float* const between = nodes.data();
  for (std::int32_t column = cells.first; column <= cells.last + 1; ++column) {
    between[column] = top[column] + (bottom[column] - top[column]) * cells.down;
  }
  constexpr Four kFirst{0.0F, 1.0F, 2.0F, 3.0F};
  for (std::int32_t column = cells.first; column <= cells.last; ++column) {
    const float left = between[column];
    const float rise = (between[column + 1] - left) * (1.0F / 16.0F);
    float* pixels = line + static_cast<std::ptrdiff_t>(column) * LightGrid::kStepU;
    const Four first = left + rise * kFirst;
    const Four second = first + 4.0F * rise;
    const Four third = first + 8.0F * rise;
    const Four fourth = first + 12.0F * rise;
    std::memcpy(pixels, &first, sizeof(Four));
    std::memcpy(pixels + 4, &second, sizeof(Four));
    std::memcpy(pixels + 8, &third, sizeof(Four));
    std::memcpy(pixels + 12, &fourth, sizeof(Four));
  }
}

}  // namespace

void LightGrid::configure(const Scene& scene, const Projection& projection) {
  const CameraSettings& camera = scene.camera;
  columns_ = (camera.width_px - 1) / kStepU + 2;
  rows_ = (camera.height_px - 1) / kStepV + 2;
  center_u_px_ = camera.center_px[0];
  center_v_px_ = camera.center_px[1];
  const double du = std::max(center_u_px_, camera.width_px - 1 - center_u_px_);
  const double dv = std::max(center_v_px_, camera.height_px - 1 - center_v_px_);
  vignetting_per_px2_ = scene.sensor.vignetting / (du * du + dv * dv);
  for (std::int32_t row = 0; row < rows_; ++row) {
    for (std::int32_t column = 0; column < columns_; ++column) {
      const auto n = static_cast<std::size_t>(row * columns_ + column);
      const Eigen::Vector3d ray = projection.ray(column * kStepU, row * kStepV);
      ray_x_[n] = static_cast<float>(ray.x());
      ray_y_[n] = static_cast<float>(ray.y());
      vignette_[n] = static_cast<float>(vignette(column * kStepU, row * kStepV));
    }
  }
  // cos^m between two whole powers: a polynomial, which vectorises.
  beam_.fill(0.0F);
  const double power = std::clamp(scene.lamp.beam, 0.0, 8.0);
  const double whole = std::min(std::floor(power), 7.0);
  beam_[static_cast<std::size_t>(whole)] = static_cast<float>(1.0 - (power - whole));
  beam_[static_cast<std::size_t>(whole) + 1] = static_cast<float>(power - whole);
}

double LightGrid::vignette(double u_px, double v_px) const {
  const double du = u_px - center_u_px_;
  const double dv = v_px - center_v_px_;
  return 1.0 - std::min(vignetting_per_px2_ * (du * du + dv * dv), 1.0);
}

void LightGrid::place_nodes(const View& view, double plate_z_mm) {
  const Eigen::Matrix3d& R = view.T_sheet_camera().rotation();
  const Eigen::Vector3d& eye = view.T_sheet_camera().translation_mm();
  const Transform<frames::Tool, frames::Camera> T_tool_camera = view.T_camera_tool().inverse();
  const double height = plate_z_mm - eye.z();
  for (std::int32_t n = 0; n < nodes(); ++n) {
    const auto i = static_cast<std::size_t>(n);
    const double x = static_cast<double>(ray_x_[i]);
    const double y = static_cast<double>(ray_y_[i]);
    const double slant = R(2, 0) * x + R(2, 1) * y + R(2, 2);
    const bool seen = height > 1.0 && slant > 0.02;
    const double range = seen ? height / slant : 1e5;
    range_[i] = seen ? static_cast<float>(range) : 0.0F;
    slant_[i] = static_cast<float>(std::max(slant, 0.02));
    sheet_x_[i] = static_cast<float>(eye.x() + range * (R(0, 0) * x + R(0, 1) * y + R(0, 2)));
    sheet_y_[i] = static_cast<float>(eye.y() + range * (R(1, 0) * x + R(1, 1) * y + R(1, 2)));
    const Eigen::Vector3d tool = T_tool_camera * Eigen::Vector3d(range * x, range * y, range);
    tool_x_[i] = static_cast<float>(tool.x());
    tool_y_[i] = static_cast<float>(tool.y());
    tool_z_[i] = static_cast<float>(tool.z());
  }
  const Eigen::Matrix3d& R_tool_sheet = view.T_tool_sheet().rotation();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    normal_[axis] = static_cast<float>(R_tool_sheet(a, 2));
    camera_[axis] = static_cast<float>(T_tool_camera.translation_mm()(a));
  }
}

void LightGrid::add_lamp(const Scene& scene, std::int32_t lamp, float strength) {
  const std::array<double, 3> place = lamp_place(scene.lamp, lamp);
  const double tilt = scene.lamp.tilt_deg * kPi / 180.0;
  const double angle = 2.0 * kPi * lamp / kLighthouseLamps;
  LoopLamp loop{};
  loop.x = static_cast<float>(place[0]);
  loop.y = static_cast<float>(place[1]);
  loop.z = static_cast<float>(place[2]);
  loop.axis_x = static_cast<float>(std::sin(tilt) * std::cos(angle));
  loop.axis_y = static_cast<float>(std::sin(tilt) * std::sin(angle));
  loop.axis_z = static_cast<float>(std::cos(tilt));
  loop.strength = strength;
  loop.tube_radius = static_cast<float>(scene.guidetube.radius_mm);
  loop.tube_share = static_cast<float>(std::max(scene.lamp.below_tip_mm, 0.0));
  loop.shadow = scene.guidetube.radius_mm > 0.0
                    ? static_cast<float>(std::clamp(scene.guidetube.shadow, 0.0, 1.0))
                    : 0.0F;
  add_lamp_light(tool_x_.data(), tool_y_.data(), tool_z_.data(), normal_, beam_, loop, nodes(),
                 lamps_.data());
}

void LightGrid::light(const Scene& scene, const View& view, const Exposure& exposure,
                      const SurfaceTexture& texture) {
  const double plate_z = scene.sheet.weld == Weld::kFillet ? scene.look.fillet_height_mm : 0.0;
  place_nodes(view, plate_z);
  std::fill_n(lamps_.begin(), nodes(), 0.0F);
  const double each = kFullLight * scene.lamp.strength * exposure.lamp / kLighthouseLamps;
  for (std::int32_t lamp = 0; lamp < kLighthouseLamps && each > 0.0; ++lamp) {
    if (((exposure.dead_lamps >> lamp) & 1U) == 0) {
      add_lamp(scene, lamp, static_cast<float>(each));
    }
  }
  finish(scene, exposure, texture);
  add_glow(scene.sensor);
  find_motion(view, plate_z);
}

void LightGrid::finish(const Scene& scene, const Exposure& exposure,
                       const SurfaceTexture& texture) {
  const auto plate = static_cast<float>(scene.look.plate);
  const auto gloss = static_cast<float>(scene.look.gloss);
  const auto led = static_cast<float>(kFullLight * scene.lamp.led_strength * exposure.ring);
  const auto ambient = static_cast<float>(scene.lamp.ambient * exposure.lamp);
  const auto stains = static_cast<float>(scene.look.stains);
  const auto below = static_cast<float>(scene.lamp.below_tip_mm);
  // Every plant has its own stains: the seed moves the tile, by whole texels.
  const auto shift_x = static_cast<float>(scene.seed % 509);
  const auto shift_y = static_cast<float>((scene.seed / 509) % 503);
  constexpr auto kTexels = static_cast<float>(SurfaceTexture::kTexelsPerMm);
  for (std::int32_t n = 0; n < nodes(); ++n) {
    const auto i = static_cast<std::size_t>(n);
    const float ray2 = 1.0F + ray_x_[i] * ray_x_[i] + ray_y_[i] * ray_y_[i];
    const float range2 = range_[i] * range_[i] * ray2;
    if (range_[i] <= 0.0F) {
      light_[i] = texel_x_[i] = texel_y_[i] = fineness_[i] = 0.0F;
      continue;
    }
    const float facing = slant_[i] / std::sqrt(ray2);
    const float from_camera = led * facing / (ray2 * range2 + 1.0F);
    // A worn plate mirrors a little: where the half-way direction is near the normal.
    const float lx = -tool_x_[i], ly = -tool_y_[i], lz = -below - tool_z_[i];
    const float cx = camera_[0] - tool_x_[i], cy = camera_[1] - tool_y_[i],
                cz = camera_[2] - tool_z_[i];
    const float per_l = 1.0F / std::sqrt(lx * lx + ly * ly + lz * lz);
    const float per_c = 1.0F / std::sqrt(cx * cx + cy * cy + cz * cz);
    const float hx = lx * per_l + cx * per_c, hy = ly * per_l + cy * per_c,
                hz = lz * per_l + cz * per_c;
    const float h = -(hx * normal_[0] + hy * normal_[1] + hz * normal_[2]) /
                    std::sqrt(hx * hx + hy * hy + hz * hz + 1e-6F);
    const float h4 = h * h * h * h;
    const float mirrored = gloss * h4 * h4 * h4 * h4 * h4;
    const float direct = lamps_[i] * (1.0F + mirrored) + from_camera;
    const float x = sheet_x_[i] * 0.31F + shift_x;
    const float y = sheet_y_[i] * 0.31F + shift_y;
    const float stain = 1.0F + stains * 0.7F * texture.between(x, y);
    const float bounded = stain < 0.3F ? 0.3F : stain;
    light_[i] = (plate * direct * bounded + 255.0F * ambient * 0.02F) * vignette_[i];
    texel_x_[i] = sheet_x_[i] * kTexels + shift_x;
    texel_y_[i] = sheet_y_[i] * kTexels + shift_y;
    // Height of a pixel on the plate, mm, against the grain's.
    const float footprint = range_[i] * 0.002F / slant_[i];
    fineness_[i] = 1.0F / (1.0F + footprint * footprint);
  }
}

void LightGrid::add_glow(const SensorLook& look) {
  constexpr float kPlateShare = 0.6F;  // the rest are bores
  double sum = 0.0;
  float most = 0.0F;
  const auto full = static_cast<float>(look.saturation / std::max(look.gain, 1e-3));
  for (std::int32_t n = 0; n < nodes(); ++n) {
    const auto i = static_cast<std::size_t>(n);
    sum += static_cast<double>(light_[i]);
    const float over = light_[i] - full;
    glow_[i] = over > 0.0F ? over * kPlateShare * static_cast<float>(look.blooming) : 0.0F;
    most = glow_[i] > most ? glow_[i] : most;
  }
  if (most > 0.0F) {
    spread_blooming(look.blooming_px);
  }
  const auto veil =
      static_cast<float>(look.veil * static_cast<double>(kPlateShare) * sum / std::max(nodes(), 1));
  for (std::int32_t n = 0; n < nodes(); ++n) {
    glow_[static_cast<std::size_t>(n)] += veil;
  }
}

void LightGrid::spread_blooming(double reach_px) {
  // Forward and back along lines and columns: an exponential to both sides.
  const auto run = [this](std::int32_t start, std::int32_t step, std::int32_t count, float keep) {
    float carried = 0.0F;
    for (std::int32_t k = 0; k < count; ++k) {
      float& value = glow_[static_cast<std::size_t>(start + k * step)];
      carried = keep * carried + (1.0F - keep) * value;
      value = carried;
    }
    carried = 0.0F;
    for (std::int32_t k = count; k-- > 0;) {
      float& value = glow_[static_cast<std::size_t>(start + k * step)];
      carried = keep * carried + (1.0F - keep) * value;
      value = carried;
    }
  };
  const double reach = std::max(reach_px, 0.1);
  const auto keep_u = static_cast<float>(std::exp(-kStepU / reach));
  const auto keep_v = static_cast<float>(std::exp(-kStepV / reach));
  for (std::int32_t row = 0; row < rows_; ++row) {
    run(row * columns_, 1, columns_, keep_u);
  }
  for (std::int32_t column = 0; column < columns_; ++column) {
    run(column, columns_, rows_, keep_v);
  }
}

void LightGrid::find_motion(const View& view, double plate_z_mm) {
  if (!view.moves()) {
    return;
  }
  for (std::int32_t n = 0; n < nodes(); ++n) {
    const auto i = static_cast<std::size_t>(n);
    const std::int32_t u = n % columns_ * kStepU;
    const std::int32_t v = n / columns_ * kStepV;
    const std::array<double, 2> pixel{static_cast<double>(u), static_cast<double>(v)};
    std::array<double, 2> way{};
    if (range_[i] > 0.0F && range_[i] < 5000.0F) {
      way = view.motion(
          pixel, {static_cast<double>(sheet_x_[i]), static_cast<double>(sheet_y_[i]), plate_z_mm});
    }
    motion_u_[i] = static_cast<float>(way[0]);
    motion_v_[i] = static_cast<float>(way[1]);
    const float length = std::abs(motion_u_[i]) + std::abs(motion_v_[i]);
    fineness_[i] /= 1.0F + 0.25F * length;
  }
}

void LightGrid::expand(std::int32_t v, std::int32_t first, std::int32_t last, bool moves,
                       Row& row) const {
  const Cells cells{first / kStepU, last / kStepU,
                    static_cast<float>(v % kStepV) / static_cast<float>(kStepV)};
  const std::int32_t upper = (v / kStepV) * columns_;
  const auto one = [&](const Values& nodes, Row::Line& line) {
    const float* top = nodes.data() + upper;
    expand_line(top, top + columns_, cells, line.data());
  };
  one(light_, row.light);
  one(texel_x_, row.sheet_x);
  one(texel_y_, row.sheet_y);
  one(fineness_, row.fineness);
  one(glow_, row.glow);
  if (moves) {
    one(motion_u_, row.motion_u);
    one(motion_v_, row.motion_v);
  }
}

LampLight LightGrid::at(const Scene& scene, const View& view, const Exposure& exposure,
                        const std::array<double, 3>& sheet_mm) const {
  const Eigen::Vector3d point(sheet_mm[0], sheet_mm[1], sheet_mm[2]);
  const Eigen::Vector3d tool = view.T_tool_sheet() * point;
  const Eigen::Matrix3d& R = view.T_tool_sheet().rotation();
  const double x = -tool.x();
  const double y = -tool.y();
  const double z = -scene.lamp.below_tip_mm - tool.z();
  const double d2 = x * x + y * y + z * z + 1.0;
  const double cosine = std::max(-z / std::sqrt(d2), 0.0);
  double power = 0.0;
  for (std::size_t k = 9; k-- > 0;) {
    power = power * cosine + static_cast<double>(beam_[k]);
  }
  LampLight found;
  found.wall = kFullLight * scene.lamp.strength * exposure.lamp * alive(exposure) * power / d2;
  const double flat_x = R(0, 0) * x + R(1, 0) * y + R(2, 0) * z;
  const double flat_y = R(0, 1) * x + R(1, 1) * y + R(2, 1) * z;
  const double up = R(0, 2) * x + R(1, 2) * y + R(2, 2) * z;
  const double flat = std::sqrt(flat_x * flat_x + flat_y * flat_y) + 1e-6;
  found.direction_x = flat_x / flat;
  found.direction_y = flat_y / flat;
  found.slope = std::max(-up, 0.0) / flat;
  const Eigen::Vector3d& eye = view.T_sheet_camera().translation_mm();
  const double ex = eye.x() - point.x();
  const double ey = eye.y() - point.y();
  const double ez = eye.z() - point.z();
  found.led =
      kFullLight * scene.lamp.led_strength * exposure.ring / (ex * ex + ey * ey + ez * ez + 1.0);
  return found;
}

}  // namespace tubesight::core::rendering
