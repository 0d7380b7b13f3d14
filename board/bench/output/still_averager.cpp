#include "board/bench/output/still_averager.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <utility>

#include "board/bench/input/recording_input.h"
#include "core/picture/rest_check.h"
#include "drivers/replay/scan_flag.h"

namespace tubesight::board {
namespace {

std::string in_pixels(double px) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f px", px);
  return text.data();
}

}  // namespace

StillAverager::StillAverager(const core::CameraSettings& camera, bool ignore_scan_flag)
    : camera_(camera),
      ignore_scan_flag_(ignore_scan_flag),
      sums_(static_cast<std::size_t>(camera.width_px) *
            static_cast<std::size_t>(camera.height_px)) {}

StillsRead StillAverager::read(std::span<const Still> stills) {
  StillsRead result;
  core::picture::RestAverage average(sums_, camera_.width_px, camera_.height_px);
  for (const Still& still : stills) {
    if (!add(still, average, result)) {
      return result;
    }
  }
  const core::picture::RestOutcome rest = average.finish();
  result.frame_shift_px = rest.frame_shift_px;
  result.field_shift_px = rest.field_shift_px;
  result.picture = rest.picture;
  if (!rest.rested) {
    const bool fields = rest.field_shift_px > core::picture::kLargestFieldShift_px;
    result.status = ExitStatus::kJobFailed;
    result.message = stills.front().name() + ": the camera moved: the picture shifts by " +
                     in_pixels(fields ? rest.field_shift_px : rest.frame_shift_px) + " between " +
                     (fields ? "the two fields of a frame" : "the pictures") +
                     ", expected a camera at rest";
  }
  return result;
}

bool StillAverager::add(const Still& still, core::picture::RestAverage& average,
                        StillsRead& result) {
  const auto fail = [&](std::string message) {
    result.status = ExitStatus::kWrongInput;
    result.message = std::move(message);
    return false;
  };
  std::string message;
  if (!reader_.read(still, picture_, message)) {
    return fail(std::move(message));
  }
  if (picture_.width_px != camera_.width_px || picture_.height_px != camera_.height_px) {
    return fail(still.file + ": " + std::to_string(picture_.width_px) + " x " +
                std::to_string(picture_.height_px) + " pixels, expected " +
                std::to_string(camera_.width_px) + " x " + std::to_string(camera_.height_px) +
                " as [camera] of the settings says");
  }
  if (const std::string why = drivers::why_other_scan(reader_.interlacing(), camera_.scan);
      !why.empty() && !ignore_scan_flag_) {
    return fail(still.file + ": " + why + std::string(kScanFlagWayOut));
  }
  const bool whole = camera_.scan == core::Scan::kProgressive;
  for (const core::Parity parity : {core::Parity::kEven, core::Parity::kOdd}) {
    const core::Parity lines = whole ? core::Parity::kProgressive : parity;
    if ((!whole || parity == core::Parity::kEven) &&
        !average.add(core::field_of(picture_.view(), lines))) {
      return fail(still.name() + ": more than " +
                  std::to_string(core::picture::kMaxAveragedFrames) +
                  " pictures, expected at most that many with --average");
    }
  }
  return true;
}

}  // namespace tubesight::board
