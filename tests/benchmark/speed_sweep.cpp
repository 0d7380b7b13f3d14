// How fast the tool may move: `speed_sweep [--moves N] [--plot FILE.png]`, for docs/performance.md.
//
// Straight moves over drawn sheets, from rest to rest, at growing speed and acceleration. Prints
// Markdown tables; the same numbers every time on one machine. Exit status 1 when the box vouched
// for a wrong tube, named one, or lost a move that it has to follow.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "board/bench/campaign/move_run.h"
#include "board/bench/campaign/random_camera.h"
#include "board/bench/campaign/random_clicks.h"
#include "board/bench/campaign/random_source.h"
#include "tests/benchmark/line_plot.h"

namespace tubesight::benchmark {
namespace {

using board::campaign::Count;
using board::campaign::Counts;
using board::campaign::MoveRunner;
using board::campaign::Pitch;
using board::campaign::RandomSource;
using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;
using drivers::Scenario;

/// A tubesheet of the source's plants.
struct Sheet {
  const char* name;
  Pitch pitch;
  double pitch_mm;
  double bore_mm;
};

constexpr std::array<Sheet, 3> kSheets = {{
    {"triangular 22.225 mm", Pitch::kTriangular, 22.225, 14.2},
    {"square 25.4 mm", Pitch::kSquare, 25.4, 18.6},
    {"square 32.54 mm", Pitch::kSquare, 32.54, 19.7},
}};
constexpr std::array<double, 7> kSpeeds_mm_s = {250, 500, 750, 1000, 1250, 1500, 1600};
constexpr std::array<double, 6> kAccelerations_mm_s2 = {3000, 12000, 24000, 30000, 36000, 48000};
constexpr std::array<double, 5> kExposures_s = {0.0005, 0.001, 0.002, 0.004, 0.008};
constexpr std::array<core::overlay::Rgb, 3> kColours = {
    {{30, 90, 200}, {20, 140, 60}, {200, 40, 30}}};
constexpr double kStrong_mm_s2 = 12000.0;
constexpr double kExposure_s = 0.0005;

/// What must be followed without a loss: the aim of 1500 mm/s, up to eight times the acceleration
/// that a robot is taken to have.
bool must_be_followed(double speed_mm_s, double acceleration_mm_s2, double exposure_s) {
  return speed_mm_s <= 1500.0 && acceleration_mm_s2 <= 24000.0 && exposure_s <= 0.002;
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
  settings.rows = {-150, 190};
  settings.columns = {-150, 190};
  scenario.told.tubesheet = settings;
}

// Rest, one straight move over a way on which the speed is reached, rest.
void lay_path(const Case& what, RandomSource& random, Scenario& scenario) {
  const auto& sheet = scenario.scene.sheet;
  const double heading = random.between(0.0, 2.0 * std::numbers::pi);
  const double ramps = what.speed_mm_s * what.speed_mm_s / what.acceleration_mm_s2;
  const double way = std::max(1.2 * ramps, 5.0 * what.sheet->pitch_mm);
  scenario.from.x_mm = 20.0 * (sheet.row_step_mm[0] + sheet.column_step_mm[0]) + random.normal(0.4);
  scenario.from.y_mm = 20.0 * (sheet.row_step_mm[1] + sheet.column_step_mm[1]) + random.normal(0.4);
  scenario.from.height_mm = random.between(50.0, 70.0);
  scenario.from.alpha_deg = random.between(-180.0, 180.0);
  scenario.from.beta_deg = random.normal(0.2);
  scenario.from.gamma_deg = random.normal(0.2);
  PathSegment rest;
  rest.kind = SegmentKind::kRest;
  rest.rest_s = random.between(0.08, 0.12);
  PathSegment move;
  move.kind = SegmentKind::kMove;
  move.to_mm = {scenario.from.x_mm + way * std::cos(heading),
                scenario.from.y_mm + way * std::sin(heading)};
  move.limits = {what.speed_mm_s, what.acceleration_mm_s2, 1e6};
  scenario.path = {rest, move, rest};
  scenario.video.length_s = 0.0;
}

void make(const Case& what, std::int64_t number, Scenario& scenario) {
  const auto truth = std::make_unique<core::rendering::Truth>();
  for (std::uint64_t attempt = 0;; ++attempt) {
    RandomSource random(5, number, attempt);
    lay_sheet(*what.sheet, scenario);
    board::campaign::draw_camera({}, random, scenario);
    board::campaign::draw_light(random, scenario);
    scenario.video.rate_numerator = 30;
    scenario.video.exposure_s = what.exposure_s;
    scenario.told.motion = what.told;
    lay_path(what, random, scenario);
    if (truth->configure(scenario.scene) && draw_clicks(random, *truth, scenario)) {
      return;
    }
  }
}

/// What became of all moves of a case.
struct Tally {
  Counts counts;
  std::string reasons;
  bool failed = false;

  [[nodiscard]] std::int64_t followed() const {
    return counts[Count::kMoves] - counts[Count::kMovesLost] - counts[Count::kMovesRefused];
  }
  [[nodiscard]] std::int64_t wrong() const {
    return counts[Count::kWrongTube] + counts[Count::kWrongNearest] + counts[Count::kFalseAligned];
  }
};

class Sweep {
 public:
  explicit Sweep(int moves) : moves_(moves) {}

  Tally run(const Case& what) {
    Tally tally;
    for (int i = 0; i < moves_; ++i) {
      make(what, i, *scenario_);
      const auto result = runner_.run(*scenario_, {});
      tally.failed = tally.failed || !result.runs;
      tally.counts += result.counts;
    }
    fields_ += tally.counts[Count::kFields];
    for (const Count loss : {Count::kLostNoTubes, Count::kLostCoasted, Count::kLostJump,
                             Count::kLostSpeed, Count::kLostGap}) {
      if (tally.counts[loss] > 0) {
        tally.reasons += " " + std::string(name_of(loss).substr(5));
      }
    }
    ok_ = ok_ && !tally.failed && tally.wrong() == 0;
    return tally;
  }

  void require(bool good) { ok_ = ok_ && good; }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] long long fields() const { return fields_; }
  [[nodiscard]] int moves() const { return moves_; }

 private:
  int moves_;
  MoveRunner runner_;
  std::unique_ptr<Scenario> scenario_ = std::make_unique<Scenario>();
  std::int64_t fields_ = 0;
  bool ok_ = true;
};

void print_cell(const Tally& tally) {
  std::printf(" %lld%s%s |", static_cast<long long>(tally.followed()), tally.reasons.c_str(),
              tally.wrong() > 0 ? " WRONG" : "");
}

/// One row: a case at every speed. The fastest speed up to which all moves were followed.
template <typename MakeCase>
double sweep_speeds(Sweep& sweep, const std::string& name, MakeCase make_case) {
  std::printf("| %s |", name.c_str());
  double fastest = 0.0;
  bool followed = true;
  for (const double speed : kSpeeds_mm_s) {
    const Case what = make_case(speed);
    const Tally tally = sweep.run(what);
    print_cell(tally);
    followed = followed && tally.followed() == sweep.moves();
    fastest = followed ? speed : fastest;
    sweep.require(followed || !must_be_followed(speed, what.acceleration_mm_s2, what.exposure_s));
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
  for (std::size_t s = 0; s < kSheets.size(); ++s) {
    const Sheet& sheet = kSheets.at(s);
    Series series{sheet.name, kColours.at(s), {}};
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

// What a longer exposure smears.
Panel sweep_exposures(Sweep& sweep) {
  Panel panel{"12 m/s2", "exposure, ms", "fastest followed, mm/s", {}};
  for (std::size_t s = 0; s < kSheets.size(); ++s) {
    const Sheet& sheet = kSheets.at(s);
    Series series{sheet.name, kColours.at(s), {}};
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
  for (const Sheet& sheet : kSheets) {
    for (const double acceleration : {3000.0, 12000.0, 48000.0}) {
      std::printf("| %s, %.0f mm/s2 |", sheet.name, acceleration);
      for (const double speed : {300.0, 450.0, 600.0, 900.0, 1500.0}) {
        print_cell(sweep.run({&sheet, speed, acceleration, {300.0, 3000.0}, kExposure_s}));
      }
      std::printf("\n");
    }
  }
}

int run(int moves, const std::string& plot) {
  Sweep sweep(moves);
  const std::vector<Panel> panels{sweep_accelerations(sweep), sweep_exposures(sweep)};
  sweep_beyond_limits(sweep);
  std::printf("\n%lld fields%s\n", sweep.fields(), sweep.ok() ? "" : "; NOT as it has to be");
  std::string message;
  if (!plot.empty() && !write_plot(plot, panels, message)) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return 1;
  }
  return sweep.ok() ? 0 : 1;
}

}  // namespace
}  // namespace tubesight::benchmark

int main(int argc, char** argv) {
  int moves = 8;
  std::string plot;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--moves") {
      moves = std::atoi(argv[i + 1]);
    } else if (option == "--plot") {
      plot = argv[i + 1];
    } else {
      moves = 0;
    }
  }
  if (argc % 2 == 0 || moves < 1) {
    std::fprintf(stderr, "usage: speed_sweep [--moves N] [--plot FILE.png]\n");
    return 2;
  }
  return tubesight::benchmark::run(moves, plot);
}
