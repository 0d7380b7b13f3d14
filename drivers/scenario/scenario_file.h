#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/sighting.h"
#include "drivers/files/messages.h"
#include "drivers/settings/text_files.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::drivers {

/// What the box should make of a scenario; the table `[expect]`, for tests.
struct Expectation {
  double answered = 0.98;  ///< least share of the fields that track or are degraded
  double missed = 0.02;    ///< largest share of the truly aligned fields that are not vouched for
  core::TrackState end = core::TrackState::kTracking;  ///< of the last field
  core::Reason lost = core::Reason::kNone;             ///< this loss happens
  core::Reason degraded = core::Reason::kNone;         ///< this care happens
  std::int32_t false_aligned = 0;  ///< at most so many fields are vouched for outside the gate
  std::int32_t contradicted = 0;   ///< claims that the box must contradict
  std::int32_t confirmed = 0;      ///< at least so many claims are confirmed
  std::int32_t tubes = 0;          ///< at least so many different tubes are rightly vouched for
  bool undetectable = false;       ///< wrong tubes after a silent jump are what the scenario shows
};

/// A scenario file as read. Some 600 KB: static or heap, never on a stack.
struct ScenarioFile {
  drivers::Scenario scenario;
  std::string title;
  std::vector<std::string> files;  ///< that it was read from
  Expectation expect;
};

/// What the command line puts in the place of the file's values.
struct ScenarioOverrides {
  std::int64_t seed = -1;    ///< below 0: the file's
  bool window_only = false;  ///< draw the search window and a margin alone
};

/// Reads a scenario from `path` and the files that it includes, and checks it whole: nothing that
/// plays it afterwards can refuse it.
///
/// Everything in `file` is replaced; after an error it is not to be used. Errors: kInvalidArgument,
/// with one message for each mistake in all the files ("file:line: key: what, expected ...").
[[nodiscard]] core::Result<void> load_scenario(drivers::TextFiles& files, const std::string& path,
                                               const ScenarioOverrides& overrides,
                                               ScenarioFile& file, drivers::Messages& messages);

/// The same from the file system.
[[nodiscard]] core::Result<void> load_scenario(const std::string& path,
                                               const ScenarioOverrides& overrides,
                                               ScenarioFile& file, drivers::Messages& messages);

}  // namespace tubesight::drivers
