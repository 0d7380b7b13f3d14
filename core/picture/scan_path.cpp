#include "core/picture/scan_path.h"

#include <algorithm>

namespace tubesight::core::picture {
namespace {

// The rise has passed its peak when the gradient did not grow for so many steps.
constexpr std::int32_t kDecliningSteps = 3;

// How far behind and ahead of the peak the levels of dark and bright are read.
constexpr std::int32_t kDarkReach = 5;
constexpr std::int32_t kBrightReach = 5;

std::int32_t gradient(const ScanPath& path, std::int32_t position) {
  std::int32_t sum = 0;
  for (std::int32_t i = 1; i <= kScanTaps; ++i) {
    sum += path.pair(position + i) - path.pair(position - i);
  }
  return sum / kGreyScale;
}

ScanEdge refine(const ScanPath& path, std::int32_t peak, std::int32_t gradient_at_peak) {
  if (peak - kDarkReach - 1 < -path.before || peak + kBrightReach + 1 > path.after) {
    return {};
  }
  const std::int32_t dark2 = path.grey(peak - kDarkReach) + path.grey(peak - kDarkReach - 1);
  std::int32_t bright2 = 0;
  for (std::int32_t i = 0; i <= kBrightReach; ++i) {
    bright2 = std::max(bright2, path.grey(peak + i) + path.grey(peak + i + 1));
  }
  const double middle = (dark2 + bright2) / 4.0;
  for (std::int32_t i = -kDarkReach; i <= kBrightReach; ++i) {
    const double here = path.grey(peak + i);
    const double next = path.grey(peak + i + 1);
    if (here < middle && next >= middle) {
      return {true, peak + i + (middle - here) / (next - here), gradient_at_peak};
    }
  }
  return {};
}

}  // namespace

ScanPath scan_path(const AveragedPicture& picture, std::int32_t u, std::int32_t v, bool horizontal,
                   std::int32_t direction) {
  ScanPath path;
  path.origin = picture.line(v) + u;
  path.step = horizontal ? direction : direction * static_cast<std::ptrdiff_t>(picture.width_px);
  path.side = 2 * (horizontal ? static_cast<std::ptrdiff_t>(picture.width_px) : 1);
  const std::int32_t place = horizontal ? u : v;
  const std::int32_t size = horizontal ? picture.width_px : picture.height_px;
  path.before = direction > 0 ? place : size - 1 - place;
  path.after = direction > 0 ? size - 1 - place : place;
  return path;
}

ScanEdge find_scan_edge(const ScanPath& path, std::int32_t first, std::int32_t reach,
                        std::int32_t threshold) {
  first = std::max(first, kScanTaps - path.before);
  const std::int32_t last = std::min(first + reach, path.after - kScanTaps);
  std::int32_t best = threshold - 1;
  std::int32_t peak = 0;
  std::int32_t declining = 0;
  bool found = false;
  for (std::int32_t i = first; i <= last; ++i) {
    const std::int32_t here = gradient(path, i);
    if (here > best) {
      best = here;
      peak = i;
      found = true;
      declining = 0;
    } else if (found && ++declining >= kDecliningSteps) {
      break;
    }
  }
  return found ? refine(path, peak, best) : ScanEdge{};
}

}  // namespace tubesight::core::picture
