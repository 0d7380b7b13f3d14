#include "board/bench/command_line.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "board/bench/budget/budget_command.h"
#include "board/bench/calibrate_arguments.h"
#include "board/bench/campaign/campaign_command.h"
#include "board/bench/campaign/campaign_options.h"
#include "board/bench/devices/devices_command.h"
#include "board/bench/look/look_command.h"
#include "board/bench/number_range.h"
#include "board/bench/pose/pose_command.h"
#include "board/bench/pose/pose_options.h"
#include "board/bench/replay/replay_command.h"
#include "board/bench/replay/replay_options.h"
#include "board/bench/simulate/simulate_command.h"
#include "board/bench/simulate/simulate_options.h"
#include "board/box/version.h"

namespace tubesight::board {
namespace {

const std::map<std::string, ScalarChoice> kScalars = {
    {"fixed", ScalarChoice::kFixed},
    {"float", ScalarChoice::kFloat},
    {"double", ScalarChoice::kDouble},
};

CLI::App* add_replay(CLI::App& app, ReplayOptions& options, std::string& scalar) {
  CLI::App* const replay = app.add_subcommand(
      "replay", "The vision box on a recording: tracks, names the tube above the guidetube");
  replay
      ->add_option("SESSION.toml", options.session,
                   "Settings of the session: camera, tool, tubesheet, start (TOML)")
      ->required();
  replay
      ->add_option("RECORDING", options.recording,
                   "Recording: .y4m or .y4m.xz; its .meta.csv and .events.csv are read when there")
      ->required();
  replay->add_option("--fields", options.fields, "Write one row a field")->option_text("F.csv");
  replay->add_option("--centers", options.centers, "Write one row a tube-end measured")
      ->option_text("C.csv");
  CLI::Option* const overlay =
      replay
          ->add_option("--overlay", options.overlay,
                       "Write what the operator sees, one picture a field: PNG pictures into the "
                       "folder OUT, or a colour video when OUT ends in .y4m")
          ->option_text("OUT");
  replay
      ->add_flag("--overlay-estimates", options.overlay_estimates,
                 "Draw where every tube is expected, too")
      ->needs(overlay);
  replay->add_option("--poses", options.poses, "Write one row a pose request, as pose --csv does")
      ->option_text("P.csv");
  replay
      ->add_option("--pairs", options.pairs,
                   "Write one row a pose that was confirmed and with which the robot told its own, "
                   "as calibrate base reads them")
      ->option_text("PAIRS.csv");
  replay
      ->add_option("--scalar", scalar,
                   "Arithmetic of the tracking: fixed (default), float or double")
      ->option_text("NAME")
      ->check(CLI::IsMember({"fixed", "float", "double"}));
  return replay;
}

const std::map<std::string, core::pose::PoseMethod> kPoseMethods = {
    {"rims", core::pose::PoseMethod::kRims},
    {"centers", core::pose::PoseMethod::kCenters},
    {"tangent-points", core::pose::PoseMethod::kTangentPoints},
    {"tangent-lines", core::pose::PoseMethod::kTangentLines},
    {"ellipse-centers", core::pose::PoseMethod::kEllipseCenters},
};

const std::map<std::string, core::picture::EdgeMethod> kEdgeMethods = {
    {"step", core::picture::EdgeMethod::kBlurredStep},
    {"mid-level", core::picture::EdgeMethod::kMidLevel},
    {"moment", core::picture::EdgeMethod::kMoment},
};

/// An option that takes one of the names of a table.
template <typename Value>
void add_choice(CLI::App& command, const std::string& name, const char* text,
                const std::map<std::string, Value>& table, Value& value) {
  command
      .add_option_function<std::string>(
          name, [&table, &value](const std::string& word) { value = table.at(word); }, text)
      ->option_text("NAME")
      ->check(CLI::IsMember(table));
}

CLI::App* add_pose(CLI::App& app, PoseCommandOptions& options) {
  CLI::App* const pose =
      app.add_subcommand("pose", "The tool's pose from a still at rest, or from several averaged");
  pose->add_option(
          "SESSION.toml", options.session,
          "Settings of the session: camera, tubesheet, and tool for the tool's pose (TOML)")
      ->required();
  pose->add_option("IMAGE", options.images,
                   "Stills: 8-bit grey PNG or PGM; or recordings (.y4m, .y4m.xz)")
      ->required();
  pose->add_option(
          "--frames", options.frames,
          "Of recordings: the frames, counted from 0, their tubes tracked from that of the "
          "start; default: the first alone")
      ->option_text("A-B")
      ->check([](const std::string& text) {
        return std::string(text.empty() ? "names no frame, expected A-B or A" : "");
      });
  pose->add_option("--start", options.start,
                   "Tube-ends by row, column and a place in their dark, px, in each picture and in "
                   "the first frame of --frames; default: [start], clicked in frame 0")
      ->option_text("\"R,C,U,V;...\"")
      ->check([](const std::string& text) {
        return std::string(text.empty() ? "names no tube-end, expected R,C,U,V;R,C,U,V;..." : "");
      });
  pose->add_flag("--only-start", options.only_start, "Use the tube-ends named and no others");
  pose->add_flag("--average", options.average, "Average all stills, up to 32, to one pose");
  pose->add_option("--csv", options.csv, "Write one row a pose")->option_text("P.csv");
  pose->add_option("--covariance", options.covariance, "Write the covariance, one row a pose")
      ->option_text("V.csv");
  pose->add_flag("--total", options.total,
                 "Add to the uncertainties what the calibrations leave uncertain");
  pose->add_option("--overlay", options.overlay,
                   "Write the picture with the fitted rims, edge points and centres")
      ->option_text("OUT.png");
  CLI::Option* const correct =
      pose->add_option("--correct", options.correct,
                       "Tell the move in the tool's frame that brings the tip under this tube")
          ->option_text("ROW,COLUMN");
  pose->add_option("--limit-mm", options.limit_mm,
                   "With --correct: the offset at which the insertion works; default 2.5")
      ->option_text("L")
      ->check(number_between(0.001, 100.0))
      ->needs(correct);
  add_choice(*pose, "--method",
             "How the pose is fitted, for comparison: rims (default), centers, "
             "tangent-points, tangent-lines or ellipse-centers",
             kPoseMethods, options.method);
  add_choice(*pose, "--edge",
             "How an edge is placed, for comparison: step (default), mid-level or "
             "moment",
             kEdgeMethods, options.edge);
  return pose;
}

CLI::App* add_look(CLI::App& app, LookOptions& options) {
  CLI::App* const look = app.add_subcommand(
      "look", "Finds the lattice in pictures with no settings at all: dots or tube-ends");
  look->add_option("PICTURE", options.pictures,
                   "Stills: PNG or PGM; or recordings (.y4m, .y4m.xz), their first frame")
      ->required();
  look->add_option("--csv", options.csv, "Write one row an element found")->option_text("L.csv");
  look->add_option("--overlay", options.overlay,
                   "Write the picture with the elements and their rows and columns")
      ->option_text("O.png");
  return look;
}

CLI::App* add_budget(CLI::App& app, BudgetOptions& options) {
  CLI::App* const budget = app.add_subcommand(
      "budget",
      "What each quantity adds to the error of the tool's position, by vision and by the robot");
  budget
      ->add_option("SETTINGS", options.settings,
                   "A session with camera, tool and tubesheet, and what their calibrations say of "
                   "themselves (TOML)")
      ->required();
  budget->add_option("--robots", options.robots, "Robots that are simulated; default 100")
      ->option_text("N")
      ->check(CLI::Range(1, 100000));
  budget->add_option("--seed", options.seed, "Seed of their errors; default 1")
      ->option_text("S")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{2147483647}));
  budget
      ->add_option("--height-mm", options.height_mm,
                   "The sheet above the tool's tip, for vision; default 40")
      ->option_text("H")
      ->check(number_between(0.0, 500.0));
  budget->add_option("--plot", options.plot, "Draw the ways to calibrate a base")
      ->option_text("PLOT.png");
  return budget;
}

CLI::App* add_campaign(CLI::App& app, CampaignOptions& options) {
  CLI::App* const campaign = app.add_subcommand(
      "campaign", "Random plants, cameras, paths and faults: counts what the box says wrong");
  constexpr std::int64_t kMost = std::int64_t{1} << 53U;
  const CLI::Range positive(std::int64_t{1}, kMost);
  const CLI::Range natural(std::int64_t{0}, kMost);
  campaign->add_option("--moves", options.moves, "Run until N moves are done, those resumed too")
      ->option_text("N")
      ->check(positive);
  campaign->add_option("--fields", options.fields, "Run until the box has seen N fields")
      ->option_text("N")
      ->check(positive);
  campaign->add_option("--hours", options.hours, "Run for H hours")
      ->option_text("H")
      ->check(number_between(1e-6, 1e5));
  campaign
      ->add_option("--seed", options.seed,
                   "Seed of all that is drawn; default 1, or that of --resume")
      ->option_text("S")
      ->check(natural);
  campaign
      ->add_option("--first-move", options.first_move,
                   "Number of the first move; default 0, or the first of --resume")
      ->option_text("M")
      ->check(natural);
  campaign->add_option("--jobs", options.jobs, "Moves run at a time; default 1")
      ->option_text("J")
      ->check(CLI::Range(1, 1024));
  campaign
      ->add_option("--resume", options.resume,
                   "Progress file (CSV): continued when it is there, kept up to date")
      ->option_text("FILE");
  campaign->add_option("--report", options.report, "Write counts and bounds of every stratum (CSV)")
      ->option_text("FILE");
  campaign->add_option("--merge", options.merge, "Put progress files together, and report")
      ->option_text("FILE...");
  campaign
      ->add_option("--replay-move", options.one_move,
                   "Run one move and write it as a scenario for tubesight simulate")
      ->option_text("SEED:MOVE");
  campaign
      ->add_option("--out", options.out,
                   "Where the scenario goes; with --merge: the merged progress file")
      ->option_text("FILE");
  campaign->add_flag("--lamps", options.lamps,
                     "In place of moves: runs of a box that rules its lamp, and what goes wrong");
  campaign->add_flag("--sizes", options.sizes,
                     "Pictures of 320x240 to 1920x1200, in fields and whole, 50 to 120 a second");
  campaign->add_flag("--reduce", options.reduce,
                     "With --replay-move: first leave out all that its wrong tube does not need");
  campaign->add_flag("--without-margin-check", options.without_margin_check,
                     "Self-proof: the box rounds to the nearest tube, and must be found out");
  return campaign;
}

CLI::App* add_devices(CLI::App& app, DevicesOptions& options) {
  CLI::App* const devices = app.add_subcommand(
      "devices",
      "Cameras, GPIO and PWM chips and serial ports of this machine, as the settings of a box name "
      "them");
  devices->add_flag("--network", options.network,
                    "Look for cameras of GigE Vision and USB3 Vision, too: by a broadcast on every "
                    "network of this machine");
  return devices;
}

CLI::App* add_simulate(CLI::App& app, SimulateOptions& options) {
  CLI::App* const simulate = app.add_subcommand(
      "simulate", "A steam generator on the bench: a recording of a scenario, with its truth");
  simulate
      ->add_option("SCENARIO.toml", options.scenario,
                   "What is seen, how the tool moves, what goes wrong (TOML)")
      ->required();
  simulate
      ->add_option("--out", options.out,
                   "Write NAME.y4m, NAME.meta.csv, NAME.events.csv, NAME.truth.csv, "
                   "NAME.centers.csv and NAME.session.toml")
      ->option_text("NAME")
      ->required();
  simulate
      ->add_option("--seed", options.seed,
                   "Seed of noise, clicks and stopping places in the place of the scenario's")
      ->option_text("N")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{2147483647}));
  simulate->add_flag("--window-only", options.window_only,
                     "Draw the search window and a margin alone; the rest stays black");
  return simulate;
}

/// Help and version, or one line about what is wrong.
ExitStatus answer(const CLI::App& app, const CLI::ParseError& problem) {
  if (problem.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    return app.exit(problem) == 0 ? ExitStatus::kDone : ExitStatus::kWrongInput;
  }
  std::string text = problem.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::fprintf(stderr, "tubesight: %s (tubesight --help tells the arguments)\n", text.c_str());
  return ExitStatus::kWrongInput;
}

}  // namespace

ExitStatus run_command_line(int argc, const char* const* argv) {
  CLI::App app("Tubesight, the vision box of a servicing robot for tubesheets", "tubesight");
  app.set_version_flag("--version", version_text("tubesight"),
                       "Print version, commit and arithmetic, and exit");
  app.require_subcommand(1);
  ReplayOptions options;
  std::string scalar = "fixed";
  const CLI::App* const replay = add_replay(app, options, scalar);
  PoseCommandOptions pose_options;
  const CLI::App* const pose = add_pose(app, pose_options);
  LookOptions look_options;
  const CLI::App* const look = add_look(app, look_options);
  CalibrateArguments calibrate_arguments;
  const CLI::App* const calibrate = add_calibrate(app, calibrate_arguments);
  BudgetOptions budget_options;
  const CLI::App* const budget = add_budget(app, budget_options);
  CampaignOptions campaign_options;
  const CLI::App* const campaign = add_campaign(app, campaign_options);
  SimulateOptions simulate_options;
  const CLI::App* const simulate = add_simulate(app, simulate_options);
  DevicesOptions devices_options;
  const CLI::App* const devices = add_devices(app, devices_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return answer(app, problem);
  }
  if (devices->parsed()) {
    return run_devices(devices_options);
  }
  if (pose->parsed()) {
    return run_pose(pose_options);
  }
  if (calibrate->parsed()) {
    return run_calibrate(calibrate_arguments);
  }
  if (budget->parsed()) {
    return run_budget(budget_options);
  }
  if (look->parsed()) {
    return run_look(look_options);
  }
  if (campaign->parsed()) {
    return run_campaign(campaign_options, program_version());
  }
  if (simulate->parsed()) {
    return run_simulate(simulate_options);
  }
  options.scalar = kScalars.at(scalar);
  return replay->parsed() ? run_replay(options) : ExitStatus::kWrongInput;
}

}  // namespace tubesight::board
