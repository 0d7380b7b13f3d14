#include "board/bench/pose/still_tubes.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include "board/bench/pose/frame_gaps.h"
#include "core/base/reply.h"
#include "drivers/replay/companion.h"
#include "drivers/settings/session_checks.h"

namespace tubesight::board {
namespace {

TubesFound refused(ExitStatus status, std::string message) {
  TubesFound found;
  found.status = status;
  found.message = std::move(message);
  return found;
}

/// The stills from the first one on that are frames one after the other of one recording.
std::size_t run_length(std::span<const Still> stills) {
  std::size_t length = 1;
  while (length < stills.size() && stills[length].frame > 0 &&
         stills[length].file == stills.front().file &&
         stills[length].frame == stills[length - 1].frame + 1) {
    ++length;
  }
  return length;
}

bool has_meta(const Still& still) {
  std::error_code error;
  return still.frame >= 0 &&
         std::filesystem::exists(drivers::companion_path(still.file, ".meta.csv"), error);
}

}  // namespace

StillTubes::StillTubes(const core::SessionSettings& settings, StillClicks clicks, ColdStart* cold)
    : settings_(settings), clicks_(std::move(clicks)), cold_(cold) {}

TubesFound StillTubes::find(std::span<const Still> stills) {
  TubesFound first;
  for (std::size_t i = 0; i < stills.size();) {
    const std::span<const Still> run = stills.subspan(i, run_length(stills.subspan(i)));
    TubesFound found = find_in(run.front());
    if (found.status != ExitStatus::kDone) {
      return found;
    }
    // A frame that was clicked in must be a good one; a tracked one is.
    if (run.size() > 1 || (was_clicked(run.front()) && has_meta(run.front()))) {
      const FrameGaps gaps = find_frame_gaps(settings_, run.front().file, run.front().frame,
                                             run.back().frame, clicks_.where.ignore_scan_flag);
      if (gaps.status != ExitStatus::kDone) {
        return refused(gaps.status, gaps.status == ExitStatus::kJobFailed
                                        ? run.front().file + ": no pose: " + gaps.message
                                        : gaps.message);
      }
    }
    if (i == 0) {
      first = std::move(found);
    } else if (!agree_on_tubes(first.places, found.places)) {
      return refused(ExitStatus::kJobFailed,
                     run.front().name() + ": no pose: it shows other tubes than " +
                         stills.front().name() + ", expected a camera at rest");
    }
    i += run.size();
  }
  return was_clicked(stills.front()) ? first : choose(stills.front(), std::move(first));
}

TubesFound StillTubes::find_in(const Still& still) {
  TubesFound found;
  if (was_clicked(still)) {
    found.places = clicks_.places;
    return found;
  }
  if (tracked_ == nullptr) {
    tracked_ = std::make_unique<TrackedStart>(settings_, clicks_.places, clicks_.where, cold_);
  }
  TrackedFrame frame = tracked_->find(still.file, still.frame);
  if (frame.status != ExitStatus::kDone) {
    return refused(frame.status, frame.status == ExitStatus::kJobFailed
                                     ? still.name() + ": no pose: " + frame.message
                                     : frame.message);
  }
  found.places = std::move(frame.tubes);
  found.tool = frame.tool;
  return found;
}

TubesFound StillTubes::choose(const Still& still, TubesFound tracked) const {
  PictureStarts& places = tracked.places;
  if (!clicks_.only_start) {
    // As many as a pose request of the robot begins with.
    places.resize(std::min<std::size_t>(places.size(), core::kMaxPoseOrderTubes));
    return tracked;
  }
  PictureStarts named;
  for (const core::pose::PictureStart& click : clicks_.places) {
    const auto at = std::find_if(places.begin(), places.end(),
                                 [&](const auto& place) { return place.address == click.address; });
    if (at == places.end()) {
      return refused(ExitStatus::kJobFailed,
                     still.name() + ": no pose: " + drivers::address_text(click.address) +
                         " of the start is not seen in the search window, expected all of them "
                         "there with --only-start");
    }
    named.push_back(*at);
  }
  places = std::move(named);
  return tracked;
}

}  // namespace tubesight::board
