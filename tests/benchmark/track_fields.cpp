// track_fields FOLDER [TUBES]: tracks a recording in fixed point, for callgrind to count.
//
// The recording lies in memory before; collection is on during step() alone, and off in the start's
// field, whose whole-window searches a running box does not repeat. With TUBES the search window is
// narrowed around the optimum point until it shows that many tube-ends or fewer on average.
//
// Prints `fields tubes state_bytes`: what was counted over, and the size of the tracking state.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <valgrind/callgrind.h>

#include "tests/benchmark/recorded_session.h"

namespace tubesight::tests {
namespace {

using core::FixedPoint;
using core::SessionSettings;

struct Tally {
  std::int64_t fields = 0;
  std::int64_t tubes = 0;

  [[nodiscard]] double mean() const {
    return static_cast<double>(tubes) / static_cast<double>(fields);
  }
};

std::int64_t measured_in(const core::session::Output& output) {
  std::int64_t count = 0;
  for (const core::TubeSighting& tube : output.tubes) {
    count += tube.plug ? 0 : 1;
  }
  return count;
}

// Over all fields behind the start's; stops where the track is lost.
bool track(const RecordedSession& recording, const SessionSettings& settings, bool collect,
           Tally& tally) {
  SessionRun<FixedPoint> run;
  if (!run.configure(settings)) {
    return false;
  }
  run.give(recording.fields().front());
  run.step();
  for (std::size_t i = 1; i < recording.fields().size(); ++i) {
    if (run.output().sighting.state != core::TrackState::kTracking) {
      return false;
    }
    run.give(recording.fields()[i]);
    if (collect) {
      CALLGRIND_TOGGLE_COLLECT;
    }
    run.step();
    if (collect) {
      CALLGRIND_TOGGLE_COLLECT;
    }
    ++tally.fields;
    tally.tubes += measured_in(run.output());
  }
  return true;
}

// Each side of the window moved towards the optimum point; percent 100 leaves it as it is.
std::array<std::int32_t, 4> narrowed(const core::StartSettings& start, std::int32_t percent) {
  std::array<std::int32_t, 4> window{};
  for (std::size_t side = 0; side < window.size(); ++side) {
    const auto optimum = static_cast<std::int32_t>(std::lround(start.optimum_px[side % 2]));
    window[side] = optimum + (start.window_px[side] - optimum) * percent / 100;
  }
  return window;
}

// Narrows the window until the mean number of tube-ends a field is `most` or less.
bool narrow_window(const RecordedSession& recording, double most, SessionSettings& settings) {
  const core::StartSettings start = settings.start;
  for (std::int32_t percent = 100; percent >= 40; --percent) {
    settings.start.window_px = narrowed(start, percent);
    Tally tally;
    if (!track(recording, settings, false, tally)) {
      return false;
    }
    if (tally.mean() <= most) {
      return true;
    }
  }
  return false;
}

int run(const std::string& folder, double most_tubes) {
  static RecordedSession recording;
  drivers::Messages messages;
  if (!recording.load(folder, messages)) {
    for (const std::string& message : messages) {
      std::fprintf(stderr, "%s\n", message.c_str());
    }
    return 2;
  }
  static SessionSettings settings;
  settings = recording.settings();
  Tally tally;
  if ((most_tubes > 0.0 && !narrow_window(recording, most_tubes, settings)) ||
      !track(recording, settings, true, tally) || tally.tubes == 0) {
    std::fprintf(stderr, "%s: not tracked to the end, expected a track to count over\n",
                 folder.c_str());
    return 1;
  }
  std::printf("%lld %lld %d\n", static_cast<long long>(tally.fields),
              static_cast<long long>(tally.tubes),
              core::session::Session<FixedPoint>::tracking_state_bytes());
  return 0;
}

}  // namespace
}  // namespace tubesight::tests

int main(int count, char** arguments) {
  if (count != 2 && count != 3) {
    std::fprintf(stderr, "usage: track_fields FOLDER [TUBES]\n");
    return 2;
  }
  return tubesight::tests::run(arguments[1], count == 3 ? std::atof(arguments[2]) : 0.0);
}
