// How fast the tool may move: `speed_sweep [--moves N] [--sheets N] [--plot FILE.png]`, for
// docs/performance.md. With --sheets only the first N tubesheets, for a look that takes seconds.
//
// Straight moves over drawn sheets with plugs and voids, from rest to rest, at growing speed and
// acceleration, with cameras mounted both ways. Prints Markdown tables. Exit status 1 when the box
// vouched for a wrong tube, named one, lost a move that it has to follow, or slipped.
// In a cell behind the number of moves followed: why others were lost, `held` where fields under a
// tube were not vouched for, `off` where one was and truly 0.3 mm or more outside the gate.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "board/bench/campaign/move_run.h"
#include "board/bench/campaign/random_parts.h"
#include "board/bench/campaign/random_source.h"
#include "board/bench/output/line_plot.h"
#include "core/kinematics/tool_path.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::benchmark {
namespace {

using board::Panel;

using board::campaign::Count;
using board::campaign::Counts;
using board::campaign::Mounting;
using board::campaign::MoveRunner;
using board::campaign::Pitch;
using board::campaign::RandomSource;
using board::campaign::Stratum;
using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;
using core::rendering::PlugKind;
using drivers::Scenario;

/// A tubesheet of the source's plants.
struct Sheet {
  const char* name;
  Pitch pitch;
  double pitch_mm;
  double bore_mm;
  core::Weld weld;
};

constexpr std::array<Sheet, 3> kSheets = {{
    {"triangular 22.225 mm", Pitch::kTriangular, 22.225, 14.2, core::Weld::kFlush},
    {"square 25.4 mm", Pitch::kSquare, 25.4, 18.6, core::Weld::kFlush},
    {"square 32.54 mm", Pitch::kSquare, 32.54, 19.7, core::Weld::kFillet},
}};
// Up to what the core takes; settings files end at 1600 mm/s, and [motion] is set in memory here.
constexpr std::array<double, 7> kSpeeds_mm_s = {250, 500, 1000, 1250, 1500, 1750, 2000};
constexpr std::array<double, 6> kAccelerations_mm_s2 = {3000, 12000, 24000, 30000, 36000, 48000};
constexpr std::array<double, 4> kExposures_s = {0.001, 0.002, 0.004, 0.008};
constexpr std::array<core::overlay::Rgb, 3> kColours = {
    {{30, 90, 200}, {20, 140, 60}, {200, 40, 30}}};
constexpr double kStrong_mm_s2 = 12000.0;
constexpr double kExposure_s = 0.0005;
/// Smears beyond this, half a pitch of a fast move, may shift the guidetube by the gate's slack.
constexpr double kLongExposure_s = 0.004;

/// What must be followed without a loss: the aim of 1500 mm/s, up to eight times the acceleration
/// that a robot is taken to have.
bool must_be_followed(double speed_mm_s, double acceleration_mm_s2, double exposure_s) {
  return speed_mm_s <= 1500.0 && acceleration_mm_s2 <= 24000.0 && exposure_s <= 0.002;
}

/// Farthest address from (0, 0), where the moves begin, that plugs and voids are laid out to.
constexpr std::int32_t kFarthest = 130;

/// Every 15th address has no open tube: a void, which the box is told of, or a plug, which not.
bool open_at(std::int32_t row, std::int32_t column) {
  return (row + 4 * column + 15 * kFarthest) % 15 != 7;
}

/// One kind of move.
struct Case {
  const Sheet* sheet;
  double speed_mm_s;
  double acceleration_mm_s2;
  core::MotionSettings told;
  double exposure_s = kExposure_s;
};

void lay_sheet(const Sheet& sheet, Scenario& scenario) {
  core::TubesheetSettings& settings = scenario.scene.sheet;
  const double pitch = sheet.pitch_mm;
  const bool square = sheet.pitch == Pitch::kSquare;
  settings.row_step_mm = {square ? 0.0 : pitch / 2.0, square ? pitch : pitch * std::sqrt(0.75)};
  settings.column_step_mm = {pitch, 0.0};
  settings.bore_mm = sheet.bore_mm;
  settings.rows = {-170, 170};
  settings.columns = {-170, 170};
  settings.weld = sheet.weld;
  settings.missing.clear();
  scenario.scene.plugs.clear();
  for (std::int32_t row = -kFarthest; row <= kFarthest; ++row) {
    for (std::int32_t column = -kFarthest; column <= kFarthest; ++column) {
      if (!open_at(row, column) && (row + column) % 2 == 0) {
        static_cast<void>(settings.missing.try_push_back({row, column}));
      } else if (!open_at(row, column)) {
        const auto kind = row % 2 == 0 ? PlugKind::kRolled : PlugKind::kFlush;
        static_cast<void>(scenario.scene.plugs.try_push_back({{row, column}, kind}));
      }
    }
  }
  scenario.told.tubesheet = settings;  // of the plugs the box knows nothing
}

// The open tube nearest to a point that is `x`, `y` from the start's.
std::array<double, 2> tube_near(const core::TubesheetSettings& sheet, double x, double y) {
  std::array<double, 2> nearest{};
  double least = 1e9;
  for (std::int32_t row = -kFarthest; row <= kFarthest; ++row) {
    for (std::int32_t column = -kFarthest; column <= kFarthest; ++column) {
      const auto at = core::tubesheet::center_mm(sheet, {row, column});
      const double off = std::hypot(at[0] - x, at[1] - y);
      if (open_at(row, column) && off < least) {
        least = off;
        nearest = at;
      }
    }
  }
  return nearest;
}

// Rest, one straight move over a way on which the speed is reached, rest. Both rests are under a
// tube, so that a move that was followed ends with the right tube vouched for.
void lay_path(const Case& what, RandomSource& random, Scenario& scenario) {
  const auto& sheet = scenario.scene.sheet;
  const double heading = random.between(0.0, 2.0 * std::numbers::pi);
  const double ramps = what.speed_mm_s * what.speed_mm_s / what.acceleration_mm_s2;
  const double way = std::max(1.2 * ramps, 5.0 * what.sheet->pitch_mm);
  scenario.from.x_mm = random.normal(0.4);
  scenario.from.y_mm = random.normal(0.4);
  scenario.from.height_mm = random.between(50.0, 70.0);
  scenario.from.alpha_deg = random.between(-180.0, 180.0);
  scenario.from.beta_deg = random.normal(0.2);
  scenario.from.gamma_deg = random.normal(0.2);
  PathSegment rest;
  rest.kind = SegmentKind::kRest;
  rest.rest_s = random.between(0.08, 0.12);
  PathSegment move;
  move.kind = SegmentKind::kMove;
  move.to_mm = tube_near(sheet, way * std::cos(heading), way * std::sin(heading));
  move.limits = {what.speed_mm_s, what.acceleration_mm_s2, 1e6};
  scenario.path = {rest, move, rest};
  scenario.video.length_s = 0.0;
}

void make(const Case& what, std::int64_t number, Mounting mounting, Scenario& scenario) {
  Stratum kind;
  kind.mounting = mounting;
  const auto truth = std::make_unique<core::rendering::Truth>();
  for (std::uint64_t attempt = 0;; ++attempt) {
    RandomSource random(5, number, attempt);
    lay_sheet(*what.sheet, scenario);
    board::campaign::draw_camera(kind, random, scenario);
    board::campaign::draw_light(random, scenario);
    scenario.video.rate_numerator = 30;
    scenario.video.exposure_s = what.exposure_s;
    scenario.told.motion = what.told;
    lay_path(what, random, scenario);
    if (truth->configure(scenario.scene) &&
        board::campaign::draw_clicks(random, *truth, core::kinematics::transform_of(scenario.from),
                                     scenario, scenario.told.start.tubes)) {
      return;
    }
  }
}

constexpr std::array<Count, 7> kLosses = {
    Count::kLostNoTubes, Count::kLostCoasted, Count::kLostJump,      Count::kLostSpeed,
    Count::kLostGap,     Count::kLostRate,    Count::kLostFieldOrder};

/// Whether a move was lost in the open: `lost` for a reason that docs/file-formats.md lists.
bool openly_lost(const Counts& move) {
  std::int64_t losses = 0;
  for (const Count loss : kLosses) {
    losses += move[loss];
  }
  return move[Count::kMovesLost] == 1 && losses == 1;
}

/// Whether the box stayed with the tool to the end.
bool kept(const Counts& move) {
  return move[Count::kMoves] == 1 && move[Count::kMovesLost] == 0 &&
         move[Count::kMovesRefused] == 0;
}

/// Whether it vouched for all tubes on the way besides, the last one too, in all fields.
bool followed(const Counts& move) {
  return kept(move) && move[Count::kTubes] >= 2 && move[Count::kMissed] == 0;
}

/// What became of all moves of a case.
struct Tally {
  Counts counts;
  std::string reasons;
  std::int64_t followed = 0;
  std::int64_t held = 0;     ///< not lost, but fields were missed
  std::int64_t slipped = 0;  ///< neither followed nor openly lost

  [[nodiscard]] std::int64_t wrong() const {
    return counts[Count::kWrongTube] + counts[Count::kWrongNearest];
  }
};

class Sweep {
 public:
  Sweep(int moves, std::size_t sheets) : moves_(moves), sheets_(std::span(kSheets).first(sheets)) {}

  Tally run(const Case& what) {
    Tally tally;
    for (int i = 0; i < moves_; ++i) {
      // Both in turn, also with one move a case.
      make(what, i, (cases_ + i) % 2 == 0 ? Mounting::kUpright : Mounting::kTurned, *scenario_);
      const auto result = runner_.run(*scenario_, {});
      tally.counts += result.counts;
      if (followed(result.counts)) {
        ++tally.followed;
      } else if (kept(result.counts)) {
        ++tally.held;
      } else if (!openly_lost(result.counts)) {
        ++tally.slipped;
      }
    }
    ++cases_;
    fields_ += tally.counts[Count::kFields];
    for (const Count loss : kLosses) {
      if (tally.counts[loss] > 0) {
        tally.reasons += " " + std::string(name_of(loss).substr(5));
      }
    }
    const bool off = tally.counts[Count::kFalseAligned] > 0;
    tally.reasons += tally.held > 0 ? " held" : "";
    tally.reasons += off ? " off" : "";
    ok_ = ok_ && tally.slipped == 0 && tally.wrong() == 0 &&
          !(off && what.exposure_s <= kLongExposure_s);
    return tally;
  }

  void require(bool good) { ok_ = ok_ && good; }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] long long fields() const { return fields_; }
  [[nodiscard]] int moves() const { return moves_; }
  [[nodiscard]] std::span<const Sheet> sheets() const { return sheets_; }

 private:
  int moves_;
  std::span<const Sheet> sheets_;
  MoveRunner runner_;
  std::unique_ptr<Scenario> scenario_ = std::make_unique<Scenario>();
  std::int64_t cases_ = 0;
  std::int64_t fields_ = 0;
  bool ok_ = true;
};

void print_cell(const Tally& tally) {
  std::printf(" %lld%s%s%s |", static_cast<long long>(tally.followed), tally.reasons.c_str(),
              tally.slipped > 0 ? " SLIPPED" : "", tally.wrong() > 0 ? " WRONG" : "");
}

/// One row: a case at every speed. The fastest speed up to which all moves were followed.
template <typename MakeCase>
double sweep_speeds(Sweep& sweep, const std::string& name, MakeCase make_case) {
  std::printf("| %s |", name.c_str());
  double fastest = 0.0;
  bool all = true;
  for (const double speed : kSpeeds_mm_s) {
    const Case what = make_case(speed);
    const Tally tally = sweep.run(what);
    print_cell(tally);
    all = all && tally.followed == sweep.moves();
    fastest = all ? speed : fastest;
    sweep.require(all || !must_be_followed(speed, what.acceleration_mm_s2, what.exposure_s));
  }
  std::printf("\n");
  return fastest;
}

void print_head(const Sweep& sweep, const std::string& title) {
  std::printf("\n%s, moves followed of %d:\n\n| mm/s |", title.c_str(), sweep.moves());
  for (const double speed : kSpeeds_mm_s) {
    std::printf(" %.0f |", speed);
  }
  std::printf("\n|---|---|---|---|---|---|---|---|\n");
}

std::string with_unit(double value, const char* unit) {
  char text[40];
  std::snprintf(text, sizeof text, "%g %s", value, unit);
  return text;
}

// [motion] tells what the robot does.
Panel sweep_accelerations(Sweep& sweep) {
  Panel panel{"0.5 ms of exposure", "acceleration, m/s2", "fastest followed, mm/s", {}};
  for (std::size_t s = 0; s < sweep.sheets().size(); ++s) {
    const Sheet& sheet = sweep.sheets()[s];
    board::Series series{sheet.name, kColours.at(s), {}};
    print_head(sweep, sheet.name);
    for (const double acceleration : kAccelerations_mm_s2) {
      const double fastest =
          sweep_speeds(sweep, with_unit(acceleration, "mm/s2"), [&](double speed) {
            return Case{&sheet, speed, acceleration, {speed, acceleration}, kExposure_s};
          });
      series.points.push_back({acceleration / 1000.0, fastest});
    }
    panel.series.push_back(series);
  }
  return panel;
}

// What a longer exposure smears; `shortest` has the curves' first points, from the accelerations.
Panel sweep_exposures(Sweep& sweep, const Panel& shortest) {
  Panel panel{"12 m/s2", "exposure, ms", "fastest followed, mm/s", {}};
  for (std::size_t s = 0; s < sweep.sheets().size(); ++s) {
    const Sheet& sheet = sweep.sheets()[s];
    board::Series series{sheet.name, kColours.at(s), {}};
    for (const auto& point : shortest.series.at(s).points) {
      if (point[0] * 1000.0 == kStrong_mm_s2) {
        series.points.push_back({kExposure_s * 1000.0, point[1]});
      }
    }
    print_head(sweep, std::string(sheet.name) + ", 12000 mm/s2, by exposure");
    for (const double exposure_s : kExposures_s) {
      const double fastest =
          sweep_speeds(sweep, with_unit(exposure_s * 1000.0, "ms"), [&](double speed) {
            return Case{&sheet, speed, kStrong_mm_s2, {speed, kStrong_mm_s2}, exposure_s};
          });
      series.points.push_back({exposure_s * 1000.0, fastest});
    }
    panel.series.push_back(series);
  }
  return panel;
}

// The robot does more than [motion] says: openly lost, whenever the box cannot follow.
void sweep_beyond_limits(Sweep& sweep) {
  std::printf("\nFaster than [motion] says (300 mm/s, 3000 mm/s2), moves followed of %d:\n\n",
              sweep.moves());
  std::printf("| sheet, mm/s | 300 | 450 | 600 | 900 | 1500 |\n|---|---|---|---|---|---|\n");
  for (const Sheet& sheet : sweep.sheets()) {
    for (const double acceleration : {3000.0, 12000.0, 48000.0}) {
      std::printf("| %s, %.0f mm/s2 |", sheet.name, acceleration);
      for (const double speed : {300.0, 450.0, 600.0, 900.0, 1500.0}) {
        print_cell(sweep.run({&sheet, speed, acceleration, {300.0, 3000.0}, kExposure_s}));
      }
      std::printf("\n");
    }
  }
}

int run(int moves, std::size_t sheets, const std::string& plot) {
  Sweep sweep(moves, sheets);
  const Panel accelerations = sweep_accelerations(sweep);
  const std::vector<Panel> panels{accelerations, sweep_exposures(sweep, accelerations)};
  sweep_beyond_limits(sweep);
  std::printf("\n%lld fields%s\n", sweep.fields(), sweep.ok() ? "" : "; NOT as it has to be");
  std::string message;
  if (!plot.empty() && !board::write_plot(plot, panels, message)) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return 1;
  }
  return sweep.ok() ? 0 : 1;
}

}  // namespace
}  // namespace tubesight::benchmark

int main(int argc, char** argv) {
  int moves = 8;
  std::size_t sheets = tubesight::benchmark::kSheets.size();
  std::string plot;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--moves") {
      moves = std::atoi(argv[i + 1]);
    } else if (option == "--sheets") {
      sheets = static_cast<std::size_t>(std::atoi(argv[i + 1]));
    } else if (option == "--plot") {
      plot = argv[i + 1];
    } else {
      moves = 0;
    }
  }
  if (argc % 2 == 0 || moves < 1 || sheets < 1 || sheets > tubesight::benchmark::kSheets.size()) {
    std::fprintf(stderr, "usage: speed_sweep [--moves N] [--sheets N] [--plot FILE.png]\n");
    return 2;
  }
  return tubesight::benchmark::run(moves, sheets, plot);
}
