#include "board/bench/calibrate/camera_views.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "board/bench/calibrate/points_file.h"
#include "board/bench/output/progress_line.h"
#include "core/calibration/dot_sharpness.h"
#include "core/picture/averaged_picture.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::calibration::CalibrationData;
using core::calibration::CalibrationView;
using core::calibration::DotFault;
using core::calibration::DotSharpness;
using core::calibration::OrderRefusal;
using core::calibration::Target;
using core::calibration::TargetLattice;

Target target_of(const drivers::TargetSettings& settings) {
  Target target;
  target.rows = settings.rows;
  target.columns = settings.columns;
  target.lattice = settings.lattice == drivers::DotLattice::kStaggered ? TargetLattice::kStaggered
                                                                       : TargetLattice::kSquare;
  target.spacing_mm = settings.spacing_mm;
  target.row_spacing_mm = settings.row_spacing_mm;
  target.dot_mm = settings.dot_mm;
  target.bright = settings.bright;
  return target;
}

/// What was found in place of the template.
std::string why_no_template(OrderRefusal refusal, const core::detection::FoundLattice& found,
                            const Target& target) {
  std::string text = "no template: ";
  if (refusal == OrderRefusal::kColour) {
    return text + (found.dark ? "dark dots on bright" : "bright dots on dark") +
           ", expected dots = \"" + (found.dark ? "dark" : "bright") + "\" of such a template";
  }
  if (refusal == OrderRefusal::kForm) {
    drivers::print(text,
                   "dots that stand %.2f and %.2f diameters apart, expected what spacing_mm, "
                   "row_spacing_mm and dot_mm of the target say",
                   found.steps.column.norm() / 2.0, found.steps.row.norm() / 2.0);
    return text;
  }
  std::int32_t rows = 0;
  std::int32_t columns = 0;
  for (const auto& element : found.elements) {
    rows = std::max(rows, element.row + 1);
    columns = std::max(columns, element.column + 1);
  }
  drivers::print(text,
                 "%d dots in %d rows and %d columns, expected %d lines of %d, all of which show",
                 found.elements.size(), rows, columns, target.rows, target.columns);
  return text;
}

/// Why dots found are not measured from; empty: they may be.
std::string why_not_sharp(const DotSharpness& sharpness) {
  std::string text;
  switch (core::calibration::fault_of(sharpness)) {
    case DotFault::kNone: break;
    case DotFault::kSaturated:
      drivers::print(text,
                     "the light is cut off: at %d of %d dots the sensor is at the top of its grey "
                     "levels, expected less light or a shorter exposure",
                     sharpness.saturated, sharpness.dots);
      break;
    case DotFault::kSmeared:
      drivers::print(
          text,
          "the dots are smeared by %.1f px along %.0f deg from the rows, expected camera "
          "and template at rest",
          sharpness.smeared_px, sharpness.smeared_deg);
      break;
    case DotFault::kBlurred:
      drivers::print(text,
                     "the dots are out of focus: their edges are %.1f px wide at radii of %.1f px, "
                     "expected at most half of that",
                     sharpness.width_px, sharpness.radius_px);
      break;
  }
  return text;
}

}  // namespace

CameraViews::CameraViews(const drivers::TargetFile& file, bool ignore_scan_flag)
    : file_(file),
      target_(target_of(file.target)),
      averager_(file.camera, ignore_scan_flag),
      scratch_(static_cast<std::size_t>(file.camera.width_px) *
               static_cast<std::size_t>(file.camera.height_px)) {}

ExitStatus CameraViews::fail(ExitStatus status, std::string message) {
  message_ = std::move(message);
  return status;
}

ExitStatus CameraViews::read(CalibrationData& data) {
  data.sensor = core::calibration::sensor_of(file_.camera);
  data.lens_mm = file_.target.lens_mm;
  data.dot_radius_mm = 0.5 * target_.dot_mm;
  data.dots.clear();
  data.views.clear();
  ProgressLine progress;
  for (const drivers::ViewSettings& view : file_.views) {
    progress.update(
        ProgressLine::Clock::now(),
        "view " + std::to_string(data.views.size() + 1) + " of " +
            std::to_string(file_.views.size()),
        static_cast<double>(data.views.size()) / static_cast<double>(file_.views.size()));
    CalibrationView next;
    next.first = data.dots.size();
    next.staged = view.staged;
    next.height_mm = view.height_mm;
    const ExitStatus status =
        view.points.empty() ? read_images(view, data) : read_points(view, data);
    if (status != ExitStatus::kDone) {
      return status;
    }
    next.count = data.dots.size() - next.first;
    if (!data.views.try_push_back(next)) {
      return fail(ExitStatus::kWrongInput, "view: more than " +
                                               std::to_string(core::calibration::kMaxViews) +
                                               " views, expected at most that many");
    }
  }
  return ExitStatus::kDone;
}

ExitStatus CameraViews::read_images(const drivers::ViewSettings& view, CalibrationData& data) {
  const StillsRead read = averager_.read(stills_of(view.images, {}));
  if (read.status != ExitStatus::kDone) {
    return fail(read.status, read.message);
  }
  const std::string& name = view.images.front();
  if (!(target_.dot_mm > 0.0)) {
    return fail(ExitStatus::kWrongInput,
                name + ": target.dot_mm is 0, expected a diameter where dots are to be found");
  }
  thumbs_.push_back(make_thumb(name, read.picture));
  const auto refusal = finder_->find(read.picture, {}, scratch_, *found_);
  if (refusal != core::detection::FinderRefusal::kNone) {
    return fail(ExitStatus::kJobFailed, name + ": no template: no lattice of dots is found");
  }
  const OrderRefusal order = core::calibration::order_on_target(*found_, target_, data.dots);
  if (order != OrderRefusal::kNone) {
    return fail(ExitStatus::kJobFailed, name + ": " + why_no_template(order, *found_, target_));
  }
  const DotSharpness sharpness = core::calibration::dot_sharpness(read.picture, *found_);
  if (std::string why = why_not_sharp(sharpness); !why.empty()) {
    return fail(ExitStatus::kJobFailed, name + ": " + why);
  }
  if (sharpness.ground_saturated > 0) {
    drivers::print(notes_,
                   "%s: around %d of %d dots the light is cut off: they come out smaller, expected "
                   "less light\n",
                   name.c_str(), sharpness.ground_saturated, sharpness.dots);
  }
  return ExitStatus::kDone;
}

ExitStatus CameraViews::read_points(const drivers::ViewSettings& view, CalibrationData& data) {
  std::string wrong = board::read_points(view.points, data.dots);
  if (!wrong.empty()) {
    return fail(ExitStatus::kWrongInput, std::move(wrong));
  }
  thumbs_.push_back({view.points, 0, 0, {}});
  return ExitStatus::kDone;
}

}  // namespace tubesight::board
