#include "board/bench/calibrate/camera_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/honest_text.h"
#include "core/calibration/picture_cover.h"
#include "core/math/covariance.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_text.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

using core::calibration::CalibrationData;
using core::calibration::CalibrationOutcome;
using core::calibration::CalibrationRefusal;
using core::calibration::CalibrationState;
using core::calibration::Verdict;
using core::math::correlation_of;
using core::math::sigma_of;

constexpr int kNames = 20;  // letters of the column that says what a line is about
constexpr std::string_view kUseOfType =
    "tracking and position correction only, of any camera of this type, once a docking has told "
    "EFL";

struct Parameter {
  const char* name;
  const char* unit;
  int digits;
};
constexpr std::array<Parameter, 6> kParameters = {{{"EFL", " mm", 5},
                                                   {"h_sx", "", 6},
                                                   {"c_u", " px", 3},
                                                   {"c_v", " px", 3},
                                                   {"k", " per mm2", 6},
                                                   {"k2", " per mm4", 7}}};

/// The largest correlation of two parameters.
std::string largest_correlation(const core::math::Matrix6d& covariance) {
  int first = 0;
  int second = 1;
  for (int i = 0; i < 6; ++i) {
    for (int k = i + 1; k < 6; ++k) {
      if (std::abs(correlation_of(covariance, i, k)) >
          std::abs(correlation_of(covariance, first, second))) {
        first = i;
        second = k;
      }
    }
  }
  return correlation_text(correlation_of(covariance, first, second),
                          kParameters[static_cast<std::size_t>(first)].name,
                          kParameters[static_cast<std::size_t>(second)].name, kNames);
}

/// What the camera or the template has beside the model, and what one view leaves open.
void append_misfits(std::string& text, const CalibrationData& data, const CalibrationState& state,
                    const CalibrationOutcome& outcome) {
  if (outcome.patterned) {
    drivers::print(
        text,
        "                       they hang together: %.3f px RMS of a pattern, %.1f times "
        "what noise leaves\n",
        outcome.pattern.rms_px, outcome.pattern.ratio);
  }
  constexpr double kWorthTelling = 0.2;  // of the picture
  const auto part =
      core::calibration::uncovered_part(data, state.camera, outcome.fit.camera_covariance);
  if (part.share > kWorthTelling) {
    drivers::print(text,
                   "  without a dot        %.0f %% of the picture, around (%.0f, %.0f): the model "
                   "alone tells the map there, to %.3f px RMS\n",
                   100.0 * part.share, part.u_px, part.v_px, part.rms_px);
  }
  if (outcome.assumed) {
    drivers::print(
        text,
        "  not known            c_u, c_v, h_sx: one view does not tell them; taken as %.1f, "
        "%.1f px and %.2f, their doubt is in the above\n",
        state.camera(2), state.camera(3), state.camera(1));
  }
  if (outcome.freed.stage_axis) {
    const double tip =
        std::acos(std::clamp(state.stage_axis.dot(state.stage.R_camera_target.col(2)), -1.0, 1.0));
    drivers::print(text, "  stage                stands %.3f deg off the template's normal\n",
                   tip * 57.29577951308232);
  }
  if (outcome.unseen_lens > 0.0) {
    drivers::print(
        text,
        "  lens                 two heights alone do not show one that moved between "
        "them: %.3f mm of EFL for each 0.1 %% that it changed; a third view, back at the "
        "first height, would\n",
        0.001 * outcome.unseen_lens * state.camera(0));
  }
  if (outcome.freed.bow) {
    drivers::print(
        text,
        "  template             is not flat: its edges stand %.3f mm (along) and %.3f mm "
        "(across) off its middle, its corners %.3f mm twisted\n",
        state.bow_mm(0), state.bow_mm(2), state.bow_mm(1));
  }
  if (outcome.tangential.map.rms_px > 0.0) {
    drivers::print(
        text,
        "  lens                 %s tangential distortion, p1 %.6f, p2 %.6f per mm, which "
        "the settings cannot hold: map off by %.3f px RMS, %.3f px at worst\n",
        outcome.tangential.rival ? "may, in place of the stage, have" : "has",
        outcome.tangential.p.x(), outcome.tangential.p.y(), outcome.tangential.map.rms_px,
        outcome.tangential.map.worst_px);
  }
}

}  // namespace

core::CameraSettings calibrated(const core::CameraSettings& known,
                                const core::calibration::CameraValues& values) {
  core::CameraSettings camera = known;
  camera.focal_length_mm = values(0);
  camera.horizontal_scale = values(1);
  camera.center_px = {values(2), values(3)};
  camera.distortion_per_mm2 = values(4);
  camera.distortion2_per_mm4 = values(5);
  return camera;
}

core::calibration::CameraValues values_of(const core::CameraSettings& camera) {
  core::calibration::CameraValues values;
  values << camera.focal_length_mm, camera.horizontal_scale, camera.center_px[0],
      camera.center_px[1], camera.distortion_per_mm2, camera.distortion2_per_mm4;
  return values;
}

std::string_view use_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kBase: return "base calibration, pose and tracking";
    case Verdict::kPose: return "pose and tracking; not base calibration";
    case Verdict::kTracking: return "tracking and position correction only";
  }
  return "";
}

std::string_view explain(CalibrationRefusal refusal) {
  switch (refusal) {
    case CalibrationRefusal::kNone: return "";
    case CalibrationRefusal::kOneView:
      return "one view leaves EFL and distance open, or centre and scale where it is tilted; "
             "expected two heights of a stage or several tilted poses";
    case CalibrationRefusal::kEqualHeights:
      return "all height_mm are equal, expected heights that differ";
    case CalibrationRefusal::kNoStart:
      return "EFL or a distance comes out negative: heights swapped or in other units, or dots in "
             "another order than the template's; expected a larger height_mm where the dots look "
             "smaller";
    case CalibrationRefusal::kNoFit:
      return "the fit does not come to rest: the views contradict each other";
    case CalibrationRefusal::kUndetermined:
      return "the views don't determine the camera, whatever their residuals: parallel planes "
             "without known heights or like poses; expected known heights, or poses tilted by 20 "
             "to "
             "40 degrees to different sides";
    case CalibrationRefusal::kTooUncertain:
      return "the map from pixels to rays is known to worse than 1 px over the picture: more "
             "views, "
             "tilted to different sides and filling the picture";
    case CalibrationRefusal::kPoorFit:
      return "the dots are not where this camera would show such a template (more than 1 px RMS): "
             "wrong spacing or heights, a bowed template, a lens moved between views";
    case CalibrationRefusal::kPattern:
      return "the dots' errors hang together and are no noise: a bowed or wrongly printed "
             "template, "
             "heights misread, a lens or a template that moved between views";
    case CalibrationRefusal::kOtherLens:
      return "EFL is not that of lens_mm to a fifth, or the picture would reach over 60 degrees "
             "off "
             "the axis: heights and spacing in different units, or another lens";
    case CalibrationRefusal::kManyOutliers:
      return "more than a tenth of the dots lie off: another template, or dots hidden";
  }
  return "";
}

std::string camera_text(const CalibrationData& data, const CalibrationState& state,
                        const CalibrationOutcome& outcome, std::string_view more,
                        std::string_view next, bool type) {
  std::string text;
  drivers::print(text, "camera from %d view%s, %d dots", data.views.size(),
                 data.views.size() == 1 ? "" : "s", outcome.fit.dots);
  if (outcome.left_out > 0) {
    drivers::print(text, " (%d that lie off are left out)", outcome.left_out);
  }
  text += '\n';
  for (int i = 0; i < 6; ++i) {
    const Parameter& parameter = kParameters[static_cast<std::size_t>(i)];
    const double sigma = sigma_of(outcome.fit.camera_covariance, i);
    if (sigma > 0.0) {
      drivers::print(text, "  %-*s %.*f +- %.*f%s\n", kNames, parameter.name, parameter.digits,
                     state.camera(i), parameter.digits, sigma, parameter.unit);
    }
  }
  text += largest_correlation(outcome.fit.camera_covariance);
  drivers::print(text,
                 "  residuals            %.4f px RMS of a dot, %.4f px sigma of a coordinate\n",
                 outcome.fit.rms_px, outcome.fit.sigma_px);
  append_misfits(text, data, state, outcome);
  text += map_text(outcome.map, kNames);
  text += more;
  if (outcome.refusal == CalibrationRefusal::kNone) {
    text += use_text(type ? kUseOfType : use_of(outcome.verdict), kNames);
  }
  text += next;
  return text;
}

std::string camera_settings_text(const core::CameraSettings& camera,
                                 const CalibrationOutcome& outcome,
                                 const drivers::CalibrationQuality& device, bool type) {
  drivers::TomlWriter toml(drivers::TomlManner::kPlain);
  drivers::write_camera(toml, camera);
  return with_quality(toml.take(),
                      {"camera_quality", outcome.fit.camera_covariance,
                       type ? kUseOfType : use_of(outcome.verdict), device.serial, device.model});
}

}  // namespace tubesight::board
