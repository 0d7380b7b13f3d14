#include "board/bench/pose/frame_gaps.h"

#include <chrono>

#include "board/bench/input/recording_input.h"
#include "core/base/field.h"
#include "core/tubesheet/tubesheet_setup.h"
#include "drivers/replay/replay_frame_grabber.h"

namespace tubesight::board {
namespace {

/// Of the distance between neighbouring tubes: pictures at rest agree to a pixel, some 0.3 mm.
constexpr double kShareOfStep = 0.8;

FrameGaps wrong(const drivers::Messages& messages) {
  FrameGaps gaps{ExitStatus::kWrongInput, {}};
  for (const std::string& message : messages) {
    gaps.message += (gaps.message.empty() ? "" : "\n") + message;
  }
  return gaps;
}

}  // namespace

FrameGaps find_frame_gaps(const core::SessionSettings& settings, const std::string& recording,
                          std::int64_t first, std::int64_t last, bool ignore_scan_flag) {
  drivers::ReplayFrameGrabber grabber(settings.camera, recording);
  std::string unread;
  drivers::Messages messages;
  if (!feed(grabber, recording, ignore_scan_flag, unread) || !start(grabber, messages)) {
    return wrong(unread.empty() ? messages : drivers::Messages{unread});
  }
  const auto lattice = core::tubesheet::make_lattice<double>(settings.tubesheet);
  if (!lattice) {
    return wrong({recording + ": the steps of [tubesheet] make no lattice"});
  }
  const double longest_s =
      kShareOfStep * lattice->parameters().shortest_step / settings.motion.max_speed_mm_s;
  const std::int64_t last_field = 2 * last + (grabber.interlaced() ? 1 : 0);
  core::Field before;
  std::int64_t taken = 0;
  std::int64_t usual_numbers = 0;  // by which the sequence grows from field to field
  while (grabber.field_number() < last_field) {
    const auto lease = grabber.grab_for(std::chrono::milliseconds(0));
    if (!lease) {
      return wrong(grabber.messages());
    }
    if (grabber.field_number() < 2 * first) {
      continue;
    }
    const core::Field& field = lease->field();
    const auto refused = [&](const char* why) {
      return FrameGaps{ExitStatus::kJobFailed,
                       "field " + std::to_string(grabber.field_number()) + why};
    };
    constexpr const char* kNotAfter =
        " is not after the field before it, expected frames one after the other for --average";
    constexpr const char* kTooLate =
        " comes so long after the field before it that the tool can have moved on, expected frames "
        "one after the other for --average";
    if (field.status != core::FieldStatus::kGood) {
      return refused(" is damaged or missing, expected good fields");
    }
    if (taken > 0) {
      const std::chrono::duration<double> span = field.mid_exposure - before.mid_exposure;
      const std::int64_t numbers = field.sequence - before.sequence;
      usual_numbers = taken == 1 ? numbers : usual_numbers;
      if (span.count() <= 0.0 || numbers <= 0) {
        return refused(kNotAfter);
      }
      if (span.count() > longest_s || numbers != usual_numbers) {
        return refused(kTooLate);
      }
    }
    before = field;
    ++taken;
  }
  return {};
}

}  // namespace tubesight::board
