#include "board/bench/calibrate/honest_text.h"

#include <array>
#include <string_view>

#include "core/calibration/tip_uncertainty.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::calibration::HalvesSplit;

std::string_view name_of(HalvesSplit split) {
  switch (split) {
    case HalvesSplit::kDots: return "every second dot";
    case HalvesSplit::kPlaces: return "the template's sides";
    case HalvesSplit::kViews: return "views against views";
  }
  return "";
}

/// What two halves that contradict each other mostly mean.
std::string_view cause_of(HalvesSplit split) {
  switch (split) {
    case HalvesSplit::kDots: return "smeared or saturated dots";
    case HalvesSplit::kPlaces:
      return "a bowed or wrongly printed template, a lens unlike the model";
    case HalvesSplit::kViews: return "a loose lens, wrong heights, a camera that moved";
  }
  return "";
}

std::string_view stand_of(core::calibration::NextView view) {
  using core::calibration::NextView;
  switch (view) {
    case NextView::kUpperNearer: return "tilted by 30 deg, the template's upper edge nearer,";
    case NextView::kLowerNearer: return "tilted by 30 deg, the template's lower edge nearer,";
    case NextView::kLeftNearer: return "tilted by 30 deg, the template's left edge nearer,";
    case NextView::kRightNearer: return "tilted by 30 deg, the template's right edge nearer,";
    case NextView::kSquare: return "square to the template, moved towards the place below,";
  }
  return "";
}

}  // namespace

std::string map_text(const core::calibration::MapUncertainty& map, int width) {
  std::string text;
  drivers::print(text, "  %-*s %.3f px RMS over the picture (one sigma), %.3f px at (%.0f, %.0f)\n",
                 width, "map uncertainty", map.rms_px, map.worst_px, map.worst_u_px,
                 map.worst_v_px);
  return text;
}

std::string use_text(std::string_view use, int width) {
  std::string text;
  drivers::print(text, "  %-*s %.*s\n", width, "good for", static_cast<int>(use.size()),
                 use.data());
  return text;
}

std::string correlation_text(double correlation, std::string_view one, std::string_view other,
                             int width) {
  std::string text;
  drivers::print(text, "  %-*s %.3f, of %.*s and %.*s\n", width, "largest correlation", correlation,
                 static_cast<int>(one.size()), one.data(), static_cast<int>(other.size()),
                 other.data());
  return text;
}

std::string halves_text(const core::calibration::HalvesOutcome& halves) {
  std::string text;
  if (!halves.told) {
    return "  halves               not compared: neither tells the camera alone\n";
  }
  const std::string_view split = name_of(halves.split);
  const bool good = halves.sigmas() <= core::calibration::kMostHalvesSigmas;
  drivers::print(text, "  halves %s        %.1f sigma: maps %.3f px apart, %.3f promised (%.*s)\n",
                 good ? "agree   " : "disagree", halves.sigmas(), halves.off_px, halves.promised_px,
                 static_cast<int>(split.size()), split.data());
  if (!good) {
    const std::string_view cause = cause_of(halves.split);
    drivers::print(text, "    which lowers the verdict: look for %.*s\n",
                   static_cast<int>(cause.size()), cause.data());
  }
  return text;
}

std::string next_text(const core::calibration::NextViewOutcome& next,
                      const core::calibration::MapUncertainty& map) {
  std::string text;
  if (next.told) {
    const std::string_view stand = stand_of(next.view);
    drivers::print(text, "  next                 a view %.*s would bring that to %.3f px RMS\n",
                   static_cast<int>(stand.size()), stand.data(), next.map_rms_px);
  }
  drivers::print(text, "    the map is known least around (%.0f, %.0f): have dots there\n",
                 map.worst_u_px, map.worst_v_px);
  return text;
}

std::string tip_text(const core::calibration::Sensor& sensor,
                     const core::calibration::CameraValues& camera,
                     const core::math::Matrix6d& covariance) {
  constexpr std::array<double, 3> kGaps_mm = {10.0, 40.0, 90.0};
  const core::calibration::TipSituation situation;
  std::string text;
  for (const double gap_mm : kGaps_mm) {
    const auto tip = tip_uncertainty(sensor, camera, covariance, situation, gap_mm);
    if (!tip.told()) {
      continue;
    }
    if (text.empty()) {
      text = "  guidetube's tip      one sigma across and along, by this camera; and in all\n";
    }
    drivers::print(text, "    %2.0f mm below a sheet  %.4f  %.4f mm; %.4f  %.4f mm\n", gap_mm,
                   tip.across_mm, tip.along_mm, tip.all_across_mm, tip.all_along_mm);
  }
  if (!text.empty()) {
    drivers::print(text,
                   "    assumed: sheet square to it, pitch %.1f mm, tube-ends to %.2f px; tip at "
                   "(0, %.0f, %.0f) mm, docked with this camera\n",
                   situation.pitch_mm, situation.tube_px, situation.tip_mm.y(),
                   situation.tip_mm.z());
  }
  return text;
}

}  // namespace tubesight::board
