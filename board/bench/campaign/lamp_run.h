#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "board/bench/campaign/random_move.h"
#include "core/lighting/lamp_policy.h"
#include "core/rendering/truth.h"
#include "drivers/simulated/scenario.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::board::campaign {

/// What goes wrong with the lamp, or with the picture that should follow it.
enum class LampFault : std::uint8_t {
  kNone,
  kDead,         ///< the bulb dies, beside the camera's LEDs or in the dark
  kFades,        ///< within seconds to next to nothing
  kFrozen,       ///< a frame store that hangs, under new noise
  kOtherCamera,  ///< another toolhead's picture, whose lamp swings by a pattern of its own
};
inline constexpr std::int32_t kLampFaults = 5;

/// What the tool does meanwhile.
enum class LampMotion : std::uint8_t {
  kRests,
  kMoves,   ///< from tube to tube, with short rests
  kGoesOn,  ///< rests when the fault comes, and goes on within three seconds
};
inline constexpr std::int32_t kLampMotions = 3;

inline constexpr std::int32_t kLampKinds = kLampFaults * kLampMotions;

/// How long a fault may go without its name.
inline constexpr double kNamedAtRest_s = 2.0;
inline constexpr double kNamedMoving_s = 10.0;

/// One run: a box that rules its lamp, and what goes wrong.
struct LampRun {
  LampFault fault = LampFault::kNone;
  LampMotion motion = LampMotion::kRests;
  double fault_s = 0.0;  ///< when it comes; a lamp that fades: when it has faded
  core::lighting::LampPolicy policy;
};

/// The number of a run's kind, 0 to kLampKinds - 1; "frozen/rests".
[[nodiscard]] std::int32_t lamp_kind_of(const LampRun& run);
[[nodiscard]] std::string lamp_kind_name(std::int32_t kind);

/// Draws runs; the same seed and number make the same run. Plant, camera, light and clicks are
/// those of a campaign's moves without faults; the lamp's lag, the LEDs' share, the path, the fault
/// and the pattern are drawn beside.
class LampRunMaker {
 public:
  explicit LampRunMaker(const DrawOptions& options = {}) : moves_(options) {}

  /// Everything in `scenario` is replaced.
  [[nodiscard]] LampRun make(std::uint64_t seed, std::int64_t number, drivers::Scenario& scenario);

 private:
  MoveMaker moves_;
  std::unique_ptr<core::rendering::Truth> truth_ = std::make_unique<core::rendering::Truth>();
};

/// What is counted of runs.
enum class LampCount : std::uint8_t {
  kRuns,
  kFields,
  kRefused,      ///< starts refused: nothing else is counted of such a run
  kProved,       ///< runs whose picture was proved live before the fault, or ever
  kFalseAlarms,  ///< runs in which a sound lamp was called faulty, or a live picture not live
  kNamed,        ///< faults to which `condition` gave a name
  kNamedLate,    ///< of those, later than they may
  kLostBefore,   ///< faults by which the track was lost before they had a name, or without one
  kUnnamed,      ///< faults that got no name in the run
  kUnknown,      ///< of those, of which the box said in the end that it does not know: not `proved`
  kVouched,      ///< fields with `aligned`
  kWrong,        ///< of those, under another tube than named, or where no tube stands
  kWrongUnnamed,  ///< of those, after a fault and before its name
  kRunsWrong,     ///< runs with a field of kWrong
};
inline constexpr std::size_t kLampCounts = 14;

/// The word of a count in files.
[[nodiscard]] std::string_view name_of(LampCount count);

/// What was counted in a run, or in all of a kind.
struct LampCounts {
  std::array<std::int64_t, kLampCounts> values{};
  std::int64_t named_ms_sum = 0;  ///< from the fault to its name
  std::int64_t named_ms_most = 0;
  std::int64_t proved_ms_most = 0;  ///< from the start to the first proof

  [[nodiscard]] std::int64_t operator[](LampCount count) const {
    return values[static_cast<std::size_t>(count)];
  }
  std::int64_t& operator[](LampCount count) { return values[static_cast<std::size_t>(count)]; }

  LampCounts& operator+=(const LampCounts& other);
  friend bool operator==(const LampCounts&, const LampCounts&) = default;
};

/// What came of a run.
struct LampResult {
  bool runs = false;  ///< false: the scenario cannot be played or tracked; nothing else is valid
  LampCounts counts;
  std::string named;  ///< the condition that named the fault; empty: none did
};

/// Runs them in memory, a box with its loop. Some MB, kept from run to run; one thread.
class LampRunner {
 public:
  [[nodiscard]] LampResult run(const drivers::Scenario& scenario, const LampRun& run);

 private:
  std::unique_ptr<drivers::SimulatedWorld> world_ = std::make_unique<drivers::SimulatedWorld>();
};

}  // namespace tubesight::board::campaign
