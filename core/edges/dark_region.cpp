#include "core/edges/dark_region.h"

#include <algorithm>

#include "core/edges/edge_search.h"

namespace tubesight::core::edges {
namespace {

// A tube-end lies half in the lamp's brightest spot and half beside it: a threshold that followed
// the bright rim would walk over the dim one to the next tube-end. 20 grey levels under Eq. 6.1 are
// more than the inside of a tube-end ever shows.
constexpr std::int32_t kMostFollowed = 240;

constexpr int kAttempts = 4;

/// Positions are readings: every `step`-th pixel or line, `offset` being the first.
struct Walk {
  EdgePath path;
  std::int32_t step = 1;
  std::int32_t offset = 0;
  std::int32_t from = 0;
  std::int32_t limit = 0;  ///< positions 0 .. limit - 1 exist
  std::int32_t taps = 0;
  std::int32_t reach = 0;
};

// One edge outwards from walk.from; tried again at half the threshold with the start moved inwards,
// as the source does for edges that are difficult to detect.
Edge edge_outwards(const Walk& walk, std::int32_t direction, DynamicThreshold& threshold) {
  std::int32_t first = walk.from;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::int32_t lowest = walk.taps;
    const std::int32_t highest = walk.limit - 2 - walk.taps;
    first = std::clamp(first, lowest, highest);
    const std::int32_t room = direction > 0 ? highest - first : first - lowest - 1;
    const std::int32_t steps = std::min(walk.reach, room);
    if (steps <= 0) {
      return {};
    }
    const EdgePeak peak =
        find_edge(walk.path, {first, direction, steps, walk.taps, threshold.for_taps(walk.taps)});
    if (peak.found) {
      threshold.follow(peak.gradient, walk.taps, kMostFollowed);
      const EdgeReach reach{walk.taps == kVerticalTaps ? 2 : 4, walk.taps == kVerticalTaps ? 2 : 4};
      const bool inside =
          peak.position - reach.dark - 1 >= 0 && peak.position + reach.dark + 1 < walk.limit &&
          peak.position - reach.bright - 2 >= 0 && peak.position + reach.bright + 2 < walk.limit;
      Edge edge = inside ? refine_edge(walk.path, peak, direction, reach, 6) : Edge{};
      if (!edge.found) {
        // Sure of the rise, not of its middle: the peak is good enough for a bisection.
        edge = {true, peak.position * 65536, 0};
      }
      return edge;
    }
    if (threshold.at_least()) {
      return {};
    }
    threshold.halve();
    first -= 2 * direction;
  }
  return {};
}

/// The readings of a path of `size` pixels or lines that pass `from`.
Walk walk_along(const EdgePath& path, std::int32_t step, std::int32_t from, std::int32_t size) {
  const std::int32_t offset = from % step;
  Walk walk;
  walk.path = every(path, step, offset);
  walk.step = step;
  walk.offset = offset;
  walk.from = from / step;
  walk.limit = (size - offset + step - 1) / step;
  return walk;
}

/// In pixels or lines.
struct Span {
  bool found = false;
  std::int32_t low_q16 = 0;
  std::int32_t high_q16 = 0;

  [[nodiscard]] std::int32_t middle() const { return (low_q16 / 2 + high_q16 / 2) / 65536; }
};

Span span_around(const Walk& walk, DynamicThreshold& threshold) {
  const Edge low = edge_outwards(walk, -1, threshold);
  if (!low.found) {
    return {};
  }
  const Edge high = edge_outwards(walk, 1, threshold);
  const auto place_q16 = [&walk](const Edge& edge) {
    return edge.position_q16 * walk.step + walk.offset * 65536;
  };
  return {high.found, place_q16(low), place_q16(high)};
}

}  // namespace

DarkRegion find_dark_region(const FieldView& field, std::int32_t u_px, std::int32_t v_px,
                            std::int32_t reach_px, DynamicThreshold& threshold,
                            std::int32_t reading_step_px) {
  const std::int32_t step = field.line_step;
  const std::int32_t lines_a_reading = std::max(reading_step_px / step, 1);
  const auto column_walk = [&](std::int32_t u, std::int32_t line) {
    u = std::clamp(u, 2, field.width_px - 3);
    Walk walk = walk_along(vertical_path(field, u), lines_a_reading, line, field.lines);
    walk.taps = kVerticalTaps;
    walk.reach = reach_px / (step * lines_a_reading);
    return walk;
  };
  const std::int32_t start_line = (v_px - field.first_line) / step;
  if (u_px < 0 || u_px >= field.width_px || start_line < 0 || start_line >= field.lines ||
      field.width_px < 32 || field.lines < 16) {
    return {};
  }
  Span vertical = span_around(column_walk(u_px, start_line), threshold);
  if (!vertical.found) {
    return {};
  }
  const std::int32_t line = std::clamp(vertical.middle(), 1, field.lines - 2);
  Walk along = walk_along(horizontal_path(field, line), reading_step_px, u_px, field.width_px);
  along.taps = kHorizontalTaps;
  along.reach = reach_px / reading_step_px;
  const Span horizontal = span_around(along, threshold);
  if (!horizontal.found) {
    return {};
  }
  vertical = span_around(column_walk(horizontal.middle(), line), threshold);
  if (!vertical.found) {
    return {};
  }
  const auto frame_q16 = [&](std::int32_t line_q16) {
    return line_q16 * step + field.first_line * 65536;
  };
  return {true, horizontal.low_q16, horizontal.high_q16, frame_q16(vertical.low_q16),
          frame_q16(vertical.high_q16)};
}

CrossHair look_at_cross_hair(const FieldView& field, std::int32_t u_px, std::int32_t v_px,
                             std::int32_t reach_u_px, std::int32_t reach_v_px,
                             std::int32_t threshold) {
  constexpr std::int32_t kWhite = 250;
  const std::int32_t line = (v_px - field.first_line) / field.line_step;
  const std::int32_t reach_lines = reach_v_px / field.line_step;
  const auto along = [](std::int32_t at, std::int32_t step, std::int32_t size) {
    return std::clamp(at + step, 0, size - 1);
  };
  const auto* row =
      field.pixels + static_cast<std::ptrdiff_t>(along(line, 0, field.lines)) * field.stride_px;
  const auto* column = field.pixels + along(u_px, 0, field.width_px);
  std::int32_t sum = 0;
  std::int32_t dark = 0;
  std::int32_t least = 255;
  std::int32_t most = 0;
  const auto take = [&](std::int32_t grey) {
    sum += grey;
    dark += grey <= threshold ? 1 : 0;
    least = std::min(least, grey);
    most = std::max(most, grey);
  };
  for (std::int32_t i = 1; i <= 4; ++i) {
    const std::int32_t across = reach_u_px * i / 4;
    const std::int32_t down = reach_lines * i / 4;
    const auto at_line = [&](std::int32_t step) {
      return std::int32_t{
          column[static_cast<std::ptrdiff_t>(along(line, step, field.lines)) * field.stride_px]};
    };
    take(row[along(u_px, across, field.width_px)]);
    take(row[along(u_px, -across, field.width_px)]);
    take(at_line(down));
    take(at_line(-down));
  }
  return {sum / 16, dark, least == most && most < kWhite};
}

}  // namespace tubesight::core::edges
