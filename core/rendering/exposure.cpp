#include "core/rendering/exposure.h"

#include <algorithm>
#include <cmath>

namespace tubesight::core::rendering {

double pulsed_light(double duty, double period_s, double opened_s, double closed_s) {
  const double on = std::clamp(duty, 0.0, 1.0);
  if (!(closed_s > opened_s) || !(period_s > 0.0)) {
    return on;
  }
  // Seconds lit since time 0.
  const auto lit_until = [&](double time_s) {
    const double periods = std::floor(time_s / period_s);
    return periods * on * period_s + std::min(time_s - periods * period_s, on * period_s);
  };
  return std::clamp((lit_until(closed_s) - lit_until(opened_s)) / (closed_s - opened_s), 0.0, 1.0);
}

}  // namespace tubesight::core::rendering
