#include "core/calibration/halves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/calibration/lens_misfit.h"

namespace tubesight::core::calibration {
namespace {

/// Which half a view belongs to.
enum class Part : std::uint8_t { kFirst, kSecond };

using ViewParts = std::array<Part, kMaxViews>;

struct Half {
  CameraValues camera = CameraValues::Zero();
  MapUncertainty map;
};

/// Fewer of a kind say nothing of themselves alone.
constexpr std::int32_t kLeastFree = 3;
constexpr std::int32_t kLeastHeights = 2;
// A half's own EFL within this share; beyond it the fit ran along a valley.
constexpr double kMostOfFocal = 0.05;

/// Divides the views; false where a half would not determine a camera.
bool divide_views(const CalibrationData& data, ViewParts& parts) {
  const auto staged = static_cast<std::int32_t>(
      std::count_if(data.views.begin(), data.views.end(),
                    [](const CalibrationView& view) { return view.staged; }));
  const std::int32_t free = data.views.size() - staged;
  const bool by_kind = staged >= kLeastHeights && free >= kLeastFree;
  const bool alternate = staged == 0 ? free >= 2 * kLeastFree
                         : free == 0 ? staged >= 2 * kLeastHeights
                                     : false;
  for (std::int32_t i = 0; i < data.views.size(); ++i) {
    const bool first = by_kind ? data.views[i].staged : i % 2 == 0;
    parts[static_cast<std::size_t>(i)] = first ? Part::kFirst : Part::kSecond;
  }
  return by_kind || alternate;
}

/// The side of the template's middle that a dot stands on, across its longer side: each half then
/// spans the other one whole.
class Sides {
 public:
  explicit Sides(const CalibrationData& data) {
    Eigen::Vector2d least = Eigen::Vector2d::Constant(HUGE_VAL);
    Eigen::Vector2d most = -least;
    for (const SeenDot& dot : data.dots) {
      least = least.cwiseMin(dot.place_mm.head<2>());
      most = most.cwiseMax(dot.place_mm.head<2>());
    }
    axis_ = (most - least).x() >= (most - least).y() ? 0 : 1;
    middle_mm_ = 0.5 * (least + most)(axis_);
  }
  [[nodiscard]] bool first(const SeenDot& dot) const { return dot.place_mm(axis_) < middle_mm_; }

 private:
  Eigen::Index axis_ = 0;
  double middle_mm_ = 0.0;
};

/// Copies what belongs to one half.
bool take_half(const CalibrationData& from, const CalibrationState& state, HalvesSplit split,
               bool first, HalvesScratch& scratch) {
  CalibrationData& half = scratch.data;
  half.sensor = from.sensor;
  half.dot_radius_mm = from.dot_radius_mm;
  half.dots.clear();
  half.views.clear();
  scratch.state = state;
  scratch.state.poses.clear();
  ViewParts parts{};
  if (split == HalvesSplit::kViews && !divide_views(from, parts)) {
    return false;
  }
  const Sides sides(from);
  for (std::int32_t v = 0; v < from.views.size(); ++v) {
    if (split == HalvesSplit::kViews &&
        (parts[static_cast<std::size_t>(v)] == Part::kFirst) != first) {
      continue;
    }
    CalibrationView view = from.views[v];
    view.first = half.dots.size();
    for (std::int32_t i = 0; i < from.views[v].count; ++i) {
      SeenDot dot = from.dots[from.views[v].first + i];
      const bool of_first = split == HalvesSplit::kDots     ? i % 2 == 0
                            : split == HalvesSplit::kPlaces ? sides.first(dot)
                                                            : first;
      // The other half's dots stay, unused: a bow is counted from the middle of them all.
      dot.used = dot.used && of_first == first;
      static_cast<void>(half.dots.try_push_back(dot));
    }
    view.count = half.dots.size() - view.first;
    static_cast<void>(half.views.try_push_back(view));
    static_cast<void>(scratch.state.poses.try_push_back(state.poses[v]));
  }
  return true;
}

/// Calibrates one half; false where it does not tell the camera.
bool fit_half(const CalibrationData& data, const CalibrationState& state, const FitOptions& freed,
              HalvesSplit split, bool first, HalvesScratch& scratch, Half& half) {
  if (!take_half(data, state, split, first, scratch)) {
    return false;
  }
  const FitOutcome fit = fit_camera(freed, scratch.data, scratch.state, scratch.fit);
  half.camera = scratch.state.camera;
  if (!fit.converged || !fit.determined || !(half.camera(0) > 0.0) ||
      !(std::sqrt(fit.camera_covariance(0, 0)) < kMostOfFocal * half.camera(0))) {
    return false;
  }
  half.map = map_uncertainty(data.sensor, half.camera, fit.camera_covariance);
  return std::isfinite(half.map.rms_px) && half.map.rms_px > 0.0;
}

}  // namespace

HalvesOutcome compare_halves(const CalibrationData& data, const CalibrationState& state,
                             const FitOptions& freed, HalvesScratch& scratch) {
  HalvesOutcome worst;
  FitOptions options = freed;
  options.tangential = false;  // the camera is the best one without it
  for (const HalvesSplit split : {HalvesSplit::kDots, HalvesSplit::kPlaces, HalvesSplit::kViews}) {
    Half first;
    Half second;
    if (!fit_half(data, state, options, split, true, scratch, first) ||
        !fit_half(data, state, options, split, false, scratch, second)) {
      continue;
    }
    HalvesOutcome outcome;
    outcome.told = true;
    outcome.split = split;
    outcome.off_px =
        map_difference(data.sensor, first.camera, second.camera, {0.0, 0.0}, MapGauge::kNone)
            .rms_px;
    outcome.promised_px = std::hypot(first.map.rms_px, second.map.rms_px);
    if (!worst.told || outcome.sigmas() > worst.sigmas()) {
      worst = outcome;
    }
  }
  return worst;
}

Verdict lowered_by(const HalvesOutcome& halves, Verdict verdict, double map_rms_px) {
  if (!halves.told || halves.sigmas() <= kMostHalvesSigmas) {
    return verdict;
  }
  const Verdict grown = verdict_for(map_rms_px * halves.sigmas());
  const Verdict next = verdict == Verdict::kBase ? Verdict::kPose : Verdict::kTracking;
  return std::max(grown, next);
}

}  // namespace tubesight::core::calibration
