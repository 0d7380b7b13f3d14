#include "core/rendering/disc.h"

#include <array>
#include <cmath>

#include "core/rendering/edge_spread.h"

namespace tubesight::core::rendering {
namespace {

/// Columns between two places of a bore's middle that are worked out.
constexpr std::int32_t kMiddleStep = 4;

/// Columns that are drawn together: stretches near a rim are widened to whole vectors, which
/// changes nothing outside the edge, where a disc's share is exactly 0.
constexpr std::int32_t kVector = 4;

/// Where a pixel's ray meets the disc's plane.
struct Meeting {
  float x, y;    // from the centre, mm
  float radius;  // its length
  float nx, ny;  // its direction
  float per_px;  // px per mm of radius
  float motion;  // half the way along the edge's normal, px
};

inline Meeting meet(const Disc& d, float ray_x, float ray_y, float motion_u, float motion_v) {
  const float dx = ray_x - d.center_x;
  const float dy = ray_y - d.center_y;
  const float per_w = 1.0F / (d.gx * ray_x + d.gy * ray_y + d.gz);
  Meeting m;
  m.x = (d.ax * dx + d.ay * dy) * per_w;
  m.y = (d.bx * dx + d.by * dy) * per_w;
  m.radius = std::sqrt(m.x * m.x + m.y * m.y + 1e-9F);
  const float per_radius = 1.0F / m.radius;
  m.nx = m.x * per_radius;
  m.ny = m.y * per_radius;
  // Slope of the radius over the picture, by ray and then by pixel.
  const float by_x = (m.nx * d.ax + m.ny * d.bx - m.radius * d.gx) * per_w;
  const float by_y = (m.nx * d.ay + m.ny * d.by - m.radius * d.gy) * per_w;
  const float by_u = by_x * d.ray_uu + by_y * d.ray_vu;
  const float by_v = by_x * d.ray_uv + by_y * d.ray_vv;
  m.per_px = 1.0F / std::sqrt(by_u * by_u + by_v * by_v + 1e-9F);
  const float along = (by_u * motion_u + by_v * motion_v) * (0.5F * m.per_px);
  m.motion = along < 0.0F ? -along : along;
  return m;
}

/// The rim's radius in a direction: larger where an edge is broken.
inline float rim(const Disc& d, const Meeting& m) {
  const float along = (m.nx * d.nick_x + m.ny * d.nick_y - 0.985F) * (1.0F / 0.015F);
  const float near = along < 0.0F ? 0.0F : along;
  return d.radius + d.nick_depth * near * (2.0F - near);
}

/// Grey level of the bore's wall (or of the dark) behind a point of its opening.
inline float inside_bore(const Disc& d, float x, float y) {
  const float dx = x - d.eye_x;
  const float dy = y - d.eye_y;
  const float a = dx * dx + dy * dy + 1e-3F;
  const float b = x * dx + y * dy;
  const float c = x * x + y * y - d.radius * d.radius;
  const float inner = c < 0.0F ? c : 0.0F;
  const float way = (std::sqrt(b * b - a * inner) - b) / a;
  const float wall_x = (x + way * dx) * d.per_radius;
  const float wall_y = (y + way * dy) * d.per_radius;
  const float depth = way * d.eye_z;
  // The lighthouse shines down to where its ray over the opposite rim meets the wall.
  const float facing = -(wall_x * d.lamp_x + wall_y * d.lamp_y);
  const float faced = facing < 0.0F ? 0.0F : facing;
  const float reach = 2.0F * d.radius * faced * d.lamp_slope - depth;
  const float share = reach * (2.5F * d.per_radius) + 0.5F;
  const float lit = share < 0.0F ? 0.0F : (share > 1.0F ? 1.0F : share);
  // The camera's LEDs light what the camera sees; less the deeper it is.
  const float to_camera = (wall_x * dx + wall_y * dy) * d.per_eye_z;
  const float seen = to_camera > 1.0F ? 1.0F : to_camera;
  const float near = d.radius / (d.radius + 0.5F * depth);
  return d.floor + d.wall * faced * lit + d.led * seen * near;
}

/// A stretch of a line: arrays by column.
struct Stretch {
  std::int32_t first = 0;
  std::int32_t last = -1;
};

/// The length of a stretch that is one of whole vectors; the compiler sees that nothing is left
/// over.
inline std::int32_t length_in_vectors(Stretch stretch) {
  return (stretch.last - stretch.first + 1) / kVector * kVector;
}

template <typename Edge>
void draw_bore_edge(const Disc& disc, Stretch stretch, const float* __restrict ray_x,
                    const float* __restrict ray_y, const float* __restrict motion_u,
                    const float* __restrict motion_v, float* __restrict signal) {
  const Disc d = disc;
  const std::int32_t count = length_in_vectors(stretch);
  ray_x += stretch.first;
  ray_y += stretch.first;
  motion_u += stretch.first;
  motion_v += stretch.first;
  signal += stretch.first;
  for (std::int32_t i = 0; i < count; ++i) {
    const Meeting m = meet(d, ray_x[i], ray_y[i], motion_u[i], motion_v[i]);
    const Edge edge(m.motion * d.per_bell);
    const float bells = m.per_px * d.per_bell;
    const float inside = edge.share((rim(d, m) - m.radius) * bells);
    const float ring = edge.share((d.ring_radius - m.radius) * bells);
    const float plate = signal[i] * (1.0F + d.ring_gain * ring);
    signal[i] = plate + (inside_bore(d, m.x, m.y) - plate) * inside;
  }
}

/// Far from the rim: the wall at every fourth pixel, a straight line in between.
void draw_bore_middle(const Disc& disc, Stretch stretch, const float* __restrict ray_x,
                      const float* __restrict ray_y, float* __restrict signal) {
  const Disc d = disc;
  std::array<float, Row::kCapacity / kMiddleStep + 1> levels;
  const std::int32_t steps = (stretch.last - stretch.first + 1) / kMiddleStep;
  const float* const x_of = ray_x + stretch.first;
  const float* const y_of = ray_y + stretch.first;
  float* const level_of = levels.data();
  for (std::int32_t k = 0; k <= steps; ++k) {
    const float ray_at_x = x_of[kMiddleStep * k];
    const float ray_at_y = y_of[kMiddleStep * k];
    const float dx = ray_at_x - d.center_x;
    const float dy = ray_at_y - d.center_y;
    const float per_w = 1.0F / (d.gx * ray_at_x + d.gy * ray_at_y + d.gz);
    level_of[k] = inside_bore(d, (d.ax * dx + d.ay * dy) * per_w, (d.bx * dx + d.by * dy) * per_w);
  }
  float* pixels = signal + stretch.first;
  for (std::int32_t k = 0; k < steps; ++k, pixels += kMiddleStep) {
    const float rise = (level_of[k + 1] - level_of[k]) * (1.0F / kMiddleStep);
    for (std::int32_t j = 0; j < kMiddleStep; ++j) {
      pixels[j] = level_of[k] + rise * static_cast<float>(j);
    }
  }
}

template <typename Edge>
void draw_solid_edge(const Disc& disc, Stretch stretch, const float* __restrict ray_x,
                     const float* __restrict ray_y, const float* __restrict motion_u,
                     const float* __restrict motion_v, const float* __restrict plate,
                     float* __restrict signal) {
  const Disc d = disc;
  const std::int32_t count = length_in_vectors(stretch);
  ray_x += stretch.first;
  ray_y += stretch.first;
  motion_u += stretch.first;
  motion_v += stretch.first;
  plate += stretch.first;
  signal += stretch.first;
  for (std::int32_t i = 0; i < count; ++i) {
    const Meeting m = meet(d, ray_x[i], ray_y[i], motion_u[i], motion_v[i]);
    const Edge edge(m.motion * d.per_bell);
    const float inside = edge.share((d.radius - m.radius) * m.per_px * d.per_bell);
    const float level = d.level + d.level_x * m.nx + d.level_y * m.ny;
    const float own = plate[i] * (level < 0.0F ? 0.0F : level) + d.extra;
    signal[i] += (own - signal[i]) * inside;
  }
}

void draw_solid_middle(const Disc& d, Stretch stretch, const float* __restrict plate,
                       float* __restrict signal) {
  const float level = d.level;
  const float extra = d.extra;
  for (std::int32_t i = stretch.first; i <= stretch.last; ++i) {
    signal[i] = plate[i] * level + extra;
  }
}

/// The columns of a line inside a span; first beyond last: none.
Stretch chord(const Disc& disc, const Disc::Span& span, std::int32_t v) {
  const float dv = static_cast<float>(v) - disc.span_v;
  const float b = span.b * dv;
  const float root2 = b * b - span.a * (span.c * dv * dv - 1.0F);
  if (!(root2 > 0.0F)) {
    return {};
  }
  const float root = std::sqrt(root2);
  constexpr float kFar = 1e6F;
  const float from = std::fmax(disc.span_u - (b + root) / span.a, -kFar);
  const float to = std::fmin(disc.span_u + (root - b) / span.a, kFar);
  return {static_cast<std::int32_t>(std::floor(from)), static_cast<std::int32_t>(std::ceil(to))};
}

/// The part of a stretch inside another.
Stretch both(Stretch a, Stretch b) {
  return {a.first > b.first ? a.first : b.first, a.last < b.last ? a.last : b.last};
}

template <typename Edge>
void draw_edge(const Disc& disc, Stretch stretch, Row& row) {
  if (stretch.first > stretch.last) {
    return;
  }
  const Stretch widened{stretch.first & -kVector, stretch.last | (kVector - 1)};
  if (disc.kind == Disc::Kind::kBore) {
    draw_bore_edge<Edge>(disc, widened, row.ray_x.data(), row.ray_y.data(), row.motion_u.data(),
                         row.motion_v.data(), row.signal.data());
  } else {
    draw_solid_edge<Edge>(disc, widened, row.ray_x.data(), row.ray_y.data(), row.motion_u.data(),
                          row.motion_v.data(), row.plate.data(), row.signal.data());
  }
}

template <typename Edge>
void draw(const Disc& disc, std::int32_t v, Stretch line, Row& row) {
  const Stretch whole = both(chord(disc, disc.outer, v), line);
  if (whole.first > whole.last) {
    return;
  }
  // Whole vectors at the same columns whatever the window, so that it shows what the whole would.
  Stretch middle = disc.has_inner ? chord(disc, disc.inner, v) : Stretch{};
  middle.first = (middle.first + kVector - 1) & -kVector;
  middle.last = ((middle.last + 1) & -kVector) - 1;
  const bool long_enough = middle.last - middle.first >= 2 * kVector;
  middle = both(middle, line);
  if (!long_enough || middle.first > middle.last) {
    draw_edge<Edge>(disc, whole, row);
    return;
  }
  draw_edge<Edge>(disc, both(whole, {line.first, middle.first - 1}), row);
  draw_edge<Edge>(disc, both(whole, {middle.last + 1, line.last}), row);
  if (disc.kind == Disc::Kind::kBore) {
    draw_bore_middle(disc, middle, row.ray_x.data(), row.ray_y.data(), row.signal.data());
  } else {
    draw_solid_middle(disc, middle, row.plate.data(), row.signal.data());
  }
}

}  // namespace

float mean_inside(const Disc& bore) {
  const float off = 0.6F * bore.radius;
  return 0.2F * (inside_bore(bore, 0.0F, 0.0F) + inside_bore(bore, off, 0.0F) +
                 inside_bore(bore, -off, 0.0F) + inside_bore(bore, 0.0F, off) +
                 inside_bore(bore, 0.0F, -off));
}

void draw_disc(const Disc& disc, std::int32_t v, std::int32_t first, std::int32_t last, bool moves,
               Row& row) {
  if (moves) {
    draw<MovingEdge>(disc, v, {first, last}, row);
  } else {
    draw<RestingEdge>(disc, v, {first, last}, row);
  }
}

}  // namespace tubesight::core::rendering
