#include "core/rendering/disc_maker.h"

#include <algorithm>
#include <cmath>

#include "core/rendering/edge_spread.h"
#include "core/rendering/random.h"

namespace tubesight::core::rendering {
namespace {

constexpr double kTwoPi = 6.28318530717958647692;

enum Use : std::uint32_t {
  kWeld = 21,
  kNick,
  kNickDirection,
  kNickDepth,
  kPlugLevel,
  kBoron,
  kBoronPlace
};

float narrowed(double value) { return static_cast<float>(value); }

/// Change of the place on the disc's plane by pixel at its centre, mm/px: x by u and v, y by u and
/// v.
struct PlaceSlopes {
  double xu, xv, yu, yv;
};

PlaceSlopes place_slopes(const Disc& disc) {
  const double per_w =
      1.0 / static_cast<double>(disc.gx * disc.center_x + disc.gy * disc.center_y + disc.gz);
  const auto product = [per_w](float p, float q, float r, float s) {
    return (static_cast<double>(p) * static_cast<double>(q) +
            static_cast<double>(r) * static_cast<double>(s)) *
           per_w;
  };
  return {product(disc.ax, disc.ray_uu, disc.ay, disc.ray_vu),
          product(disc.ax, disc.ray_uv, disc.ay, disc.ray_vv),
          product(disc.bx, disc.ray_uu, disc.by, disc.ray_vu),
          product(disc.bx, disc.ray_uv, disc.by, disc.ray_vv)};
}

/// The axes of a small circle's image.
struct ImageAxes {
  double cosine = 1.0, sine = 0.0;            // direction of the first, px
  std::array<double, 2> mm_per_px{1.0, 1.0};  // along the first and the second
};

ImageAxes image_axes(const PlaceSlopes& slopes) {
  const double a = slopes.xu * slopes.xu + slopes.yu * slopes.yu;
  const double b = slopes.xu * slopes.xv + slopes.yu * slopes.yv;
  const double c = slopes.xv * slopes.xv + slopes.yv * slopes.yv;
  const double half = 0.5 * (a - c);
  const double root = std::sqrt(half * half + b * b);
  const double most = 0.5 * (a + c) + root;
  const double least = std::max(0.5 * (a + c) - root, 1e-12);
  ImageAxes axes;
  // The eigenvector of the larger value, by the longer of two ways to write it.
  const double along = half >= 0.0 ? half + root : b;
  const double across = half >= 0.0 ? b : root - half;
  const double length = std::hypot(along, across);
  if (length > 0.0) {
    axes.cosine = along / length;
    axes.sine = across / length;
  }
  axes.mm_per_px = {std::sqrt(most), std::sqrt(least)};
  return axes;
}

/// The ellipse with these half axes, px.
Disc::Span span_of(const ImageAxes& axes, double first_px, double second_px) {
  const double p = 1.0 / (first_px * first_px);
  const double q = 1.0 / (second_px * second_px);
  return {narrowed(p * axes.cosine * axes.cosine + q * axes.sine * axes.sine),
          narrowed((p - q) * axes.cosine * axes.sine),
          narrowed(p * axes.sine * axes.sine + q * axes.cosine * axes.cosine)};
}

/// Where all of a disc's pixels are and where its edge is not felt, to first order: 2 % and 0.8 px
/// of room cover what perspective and distortion change over the largest tube-ends.
void set_spans(double inner_mm, double outer_mm, double band_px, Disc& disc) {
  const ImageAxes axes = image_axes(place_slopes(disc));
  const double band = band_px + 0.8;
  const std::array<double, 2>& unit = axes.mm_per_px;
  const double first = 1.02 * outer_mm / unit[0] + band;
  const double second = 1.02 * outer_mm / unit[1] + band;
  disc.outer = span_of(axes, first, second);
  const double inner_first = 0.98 * inner_mm / unit[0] - band;
  const double inner_second = 0.98 * inner_mm / unit[1] - band;
  disc.has_inner = inner_first > 1.0 && inner_second > 1.0;
  if (disc.has_inner) {
    disc.inner = span_of(axes, inner_first, inner_second);
  }
  disc.minor_px = narrowed(inner_mm / unit[0]);
  const double half_v = std::hypot(first * axes.sine, second * axes.cosine);
  const double low = static_cast<double>(disc.span_v) - half_v;
  const double high = static_cast<double>(disc.span_v) + half_v;
  disc.top = static_cast<std::int32_t>(std::floor(std::clamp(low, -1e6, 1e6)));
  disc.bottom = static_cast<std::int32_t>(std::ceil(std::clamp(high, -1e6, 1e6)));
}

/// The centre of the span: that of the ellipse which the circle makes, beside the centre's image.
/// From the dual conic R^2 (A A' + B B') - C C' = R^2 (1 - N N') - C C', N the normal, C the
/// centre.
void set_span_center(const std::array<double, 2>& pixel, double radius_mm, double range_mm,
                     Disc& disc) {
  const double x = static_cast<double>(disc.center_x);
  const double y = static_cast<double>(disc.center_y);
  const double nx = static_cast<double>(disc.gx);
  const double ny = static_cast<double>(disc.gy);
  const double nz = static_cast<double>(disc.gz);
  const double share = radius_mm * radius_mm / (range_mm * range_mm);
  const double bottom = share * (1.0 - nz * nz) - 1.0;
  const double off_x = (-share * nx * nz - x) / bottom - x;
  const double off_y = (-share * ny * nz - y) / bottom - y;
  const double uu = static_cast<double>(disc.ray_uu);
  const double uv = static_cast<double>(disc.ray_uv);
  const double vu = static_cast<double>(disc.ray_vu);
  const double vv = static_cast<double>(disc.ray_vv);
  const double determinant = uu * vv - uv * vu;
  disc.span_u = narrowed(pixel[0] + (off_x * vv - off_y * uv) / determinant);
  disc.span_v = narrowed(pixel[1] + (off_y * uu - off_x * vu) / determinant);
}

}  // namespace

DiscMaker::DiscMaker(const Scene& scene, const View& view, const Exposure& exposure,
                     const LightGrid& light, TubeAddress address, const TubeEnd& end)
    : scene_(scene), view_(view), address_(address), end_(end) {
  const std::array<double, 3>& center = end.center_mm;
  const LampLight lamp = light.at(scene, view, exposure, center);
  const auto pixel = view.pixel({center[0], center[1], center[2]});
  if (!pixel) {
    return;
  }
  const bool fillet = scene.sheet.weld == Weld::kFillet;
  if (share(kBoron) < scene.look.boron) {
    add_boron();
  }
  // A welded plug takes the tube-end's weld away with it.
  if (fillet && end.kind != TubeEndKind::kPlugFlush) {
    add_fillet(lamp);
  }
  switch (end.kind) {
    case TubeEndKind::kOpen: add_open(lamp, light.vignette((*pixel)[0], (*pixel)[1])); break;
    case TubeEndKind::kPlugFlush: add_flush_plug(); break;
    case TubeEndKind::kPlugRolled: add_rolled_plug(); break;
    case TubeEndKind::kVoid: break;
  }
}

bool DiscMaker::may_be_seen(const Scene& scene, const View& view,
                            const std::array<double, 2>& sheet_mm, std::int32_t top,
                            std::int32_t bottom) {
  const Transform<frames::Sheet, frames::Camera>& T = view.T_sheet_camera();
  const Eigen::Matrix3d& R = T.rotation();
  const Eigen::Vector3d& eye = T.translation_mm();
  const double x = sheet_mm[0] - eye.x();
  const double y = sheet_mm[1] - eye.y();
  const double z = -eye.z();
  const double range = R(0, 2) * x + R(1, 2) * y + R(2, 2) * z;
  if (!(range > 1.0)) {
    return false;
  }
  const double half_mm = 0.6 * scene.sheet.bore_mm + scene.look.fillet_mm +
                         scene.look.fillet_height_mm + scene.look.plug_height_mm;
  const Projection& projection = view.projection();
  const double margin_u = 1.3 * half_mm / (range * projection.unit_u()) + 12.0;
  const double margin_v = 1.3 * half_mm / (range * projection.unit_v()) + 12.0;
  // By the ideal ray first: distortion draws pixels in, never by more than this.
  const double ray_x = (R(0, 0) * x + R(1, 0) * y + R(2, 0) * z) / range;
  if (std::abs(ray_x) > 1.6 * (scene.camera.width_px + margin_u) * projection.unit_u()) {
    return false;
  }
  const auto pixel = view.pixel({sheet_mm[0], sheet_mm[1], 0.0});
  if (!pixel) {
    return false;
  }
  const std::array<double, 2> way = view.motion(*pixel, {sheet_mm[0], sheet_mm[1], 0.0});
  // Less than a third of a line high: lost in the dark at the horizon.
  const double distance = std::sqrt(x * x + y * y + z * z);
  const double lines = scene.sheet.bore_mm * std::abs(z) / (distance * range * projection.unit_v());
  return lines > 0.33 && (*pixel)[0] > -margin_u - std::abs(way[0]) &&
         (*pixel)[0] < scene.camera.width_px + margin_u + std::abs(way[0]) &&
         (*pixel)[1] > top - margin_v - std::abs(way[1]) &&
         (*pixel)[1] < bottom + margin_v + std::abs(way[1]);
}

Disc DiscMaker::placed(const Place& place) const {
  Disc disc;
  const Eigen::Matrix3d& R = view_.T_sheet_camera().rotation();
  const Eigen::Vector3d& eye = view_.T_sheet_camera().translation_mm();
  const Eigen::Vector3d center(place.center_mm[0], place.center_mm[1], place.center_mm[2]);
  const double ex = eye.x() - center.x();
  const double ey = eye.y() - center.y();
  const double height = center.z() - eye.z();
  const double range = -(R(0, 2) * ex + R(1, 2) * ey) + R(2, 2) * height;
  const auto pixel = view_.pixel(center);
  if (!pixel || !(height > 1.0) || !(range > 1.0)) {
    return disc;
  }
  disc.center_x = narrowed((-(R(0, 0) * ex + R(1, 0) * ey) + R(2, 0) * height) / range);
  disc.center_y = narrowed((-(R(0, 1) * ex + R(1, 1) * ey) + R(2, 1) * height) / range);
  disc.ax = narrowed(ex * R(2, 0) + height * R(0, 0));
  disc.ay = narrowed(ex * R(2, 1) + height * R(0, 1));
  disc.bx = narrowed(ey * R(2, 0) + height * R(1, 0));
  disc.by = narrowed(ey * R(2, 1) + height * R(1, 1));
  disc.gx = narrowed(R(2, 0));
  disc.gy = narrowed(R(2, 1));
  disc.gz = narrowed(R(2, 2));
  disc.eye_x = narrowed(ex);
  disc.eye_y = narrowed(ey);
  disc.eye_z = narrowed(height);
  disc.per_eye_z = narrowed(1.0 / height);
  disc.radius = narrowed(place.radius_mm);
  disc.per_radius = narrowed(1.0 / std::max(place.radius_mm, 1e-6));
  const double bell_px = static_cast<double>(kBellHalfWidth) * place.blur_px;
  disc.per_bell = narrowed(1.0 / bell_px);
  const RaySlopes slopes = view_.projection().ray_slopes((*pixel)[0], (*pixel)[1]);
  disc.ray_uu = narrowed(slopes.xu);
  disc.ray_uv = narrowed(slopes.xv);
  disc.ray_vu = narrowed(slopes.yu);
  disc.ray_vv = narrowed(slopes.yv);
  set_span_center(*pixel, place.radius_mm, range, disc);
  const std::array<double, 2> way = view_.motion(*pixel, center);
  set_spans(place.radius_mm, std::max(place.radius_mm, place.outer_mm),
            bell_px + 0.5 * std::hypot(way[0], way[1]), disc);
  return disc;
}

void DiscMaker::add(const Disc& disc) {
  if (disc.bottom >= disc.top) {
    static_cast<void>(discs_.try_push_back(disc));  // no tube-end has more than there is room for
  }
}

double DiscMaker::share(std::uint32_t what) const {
  return share_of(mixed(scene_.seed, address_.row, address_.column, what));
}

void DiscMaker::add_solid(double z_mm, double radius_mm, double level, double extra) {
  Disc disc = placed({{end_.center_mm[0], end_.center_mm[1], end_.center_mm[2] + z_mm},
                      radius_mm,
                      radius_mm,
                      scene_.sensor.blur_px});
  disc.level = narrowed(level);
  disc.extra = narrowed(extra);
  add(disc);
}

void DiscMaker::add_open(const LampLight& lamp, double vignette) {
  const SheetLook& look = scene_.look;
  const bool nicked = share(kNick) < look.nicked;
  const double nick_mm = nicked ? look.nick_mm * (0.3 + 0.7 * share(kNickDepth)) : 0.0;
  const bool flush = scene_.sheet.weld == Weld::kFlush;
  const double outer = flush ? end_.radius_mm + look.weld_mm : end_.radius_mm;
  Disc disc = placed({end_.center_mm, end_.radius_mm, std::max(outer, end_.radius_mm + nick_mm),
                      scene_.sensor.blur_px});
  disc.kind = Disc::Kind::kBore;
  const double direction = kTwoPi * share(kNickDirection);
  disc.nick_x = narrowed(std::cos(direction));
  disc.nick_y = narrowed(std::sin(direction));
  disc.nick_depth = narrowed(nick_mm);
  disc.lamp_x = narrowed(lamp.direction_x);
  disc.lamp_y = narrowed(lamp.direction_y);
  disc.lamp_slope = narrowed(std::min(lamp.slope, 100.0));
  // Of the light from below only the horizontal part falls on an upright wall.
  const double sine = 1.0 / std::sqrt(1.0 + lamp.slope * lamp.slope);
  disc.wall = narrowed(look.wall * lamp.wall * sine * vignette);
  disc.led = narrowed(look.wall * lamp.led * vignette);
  disc.floor = narrowed(0.004 * lamp.wall * look.wall * vignette);
  disc.ring_radius = narrowed(outer);
  // Welds differ: a few shine, most are hardly told from the plate.
  const double shine = share(kWeld);
  disc.ring_gain =
      flush && look.weld_mm > 0.0
          ? narrowed((look.weld / look.plate - 1.0) * (0.15 + 1.15 * shine * shine * shine))
          : 0.0F;
  // Far away neither weld nor wall is told apart: a dark spot, at half the cost.
  constexpr float kSmall_px = 6.0F;
  if (disc.minor_px < kSmall_px) {
    disc.extra = mean_inside(disc);
    disc.kind = Disc::Kind::kSolid;
  }
  add(disc);
}

void DiscMaker::add_fillet(const LampLight& lamp) {
  const SheetLook& look = scene_.look;
  const double foot = std::max(look.fillet_mm - look.land_mm, 0.1);
  const double length = std::hypot(foot, look.fillet_height_mm);
  const double bright = look.weld / look.plate;
  // The weld's cone against the plate: it faces outwards, so its side towards the lamps is bright.
  Disc cone =
      placed({{end_.center_mm[0], end_.center_mm[1], end_.center_mm[2] + look.fillet_height_mm},
              end_.radius_mm + look.fillet_mm,
              end_.radius_mm + look.fillet_mm,
              scene_.sensor.blur_px});
  cone.level = narrowed(0.75 * bright * foot / length);
  const double side = 0.6 * bright * look.fillet_height_mm / length / std::max(lamp.slope, 0.4);
  cone.has_inner = false;  // its light changes all over
  cone.level_x = narrowed(side * lamp.direction_x);
  cone.level_y = narrowed(side * lamp.direction_y);
  add(cone);
  if (end_.kind == TubeEndKind::kPlugRolled) {
    return;
  }
  // The tube's end stands out of its weld by a little and shades it.
  add_solid(0.25 * look.fillet_height_mm, end_.radius_mm + look.land_mm + 0.1, 0.12);
  add_solid(0.0, end_.radius_mm + look.land_mm, 1.15 * bright);
}

void DiscMaker::add_flush_plug() {
  const double outline_mm = 0.3;
  const double bright = scene_.look.plug / scene_.look.plate;
  const double z = scene_.sheet.weld == Weld::kFillet ? scene_.look.fillet_height_mm : 0.0;
  add_solid(z, end_.radius_mm, 0.55);
  add_solid(z, std::max(end_.radius_mm - outline_mm, 0.1),
            bright * (0.7 + 0.4 * share(kPlugLevel)));
}

void DiscMaker::add_rolled_plug() {
  const SheetLook& look = scene_.look;
  const double bright = look.plug / look.plate;
  add_solid(0.0, 1.12 * end_.radius_mm, 0.16);
  add_solid(-look.plug_height_mm, 1.06 * end_.radius_mm, bright);
  add_solid(-look.plug_height_mm, look.plug_hole * end_.radius_mm, 0.0, 0.3);
}

void DiscMaker::add_boron() {
  // A crust beside the rim, whitish, with soft edges.
  const double direction = kTwoPi * share(kBoronPlace);
  const double radius = end_.radius_mm * (0.25 + 0.3 * share(kBoronPlace + 1));
  const double off = 1.1 * end_.radius_mm;
  Disc crust = placed({{end_.center_mm[0] + off * std::cos(direction),
                        end_.center_mm[1] + off * std::sin(direction),
                        scene_.sheet.weld == Weld::kFillet ? scene_.look.fillet_height_mm : 0.0},
                       radius,
                       1.5 * radius,
                       3.0});
  crust.level = narrowed(1.25 + 0.4 * share(kBoronPlace + 2));
  add(crust);
}

}  // namespace tubesight::core::rendering
