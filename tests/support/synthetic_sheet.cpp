#include "tests/support/synthetic_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/trigonometry.h"

namespace tubesight::tests {
namespace {

using core::TubeAddress;
using Matrix = std::array<std::array<double, 3>, 3>;
using Point = std::array<double, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
  }
  return c;
}

Point product(const Matrix& a, const Point& p) {
  Point q{};
  for (std::size_t i = 0; i < 3; ++i) {
    q[i] = a[i][0] * p[0] + a[i][1] * p[1] + a[i][2] * p[2];
  }
  return q;
}

Matrix transposed(const Matrix& a) {
  return {{{a[0][0], a[1][0], a[2][0]}, {a[0][1], a[1][1], a[2][1]}, {a[0][2], a[1][2], a[2][2]}}};
}

// Rz(alpha) Ry(beta) Rx(gamma), each written out.
Matrix rotation(double alpha_deg, double beta_deg, double gamma_deg) {
  const auto a = core::sine_cosine(core::radians(alpha_deg));
  const auto b = core::sine_cosine(core::radians(beta_deg));
  const auto g = core::sine_cosine(core::radians(gamma_deg));
  const Matrix about_z{{{a.cosine, -a.sine, 0}, {a.sine, a.cosine, 0}, {0, 0, 1}}};
  const Matrix about_y{{{b.cosine, 0, b.sine}, {0, 1, 0}, {-b.sine, 0, b.cosine}}};
  const Matrix about_x{{{1, 0, 0}, {0, g.cosine, -g.sine}, {0, g.sine, g.cosine}}};
  return product(product(about_z, about_y), about_x);
}

// From 0 to 1 while t goes from -1 to 1, point-symmetric about 1/2.
double ramp(double t) {
  if (t <= -1.0) {
    return 0.0;
  }
  if (t >= 1.0) {
    return 1.0;
  }
  const double s = (t + 1.0) / 2.0;
  return s * s * (3.0 - 2.0 * s);
}

// A picture is divided into squares, in each of which the scale is about the same.
constexpr std::int32_t kCell_px = 32;
constexpr double kUnknown = 1e30;

double distance(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
}

double rounded(double value) { return std::floor(value + 0.5); }

bool contains(const std::vector<TubeAddress>& list, TubeAddress address) {
  return std::find(list.begin(), list.end(), address) != list.end();
}

// Numbers that look random, the same on every machine.
class Noise {
 public:
  explicit Noise(std::uint32_t seed) : state_(seed * 2654435761U + 12345U) {}

  /// Standard deviation 1: four uniform numbers summed.
  double next() {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
      state_ ^= state_ << 13U;
      state_ ^= state_ >> 17U;
      state_ ^= state_ << 5U;
      sum += static_cast<double>(state_ >> 8U) / 16777216.0 - 0.5;
    }
    return sum * 1.7320508075688772;  // the sum's variance is 4 / 12
  }

 private:
  std::uint32_t state_;
};

}  // namespace

/// A pixel's ray in the sheet frame: from `eye`, along turn * (x, y, 1).
struct SyntheticSheet::Rays {
  Point eye{};
  Matrix turn{};  // R_sheet_camera

  /// 1 where a ray looks straight at the sheet, 0 where it runs along.
  [[nodiscard]] double steepness(const std::array<double, 2>& ray) const {
    const Point d = product(turn, Point{ray[0], ray[1], 1.0});
    return d[2] / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }

  [[nodiscard]] std::optional<std::array<double, 2>> hit(const std::array<double, 2>& ray) const {
    const Point d = product(turn, Point{ray[0], ray[1], 1.0});
    if (d[2] < 0.05) {
      return std::nullopt;
    }
    const double reach = -eye[2] / d[2];
    return std::array<double, 2>{eye[0] + reach * d[0], eye[1] + reach * d[1]};
  }
};

SyntheticSheet::SyntheticSheet(const core::SessionSettings& settings)
    : camera_(settings.camera),
      cell_mm_(camera_.cell_width_mm / camera_.horizontal_scale * camera_.sensor_columns /
               camera_.frame_columns),
      tool_(settings.tool),
      origin_mm_(settings.tubesheet.origin_mm),
      row_step_mm_(settings.tubesheet.row_step_mm),
      column_step_mm_(settings.tubesheet.column_step_mm),
      bore_mm_(settings.tubesheet.bore_mm),
      addresses_(settings.tubesheet.addresses),
      odd_row_shift_(settings.tubesheet.odd_row_shift),
      missing_(settings.tubesheet.missing.begin(), settings.tubesheet.missing.end()),
      plugged_(settings.tubesheet.plugged.begin(), settings.tubesheet.plugged.end()) {
  look.fillet = settings.tubesheet.weld == core::Weld::kFillet;

  // Half the way between the two tubes that stand closest, and a bit less.
  double least = 1e30;
  for (const TubeAddress from : {TubeAddress{0, 0}, TubeAddress{1, 0}, TubeAddress{0, 1}}) {
    for (std::int32_t row = -8; row <= 8; ++row) {
      for (std::int32_t column = -8; column <= 8; ++column) {
        const TubeAddress to{row, column};
        if (exists(from) && exists(to) && to != from) {
          least = std::min(least, squared_distance(to, center_of(from)));
        }
      }
    }
  }
  alone_mm_ = 0.499 * std::sqrt(least);
}

// Distorted to ideal, divided by EFL.
std::array<double, 2> SyntheticSheet::ray_of(double u, double v) const {
  const double x = cell_mm_ * (u - camera_.center_px[0]);
  const double y = camera_.cell_height_mm * (v - camera_.center_px[1]);
  const double r2 = x * x + y * y;
  const double factor = 1.0 + r2 * (camera_.distortion_per_mm2 + r2 * camera_.distortion2_per_mm4);
  return {x * factor / camera_.focal_length_mm, y * factor / camera_.focal_length_mm};
}

SyntheticSheet::Rays SyntheticSheet::rays_of(const ToolPlace& place) const {
  const Matrix R_camera_tool =
      rotation(tool_.rotation_deg[0], tool_.rotation_deg[1], tool_.rotation_deg[2]);
  const Matrix R_sheet_tool = rotation(place.alpha_deg, place.beta_deg, place.gamma_deg);
  Rays rays;
  rays.turn = product(R_sheet_tool, transposed(R_camera_tool));
  const Point eye = product(
      rays.turn, Point{-tool_.position_mm[0], -tool_.position_mm[1], -tool_.position_mm[2]});
  rays.eye = {eye[0] + place.x_mm, eye[1] + place.y_mm, eye[2] - place.height_mm};
  return rays;
}

std::array<double, 2> SyntheticSheet::image_of(const ToolPlace& place,
                                               const std::array<double, 3>& point_mm) const {
  const Rays rays = rays_of(place);
  const Point seen = product(
      transposed(rays.turn),
      Point{point_mm[0] - rays.eye[0], point_mm[1] - rays.eye[1], point_mm[2] - rays.eye[2]});
  const double x = seen[0] / seen[2] * camera_.focal_length_mm;
  const double y = seen[1] / seen[2] * camera_.focal_length_mm;
  const double ideal = std::sqrt(x * x + y * y);
  double r = ideal;  // r (1 + k r^2 + k2 r^4) = ideal by Newton's method
  for (int i = 0; i < 60; ++i) {
    const double r2 = r * r;
    const double k = camera_.distortion_per_mm2;
    const double k2 = camera_.distortion2_per_mm4;
    r -= (r * (1.0 + r2 * (k + r2 * k2)) - ideal) / (1.0 + r2 * (3.0 * k + r2 * 5.0 * k2));
  }
  const double share = ideal > 0.0 ? r / ideal : 1.0;
  return {camera_.center_px[0] + x * share / cell_mm_,
          camera_.center_px[1] + y * share / camera_.cell_height_mm};
}

std::array<double, 2> SyntheticSheet::image_of(const ToolPlace& place, TubeAddress address) const {
  const auto center = center_of(address);
  return image_of(place, Point{center[0], center[1], 0.0});
}

std::optional<std::array<double, 2>> SyntheticSheet::sheet_point(
    const ToolPlace& place, const std::array<double, 2>& pixel) const {
  return rays_of(place).hit(ray_of(pixel[0], pixel[1]));
}

std::array<double, 2> SyntheticSheet::axis_point(const ToolPlace& place) const {
  const Matrix R = rotation(place.alpha_deg, place.beta_deg, place.gamma_deg);
  return {place.x_mm + place.height_mm * R[0][2] / R[2][2],
          place.y_mm + place.height_mm * R[1][2] / R[2][2]};
}

// The numbering is the oracle's own: core/tubesheet is what it judges.
std::array<double, 2> SyntheticSheet::center_of(TubeAddress address) const {
  const double column = address.column + (address.row % 2 == 0 ? 0.0 : odd_row_shift_);
  return {origin_mm_[0] + address.row * row_step_mm_[0] + column * column_step_mm_[0],
          origin_mm_[1] + address.row * row_step_mm_[1] + column * column_step_mm_[1]};
}

bool SyntheticSheet::exists(TubeAddress address) const {
  const bool even = ((address.row + address.column) & 1) == 0;
  return addresses_ == core::AddressParity::kAll ||
         even == (addresses_ == core::AddressParity::kEvenSum);
}

double SyntheticSheet::squared_distance(TubeAddress address,
                                        const std::array<double, 2>& point_mm) const {
  const auto center = center_of(address);
  const double dx = center[0] - point_mm[0];
  const double dy = center[1] - point_mm[1];
  return dx * dx + dy * dy;
}

TubeAddress SyntheticSheet::nearest(const std::array<double, 2>& point_mm) const {
  const double x = point_mm[0] - origin_mm_[0];
  const double y = point_mm[1] - origin_mm_[1];
  const double area = row_step_mm_[0] * column_step_mm_[1] - row_step_mm_[1] * column_step_mm_[0];
  const auto row =
      static_cast<std::int32_t>(rounded((x * column_step_mm_[1] - y * column_step_mm_[0]) / area));
  const auto column =
      static_cast<std::int32_t>(rounded((y * row_step_mm_[0] - x * row_step_mm_[1]) / area));
  TubeAddress best{row, column};
  if (exists(best) && squared_distance(best, point_mm) < alone_mm_ * alone_mm_) {
    return best;
  }
  double least = 1e30;
  for (std::int32_t i = -1; i <= 1; ++i) {
    for (std::int32_t j = -2; j <= 2; ++j) {
      const TubeAddress address{row + i, column + j};
      if (!exists(address)) {
        continue;
      }
      const double distance = squared_distance(address, point_mm);
      if (distance < least) {
        least = distance;
        best = address;
      }
    }
  }
  return best;
}

SyntheticSheet::End SyntheticSheet::end_of(TubeAddress address) const {
  if (contains(missing_, address) || contains(look.flush_plugs, address)) {
    return End::kNone;
  }
  const bool rolled = contains(plugged_, address) || contains(look.rolled_plugs, address);
  return rolled ? End::kRolled : End::kOpen;
}

SyntheticSheet::Surroundings SyntheticSheet::around(const std::array<double, 2>& point_mm) const {
  const TubeAddress address = nearest(point_mm);
  auto center = center_of(address);
  for (const DisplacedTube& tube : look.displaced) {
    if (tube.address == address) {
      center = {center[0] + tube.by_mm[0], center[1] + tube.by_mm[1]};
    }
  }
  return {distance(point_mm, center), end_of(address), center};
}

// At a cell's corners, where it does not look along the sheet: there the scale changes slowly.
double SyntheticSheet::most_mm_per_px(const Rays& rays, std::int32_t u, std::int32_t v) const {
  if (!look.displaced.empty()) {
    return kUnknown;  // the distance to the nearest tube has leaps
  }
  double across = 0.0;
  double down = 0.0;
  for (const auto& [i, j] :
       {std::array{0, 0}, {kCell_px, 0}, {0, kCell_px}, {kCell_px, kCell_px}}) {
    const auto ray = ray_of(u + i, v + j);
    const auto here = rays.hit(ray);
    const auto right = rays.hit(ray_of(u + i + 1, v + j));
    const auto below = rays.hit(ray_of(u + i, v + j + 1));
    if (rays.steepness(ray) < 0.25 || !here || !right || !below) {
      return kUnknown;
    }
    across = std::max(across, distance(*here, *right));
    down = std::max(down, distance(*here, *below));
  }
  // Between the corners it can be a bit more.
  return 1.25 * std::sqrt(across * across + down * down);
}

// The same bytes as if each pixel looked at its surroundings, but several times as fast: most lie
// farther from an edge than its rise is wide, and so do those that follow.
SyntheticSheet::Grey SyntheticSheet::grey(const Rays& rays, double scale, double u,
                                          double v) const {
  const double edge_mm = std::min(4.0, scale * look.blur_px);  // no rise is wider
  const auto radius_at = [&](double column, double line) {
    const auto point = rays.hit(ray_of(column, line));
    return point ? around(*point) : Surroundings{1000.0, End::kNone, {}};
  };
  const Surroundings here = radius_at(u, v);
  if (here.end == End::kNone) {
    return {look.sheet, 0.0};
  }
  const double whole_bore = bore_mm_ / 2.0;
  const double bore = whole_bore * (here.end == End::kRolled ? look.plug_hole : 1.0);
  const double beyond = look.fillet ? look.rim_mm + look.shadow_mm : 0.0;
  const double shadow_end = bore + look.rim_mm + look.shadow_mm;
  if (here.radius_mm < bore - edge_mm) {
    return {look.dark, bore - edge_mm - here.radius_mm};
  }
  if (here.radius_mm > bore + beyond + edge_mm) {
    // The next tube may have the larger bore.
    const double outside = whole_bore * std::max(1.0, look.plug_hole) + beyond + edge_mm;
    return {look.sheet, std::max(0.0, here.radius_mm - outside)};
  }
  // So close to the tube's centre, the places a quarter of a pixel farther belong to the same tube.
  const bool alone = here.radius_mm + scale < alone_mm_;
  const auto beside = [&](double column, double line) {
    return alone ? distance(*rays.hit(ray_of(column, line)), here.center)
                 : radius_at(column, line).radius_mm;
  };
  const double gu = beside(u + 0.25, v) - beside(u - 0.25, v);
  const double gv = beside(u, v + 0.25) - beside(u, v - 0.25);
  const double mm_per_px = 2.0 * std::sqrt(gu * gu + gv * gv);
  const auto risen = [&](double radius_mm) {
    return ramp((here.radius_mm - radius_mm) / (mm_per_px * look.blur_px));
  };
  if (!look.fillet) {
    return {look.dark + (look.sheet - look.dark) * risen(bore), 0.0};
  }
  return {look.dark + (look.rim - look.dark) * risen(bore) +
              (look.shadow - look.rim) * risen(bore + look.rim_mm) +
              (look.sheet - look.shadow) * risen(shadow_end),
          0.0};
}

void SyntheticSheet::draw(const ToolPlace& place, core::Parity parity, std::uint32_t seed,
                          Frame& frame) const {
  frame.resize(static_cast<std::size_t>(camera_.width_px) *
               static_cast<std::size_t>(camera_.height_px));
  frame.shrink_to_fit();
  const Rays rays = rays_of(place);
  std::vector<double> cells;  // the scale in those of the lines at hand
  Noise noise(seed);
  const std::int32_t first = parity == core::Parity::kOdd ? 1 : 0;
  const std::int32_t step = parity == core::Parity::kProgressive ? 1 : 2;
  for (std::int32_t v = first; v < camera_.height_px; v += step) {
    if (cells.empty() || v % kCell_px < step) {
      cells.clear();
      for (std::int32_t u = 0; u < camera_.width_px; u += kCell_px) {
        cells.push_back(most_mm_per_px(rays, u, v / kCell_px * kCell_px));
      }
    }
    double level = 0.0;
    std::int32_t known_to = 0;  // the first pixel that may be of another level
    for (std::int32_t u = 0; u < camera_.width_px; ++u) {
      const bool bar =
          u >= look.bar_px[0] && v >= look.bar_px[1] && u <= look.bar_px[2] && v <= look.bar_px[3];
      double value = look.offset;
      if (look.gain > 0.0) {
        if (!bar && u >= known_to) {
          const double scale = cells[static_cast<std::size_t>(u / kCell_px)];
          const Grey here = grey(rays, scale, u, v);
          level = here.level;
          known_to = std::min(u + 1 + static_cast<std::int32_t>(here.clear_mm / scale),
                              (u / kCell_px + 1) * kCell_px);
        }
        value += look.gain * (bar ? look.bar : level);
      }
      if (look.noise > 0.0) {
        value += look.noise * noise.next();
      }
      frame[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width_px) +
            static_cast<std::size_t>(u)] =
          static_cast<std::uint8_t>(std::clamp(rounded(value), 0.0, 255.0));
    }
  }
}

core::FieldView SyntheticSheet::view(const Frame& frame, core::Parity parity) const {
  return core::field_of({frame.data(), camera_.width_px, camera_.height_px, camera_.width_px},
                        parity);
}

}  // namespace tubesight::tests
