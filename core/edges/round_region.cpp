#include "core/edges/round_region.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "core/base/static_vector.h"

namespace tubesight::core::edges {
namespace {

constexpr std::int32_t kDirections = 24;
constexpr std::int32_t kLeastDirections = 13;  // more than half: the others may be spoilt alike
constexpr std::int32_t kMostReach = 160;
constexpr std::int32_t kRises = 3;  // a direction: own rim, a spot, the next tube-end's far rim
constexpr std::int32_t kWidth = 3;  // readings to either side of a rise
constexpr std::int32_t kLeastRise = 6 * kWidth;  // grey levels: noise is below after the median
constexpr std::int32_t kLeastRadius = 4;         // steps

// Places in eighths of a step: squares and their products in a fit of 24 stay within 64 bits.
constexpr std::int32_t kUnit = 8;

// cos(15 degrees * i) in 1/16384.
constexpr std::array<std::int32_t, 7> kCosines{16384, 15826, 14189, 11585, 8192, 4240, 0};

std::int32_t cosine_q14(std::int32_t direction) {
  const std::int32_t i = direction % kDirections;
  const std::int32_t half = i > kDirections / 2 ? kDirections - i : i;
  return half <= 6 ? kCosines[static_cast<std::size_t>(half)]
                   : -kCosines[static_cast<std::size_t>(12 - half)];
}
std::int32_t sine_q14(std::int32_t direction) {
  return cosine_q14(direction + kDirections * 3 / 4);
}

struct Point {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

// A rise from dark to bright, as seen from the place in the middle.
struct Rise {
  Point at{};
  std::int32_t inside = 0;
  std::int32_t outside = 0;
};

using Rises = StaticVector<Rise, kRises>;
using AllRises = std::array<Rises, kDirections>;

// The median of nine by exchanges [Devillard1998 opt_med9].
std::int32_t median(std::array<std::uint8_t, 9> p) {
  const auto order = [&p](std::size_t a, std::size_t b) {
    const std::uint8_t least = std::min(p[a], p[b]);
    p[b] = std::max(p[a], p[b]);
    p[a] = least;
  };
  constexpr std::array<std::pair<std::size_t, std::size_t>, 19> kExchanges{{{1, 2},
                                                                            {4, 5},
                                                                            {7, 8},
                                                                            {0, 1},
                                                                            {3, 4},
                                                                            {6, 7},
                                                                            {1, 2},
                                                                            {4, 5},
                                                                            {7, 8},
                                                                            {0, 3},
                                                                            {5, 8},
                                                                            {4, 7},
                                                                            {3, 6},
                                                                            {1, 4},
                                                                            {2, 5},
                                                                            {4, 7},
                                                                            {4, 2},
                                                                            {6, 4},
                                                                            {4, 2}}};
  for (const auto& [a, b] : kExchanges) {
    order(a, b);
  }
  return p[4];
}

// The readings of one direction, up to the field's border.
struct Ray {
  std::array<std::uint8_t, kMostReach> grey{};
  std::int32_t size = 0;

  [[nodiscard]] std::int32_t at(std::int32_t step) const {
    return grey[static_cast<std::size_t>(step)];
  }
  // Of the readings ahead of a step over those behind it.
  [[nodiscard]] std::int32_t rise(std::int32_t step) const {
    std::int32_t sum = 0;
    for (std::int32_t i = 1; i <= kWidth; ++i) {
      sum += at(step + i) - at(step - i);
    }
    return sum;
  }
};

void read(const FieldView& field, Point from_q16, Point step_q16, std::int32_t reach, Ray& ray) {
  ray.size = 0;
  Point at = from_q16;
  for (; ray.size < std::min(reach, kMostReach); ++ray.size) {
    const std::int32_t u = (at.x + 32768) >> 16;
    const std::int32_t frame_line = (at.y + 32768) >> 16;
    const std::int32_t line = (frame_line - field.first_line) / field.line_step;
    if (u < 1 || u > field.width_px - 2 || frame_line < field.first_line || line < 1 ||
        line > field.lines - 2) {
      return;
    }
    const std::uint8_t* p = field.pixels + static_cast<std::ptrdiff_t>(line) * field.stride_px + u;
    const std::uint8_t* above = p - field.stride_px;
    const std::uint8_t* below = p + field.stride_px;
    ray.grey[static_cast<std::size_t>(ray.size)] = static_cast<std::uint8_t>(
        median({above[-1], above[0], above[1], p[-1], p[0], p[1], below[-1], below[0], below[1]}));
    at = {at.x + step_q16.x, at.y + step_q16.y};
  }
}

// The rise whose peak is at a step, in the eighth of a step where a parabola puts it. Empty where
// it is not dark all the way from the middle.
bool take_rise(const Ray& ray, std::int32_t direction, std::int32_t step, Rise& rise) {
  const std::int32_t here = ray.rise(step);
  const std::int32_t before = ray.rise(step - 1);
  const std::int32_t after = ray.rise(step + 1);
  rise.inside = ray.at(step - kWidth);
  rise.outside = ray.at(step + kWidth);
  const std::int32_t middle = (rise.inside + rise.outside) / 2;
  for (std::int32_t quarter = 1; quarter < 4; ++quarter) {
    if (ray.at((step - kWidth) * quarter / 4) >= middle) {
      return false;
    }
  }
  const std::int32_t bend = 2 * here - before - after;
  const std::int32_t way = kUnit * step + (bend > 0 ? kUnit / 2 * (after - before) / bend : 0);
  rise.at = {way * cosine_q14(direction) / 16384, way * sine_q14(direction) / 16384};
  return true;
}

// The nearest rises that are no small part of the largest.
void find_rises(const Ray& ray, std::int32_t direction, Rises& rises) {
  rises.clear();
  const std::int32_t first = kWidth + 1;
  const std::int32_t end = ray.size - kWidth - 1;
  std::int32_t largest = 0;
  for (std::int32_t step = first; step < end; ++step) {
    largest = std::max(largest, ray.rise(step));
  }
  const std::int32_t least = std::max(kLeastRise, largest * 2 / 5);
  for (std::int32_t step = first; step < end && rises.size() < kRises; ++step) {
    const std::int32_t here = ray.rise(step);
    const bool peak = here >= least && here > ray.rise(step - 1) && here >= ray.rise(step + 1);
    Rise rise;
    if (peak && take_rise(ray, direction, step, rise)) {
      static_cast<void>(rises.try_push_back(rise));
    }
  }
}

struct Circle {
  Point center{};
  std::int64_t radius2 = 0;
};

// Through three points: the centre c from p has 2 c . q = q . q and 2 c . r = r . r.
bool through(const Point& p, Point q, Point r, Circle& circle) {
  q = {q.x - p.x, q.y - p.y};
  r = {r.x - p.x, r.y - p.y};
  const std::int64_t twice = 2 * (std::int64_t{q.x} * r.y - std::int64_t{q.y} * r.x);
  // Fatter than a triangle of four by four steps.
  if (std::abs(twice) < 16 * kUnit * kUnit) {
    return false;
  }
  const std::int64_t qq = std::int64_t{q.x} * q.x + std::int64_t{q.y} * q.y;
  const std::int64_t rr = std::int64_t{r.x} * r.x + std::int64_t{r.y} * r.y;
  const std::int64_t x = (qq * r.y - rr * q.y) / twice;
  const std::int64_t y = (rr * q.x - qq * r.x) / twice;
  constexpr std::int64_t kMost = kMostReach * kUnit;
  circle.radius2 = x * x + y * y;
  if (std::abs(x) > kMost || std::abs(y) > kMost || circle.radius2 > kMost * kMost ||
      circle.radius2 < kLeastRadius * kLeastRadius * kUnit * kUnit) {
    return false;
  }
  circle.center = {p.x + static_cast<std::int32_t>(x), p.y + static_cast<std::int32_t>(y)};
  // The place lies within 80 % of the radius.
  const std::int64_t off = std::int64_t{circle.center.x} * circle.center.x +
                           std::int64_t{circle.center.y} * circle.center.y;
  return off * 16 < circle.radius2 * 10;
}

std::int32_t root(std::int64_t square) {
  std::int64_t low = 0;
  std::int64_t high = 2 * kMostReach * kUnit;
  while (high - low > 1) {
    const std::int64_t middle = (low + high) / 2;
    (middle * middle <= square ? low : high) = middle;
  }
  return static_cast<std::int32_t>(low);
}

// How much a circle has for it.
struct Support {
  std::int32_t directions = 0;
  std::int64_t off = 0;  // sum of | d^2 - r^2 | of its rises
  std::array<const Rise*, kDirections> rises{};

  [[nodiscard]] bool beats(const Support& other) const {
    return directions != other.directions ? directions > other.directions : off < other.off;
  }
};

// A rise lies on the circle when it is off by a step and a fourteenth of the radius at most: what
// perspective does to a circle, and edges. |d^2 - r^2| is 2 r times that.
Support support_of(const AllRises& all, const Circle& circle) {
  Support support;
  const std::int64_t radius = root(circle.radius2);
  const std::int64_t most = 2 * radius * (kUnit + radius / 14);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::int64_t best = most;
    for (const Rise& rise : all[i]) {
      const std::int64_t x = rise.at.x - circle.center.x;
      const std::int64_t y = rise.at.y - circle.center.y;
      const std::int64_t off = std::abs(x * x + y * y - circle.radius2);
      if (off < best) {
        best = off;
        support.rises[i] = &rise;
      }
    }
    support.directions += support.rises[i] != nullptr ? 1 : 0;
    support.off += support.rises[i] != nullptr ? best : 0;
  }
  return support;
}

// The circle through three rises of different directions that the most others agree with.
Circle best_circle(const AllRises& all, Support& best) {
  constexpr std::array<std::array<std::size_t, 2>, 4> kApart{{{8, 16}, {5, 14}, {7, 12}, {3, 10}}};
  Circle found;
  const auto look = [&](const Rise& a, const Rise& b, const Rise& c) {
    Circle circle;
    if (!through(a.at, b.at, c.at, circle)) {
      return;
    }
    const Support support = support_of(all, circle);
    if (support.beats(best)) {
      best = support;
      found = circle;
    }
  };
  for (const auto& [second, third] : kApart) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const Rise& a : all[i]) {
        for (const Rise& b : all[(i + second) % kDirections]) {
          for (const Rise& c : all[(i + third) % kDirections]) {
            look(a, b, c);
          }
        }
      }
    }
  }
  return found;
}

// Least squares [Kasa1976]: with places from their mean, the centre c solves
//
//   2 [Sxx Sxy; Sxy Syy] c = [Sx(xx+yy); Sy(xx+yy)],   r^2 = c . c + mean(xx + yy).
bool fit_circle(const Support& support, Circle& circle) {
  Point mean;
  for (const Rise* const rise : support.rises) {
    mean.x += rise != nullptr ? rise->at.x : 0;
    mean.y += rise != nullptr ? rise->at.y : 0;
  }
  mean = {mean.x / support.directions, mean.y / support.directions};
  std::int64_t xx = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
  std::int64_t x3 = 0;
  std::int64_t y3 = 0;
  for (const Rise* const rise : support.rises) {
    if (rise == nullptr) {
      continue;
    }
    const std::int64_t x = rise->at.x - mean.x;
    const std::int64_t y = rise->at.y - mean.y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    x3 += x * (x * x + y * y);
    y3 += y * (x * x + y * y);
  }
  const std::int64_t twice = 2 * (xx * yy - xy * xy);
  if (twice <= 0) {
    return false;
  }
  const std::int64_t x = (x3 * yy - y3 * xy) / twice;
  const std::int64_t y = (y3 * xx - x3 * xy) / twice;
  circle.center = {mean.x + static_cast<std::int32_t>(x), mean.y + static_cast<std::int32_t>(y)};
  circle.radius2 = x * x + y * y + (xx + yy) / support.directions;
  return true;
}

RoundRegion image_of(const Circle& circle, const Support& support, Point from_q16,
                     const CircleShape& shape) {
  const auto place = [&](std::int32_t from, std::int64_t along, std::int64_t across) {
    return from +
           static_cast<std::int32_t>((circle.center.x * along + circle.center.y * across) / kUnit);
  };
  // Widest where the angle's derivative vanishes: 2 r sqrt(along^2 + across^2).
  const auto size = [&](std::int64_t along, std::int64_t across) {
    const std::int32_t length_q8 = root((along * along + across * across) >> 16);
    return static_cast<std::int32_t>(std::int64_t{2} * root(circle.radius2) * length_q8 * 256 /
                                     kUnit);
  };
  RoundRegion region;
  region.found = true;
  region.center_u_q16 = place(from_q16.x, shape.along_u_q16, shape.across_u_q16);
  region.center_v_q16 = place(from_q16.y, shape.along_v_q16, shape.across_v_q16);
  region.width_q16 = size(shape.along_u_q16, shape.across_u_q16);
  region.height_q16 = size(shape.along_v_q16, shape.across_v_q16);
  for (const Rise* const rise : support.rises) {
    region.inside += rise != nullptr ? rise->inside : 0;
    region.outside += rise != nullptr ? rise->outside : 0;
  }
  region.inside /= support.directions;
  region.outside /= support.directions;
  return region;
}

}  // namespace

RoundRegion find_round_region(const FieldView& field, std::int32_t u_px, std::int32_t v_px,
                              const CircleShape& shape, std::int32_t reach) {
  const Point from_q16{u_px * 65536, v_px * 65536};
  AllRises all{};
  Ray ray;
  for (std::int32_t i = 0; i < kDirections; ++i) {
    const std::int64_t c = cosine_q14(i);
    const std::int64_t s = sine_q14(i);
    const Point step_q16{
        static_cast<std::int32_t>((c * shape.along_u_q16 + s * shape.across_u_q16) / 16384),
        static_cast<std::int32_t>((c * shape.along_v_q16 + s * shape.across_v_q16) / 16384)};
    read(field, from_q16, step_q16, reach, ray);
    find_rises(ray, i, all[static_cast<std::size_t>(i)]);
  }
  Support support;
  Circle circle = best_circle(all, support);
  for (int round = 0; round < 2; ++round) {
    if (support.directions < kLeastDirections || !fit_circle(support, circle)) {
      return {};
    }
    support = support_of(all, circle);
  }
  return support.directions < kLeastDirections ? RoundRegion{}
                                               : image_of(circle, support, from_q16, shape);
}

}  // namespace tubesight::core::edges
