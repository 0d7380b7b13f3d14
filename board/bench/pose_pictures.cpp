#include "board/bench/pose_pictures.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <utility>

#include "core/pose/rest_check.h"

namespace tubesight::board {
namespace {

std::string in_pixels(double px) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f px", px);
  return text.data();
}

}  // namespace

StillAverager::StillAverager(const core::CameraSettings& camera)
    : camera_(camera),
      sums_(static_cast<std::size_t>(camera.width_px) *
            static_cast<std::size_t>(camera.height_px)) {}

StillsRead StillAverager::read(std::span<const std::string> images) {
  StillsRead result;
  core::pose::RestAverage average(sums_, camera_.width_px, camera_.height_px);
  for (const std::string& image : images) {
    if (!add(image, average, result)) {
      return result;
    }
  }
  const core::pose::RestOutcome rest = average.finish();
  result.frame_shift_px = rest.frame_shift_px;
  result.field_shift_px = rest.field_shift_px;
  result.picture = rest.picture;
  if (!rest.rested) {
    const bool fields = rest.field_shift_px > core::pose::kLargestFieldShift_px;
    result.status = ExitStatus::kJobFailed;
    result.message = images.front() + ": the camera moved: the picture shifts by " +
                     in_pixels(fields ? rest.field_shift_px : rest.frame_shift_px) + " between " +
                     (fields ? "the two fields of a frame" : "the pictures") +
                     ", expected a camera at rest";
  }
  return result;
}

bool StillAverager::add(const std::string& image, core::pose::RestAverage& average,
                        StillsRead& result) {
  const auto fail = [&](std::string message) {
    result.status = ExitStatus::kWrongInput;
    result.message = std::move(message);
    return false;
  };
  std::string message;
  if (!drivers::read_grey_picture(image, still_, message)) {
    return fail(std::move(message));
  }
  if (still_.width_px != camera_.width_px || still_.height_px != camera_.height_px) {
    return fail(image + ": " + std::to_string(still_.width_px) + " x " +
                std::to_string(still_.height_px) + " pixels, expected " +
                std::to_string(camera_.width_px) + " x " + std::to_string(camera_.height_px) +
                " as [camera] of the settings says");
  }
  const bool whole = camera_.scan == core::Scan::kProgressive;
  for (const core::Parity parity : {core::Parity::kEven, core::Parity::kOdd}) {
    const core::Parity lines = whole ? core::Parity::kProgressive : parity;
    if ((!whole || parity == core::Parity::kEven) &&
        !average.add(core::field_of(still_.view(), lines))) {
      return fail(image + ": more than " + std::to_string(core::pose::kMaxAveragedFrames) +
                  " pictures, expected at most that many with --average");
    }
  }
  return true;
}

}  // namespace tubesight::board
