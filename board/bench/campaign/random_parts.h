#pragma once

#include <cstdint>
#include <vector>

#include "board/bench/campaign/random_source.h"
#include "board/bench/campaign/stratum.h"
#include "core/rendering/truth.h"
#include "core/rendering/tube_ends.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::board::campaign {

// What a random move is drawn of, in the order in which it is drawn: a source file each.

/// Addresses of a random sheet run from 0 to this in rows and columns: the tool starts well inside,
/// and the sheet's edges come into view now and then.
inline constexpr std::int32_t kLastAddress = 40;

/// Draws the plant of a move: pitch 20.6 to 32.6 mm, bores of 60 to 74 % of it, numbering of any
/// kind and hand, stays and lanes without tubes, plugs listed and not, deposits, the plate's looks.
///
/// Writes the scene's sheet and look, and what the box is told of it.
void draw_plant(const Stratum& stratum, RandomSource& random, drivers::Scenario& scenario);

/// Distance of neighbouring tubes, mm.
[[nodiscard]] double pitch_mm(const core::TubesheetSettings& sheet);

/// Draws the camera, how it sits on the tool, its calibrations (a little off, as calibrations are),
/// the search window, the lamp and the sensor. Needs the plant: a coarser pitch is looked at from
/// farther away.
void draw_camera(const Stratum& stratum, RandomSource& random, drivers::Scenario& scenario);

/// Draws how many columns and lines the picture has, 320 x 240 to 1920 x 1200, whether in fields or
/// whole, and how often, 50 to 120 fields a second: what the camera of draw_camera() sees, through
/// the same lens.
void draw_size(RandomSource& random, drivers::Scenario& scenario);

/// A camera that delivers whole frames has no two fields to come in the other order.
void leave_out_faults_of_fields(drivers::Scenario& scenario);

/// From field to field.
[[nodiscard]] double field_s(const drivers::Scenario& scenario);

/// Draws ordinary light and an ordinary sensor.
void draw_light(RandomSource& random, drivers::Scenario& scenario);

/// Draws the limits of [motion] and a path within them: rest, moves by a few tubes at the band's
/// speed, changes of height, heading and lean, docking, rest; 70 to 80 fields, give or take.
///
/// The tool ends a move up to a millimetre beside the tube, as a robot does. `ends` is the scene's.
void draw_path(const Stratum& stratum, RandomSource& random, const core::rendering::TubeEnds& ends,
               drivers::Scenario& scenario);

/// Draws the faults of a move, one or now and then two of its group, at any time of the path; the
/// first few fields are spared, so that the start is sound. Needs plant and path.
void draw_faults(const Stratum& stratum, RandomSource& random, drivers::Scenario& scenario);

/// Draws, in a share of the moves and each from random numbers of its own, what came later than the
/// groups of faults: a plug or void that nobody listed under a place where the tool rests; and
/// in the place of a jump by lattice steps a length of the path left out, or a step of height,
/// heading or lean. Needs plant, path and faults; the plant changes.
void draw_deceptions(const Stratum& stratum, std::uint64_t seed, std::int64_t move,
                     const core::rendering::TubeEnds& ends, drivers::Scenario& scenario);

/// Draws what goes wrong between camera and box in the place of the faults that are drawn already,
/// in a part of the moves of its groups: a store that hangs bit for bit or under noise, stamps that
/// waver, a compressor. Each kind by random numbers of its own. Needs plant, camera and path.
void draw_source_faults(std::uint64_t seed, std::int64_t move, const Stratum& stratum,
                        drivers::Scenario& scenario);

/// Draws what spoils the picture, in the place of the faults that are drawn already and in a part
/// of the moves of their group: blots, reflections, specks, a ghost, a raised black level or a
/// cover, half of them from the first field on; in the group of lamps nothing but the camera's own
/// LEDs. By random numbers of its own. Needs light and path.
void draw_spoilt_picture(std::uint64_t seed, std::int64_t move, const Stratum& stratum,
                         drivers::Scenario& scenario);

using Pose = core::Transform<core::frames::Sheet, core::frames::Tool>;
using Clicks = decltype(core::StartSettings::tubes);

/// A tube-end that the operator can see.
struct Visible {
  core::TubeAddress address;
  core::rendering::TubeImage image;
  double off_px = 0.0;  ///< from the optimum point
};

/// All open tube-ends that stand wholly in the window when the tool is at a place, but for those
/// that the box is told are plugged; nearest to the optimum point first.
[[nodiscard]] std::vector<Visible> list_visible(const core::rendering::Truth& truth,
                                                const Pose& T_sheet_tool,
                                                const drivers::Scenario& scenario);

/// Draws an operator's three clicks into a field: open tube-ends wholly in view near the optimum
/// point, not in one line, each up to 60 % of the tube-end's radius off its middle.
///
/// False when the view does not show three such tube-ends.
[[nodiscard]] bool draw_clicks(RandomSource& random, const core::rendering::Truth& truth,
                               const Pose& T_sheet_tool, const drivers::Scenario& scenario,
                               Clicks& clicks);

/// Draws, in the place of the faults of the group of jumps, an operator who errs by one to three
/// steps: in the first start, where six tube-ends or more in view then stand where the settings
/// list none; or in a second start against the track. Each by random numbers of its own. Needs all
/// else.
void draw_wrong_starts(const Stratum& stratum, std::uint64_t seed, std::int64_t move,
                       const core::rendering::Truth& truth, drivers::Scenario& scenario);

}  // namespace tubesight::board::campaign
