#include "core/edges/edge_search.h"

#include <algorithm>
#include <type_traits>

namespace tubesight::core::edges {
namespace {

// A rise has passed its peak when the gradient did not grow for so many steps; one is noise.
constexpr std::int32_t kDecliningSteps = 2;

// How a walk reads pixels. The usual walks have their taps known to the compiler, and those along a
// line their steps, too, which halves their cost.
struct AnySteps {
  std::ptrdiff_t side = 0;
  std::ptrdiff_t step = 1;  // outwards
  std::int32_t taps = 0;
};

template <int kTaps>
struct KnownTaps {
  std::ptrdiff_t side = 0;
  std::ptrdiff_t step = 1;
  static constexpr std::int32_t taps = kTaps;
};

template <int kStep, int kTaps>
struct KnownSteps {
  std::ptrdiff_t side = 0;
  static constexpr std::ptrdiff_t step = kStep;
  static constexpr std::int32_t taps = kTaps;
};

// Positions of the peak are counted from the first step.
template <typename Steps>
EdgePeak walk(const Steps& steps, const std::uint8_t* first, const SearchRange& range) {
  const std::uint8_t* above = first - steps.side;
  const std::uint8_t* below = first + steps.side;
  const auto pair = [&](std::int32_t position) {
    return std::int32_t{above[position * steps.step]} + std::int32_t{below[position * steps.step]};
  };
  std::int32_t sum = 0;
  for (std::int32_t i = 1; i <= steps.taps; ++i) {
    sum += pair(i) - pair(-i);
  }
  std::int32_t here = pair(0);
  EdgePeak peak;
  std::int32_t best = range.threshold - 1;
  std::int32_t declining = 0;
  for (std::int32_t i = 0; i < range.steps; ++i) {
    if (sum > best) {
      best = sum;
      peak = {true, i, sum};
      declining = 0;
    } else if (peak.found && ++declining >= kDecliningSteps) {
      break;
    }
    // From position x to x + 1: x + taps + 1 enters ahead, x + 1 leaves it, x enters behind and
    // x - taps leaves.
    const std::int32_t next = pair(1);
    sum += pair(steps.taps + 1) - next - here + pair(-steps.taps);
    here = next;
    above += steps.step;
    below += steps.step;
  }
  return peak;
}

}  // namespace

std::int32_t gradient(const EdgePath& path, std::int32_t position, std::int32_t direction,
                      std::int32_t taps) {
  std::int32_t sum = 0;
  for (std::int32_t i = 1; i <= taps; ++i) {
    sum += path.pair(position + direction * i) - path.pair(position - direction * i);
  }
  return sum;
}

EdgePeak find_edge(const EdgePath& path, const SearchRange& range) {
  const std::uint8_t* first = path.origin + range.first * path.step;
  const std::ptrdiff_t step = path.step * range.direction;
  const auto known = [&]<int kStep, int kTaps>() {
    return walk(KnownSteps<kStep, kTaps>{path.side}, first, range);
  };
  const auto along_line = [&]<int kTaps>() {
    switch (step) {
      case 1: return known.template operator()<1, kTaps>();
      case -1: return known.template operator()<-1, kTaps>();
      case 2: return known.template operator()<2, kTaps>();
      case -2: return known.template operator()<-2, kTaps>();
      case 3: return known.template operator()<3, kTaps>();
      case -3: return known.template operator()<-3, kTaps>();
      default: return walk(KnownTaps<kTaps>{path.side, step}, first, range);
    }
  };
  EdgePeak peak;
  switch (range.taps) {
    case kHorizontalTaps: peak = along_line.template operator()<kHorizontalTaps>(); break;
    case kFilletTaps: peak = along_line.template operator()<kFilletTaps>(); break;
    case kVerticalTaps: peak = walk(KnownTaps<kVerticalTaps>{path.side, step}, first, range); break;
    default: peak = walk(AnySteps{path.side, step, range.taps}, first, range); break;
  }
  peak.position = range.first + range.direction * peak.position;
  return peak;
}

namespace {

using OneByOne = std::integral_constant<std::int32_t, 1>;

// Every `stride`-th pair of neighbours of the first `pairs` from `p` on; zero for none. `stride` is
// a number, or 1 as a constant.
template <typename Stride>
std::int32_t brightest_pair(const std::uint8_t* p, std::ptrdiff_t step, std::int32_t pairs,
                            Stride stride) {
  std::int32_t most = 0;
  if constexpr (std::is_same_v<Stride, OneByOne>) {
    // Each pixel is read once.
    std::int32_t before = *p;
    for (std::int32_t i = 0; i < pairs; ++i) {
      p += step;
      const std::int32_t here = *p;
      most = std::max(most, before + here);
      before = here;
    }
  } else {
    for (std::int32_t i = 0; i < pairs; i += stride) {
      most = std::max(most, p[i * step] + p[(i + 1) * step]);
    }
  }
  return most;
}

// `stride` as above.
template <typename Stride>
Edge refine(const EdgePath& path, const EdgePeak& peak, std::int32_t direction,
            const EdgeReach& reach, std::int32_t least_contrast, Stride stride) {
  const std::ptrdiff_t step = path.step * direction;
  const std::uint8_t* p = path.origin + peak.position * path.step;
  const auto at = [p, step](std::int32_t offset) { return std::int32_t{p[offset * step]}; };

  // Levels in halves of a grey value: two pixels each.
  const std::int32_t dark2 = at(-reach.dark) + at(-reach.dark - 1);
  const std::int32_t bright2 = brightest_pair(p + step, step, reach.bright, stride);
  const std::int32_t contrast2 = bright2 - dark2;
  if (contrast2 < 2 * least_contrast) {
    return {};
  }
  const std::int32_t middle4 = dark2 + bright2;
  const std::int32_t least = (middle4 + 3) / 4;  // the first level that is not below the middle
  std::int32_t offset = -reach.dark;
  if (at(offset) >= least) {
    return {};  // bright where the inside of the tube should be
  }
  while (at(offset + stride) < least) {
    offset += stride;
    if (offset > reach.bright + 1) {
      return {};
    }
  }
  // Within this stride: the first two neighbours that the middle lies between.
  while (at(offset + 1) < least) {
    ++offset;
  }
  const std::int32_t before = 4 * at(offset);
  const std::int32_t here = 4 * at(offset + 1);
  const std::int32_t share_q16 = ((middle4 - before) * 65536) / (here - before);
  const std::int32_t along_q16 = (offset * 65536) + share_q16;
  return {true, peak.position * 65536 + direction * along_q16, contrast2 / 2};
}

}  // namespace

Edge refine_edge(const EdgePath& path, const EdgePeak& peak, std::int32_t direction,
                 const EdgeReach& reach, std::int32_t least_contrast) {
  return refine(path, peak, direction, reach, least_contrast, OneByOne{});
}

Edge refine_edge_coarsely(const EdgePath& path, const EdgePeak& peak, std::int32_t direction,
                          const EdgeReach& reach, std::int32_t stride,
                          std::int32_t least_contrast) {
  return refine(path, peak, direction, reach, least_contrast, stride);
}

Edge weigh_edge(const EdgePath& path, const EdgePeak& peak, std::int32_t direction,
                std::int32_t least_contrast) {
  const std::ptrdiff_t step = path.step * direction;
  const std::uint8_t* p = path.origin + peak.position * path.step;
  const auto at = [p, step](std::int32_t offset) { return std::int32_t{p[offset * step]}; };
  const std::int32_t dark2 = at(-2) + at(-3);
  const std::int32_t bright2 = std::max(at(1) + at(2), at(2) + at(3));
  const std::int32_t contrast2 = bright2 - dark2;
  if (contrast2 < 2 * least_contrast || 4 * at(-2) >= dark2 + bright2) {
    return {};
  }
  // Each line counts as dark by the share that it lacks to the bright level.
  std::int32_t lacking2 = 0;
  for (std::int32_t offset = -1; offset <= 1; ++offset) {
    lacking2 += std::clamp(bright2 - 2 * at(offset), 0, contrast2);
  }
  const std::int32_t along_q16 = (lacking2 * 65536) / contrast2 - 3 * 32768;
  return {true, peak.position * 65536 + direction * along_q16, contrast2 / 2};
}

}  // namespace tubesight::core::edges
