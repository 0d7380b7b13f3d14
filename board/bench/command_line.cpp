#include "board/bench/command_line.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "board/bench/argument_words.h"
#include "board/bench/budget/budget_command.h"
#include "board/bench/calibrate_arguments.h"
#include "board/bench/campaign/campaign_command.h"
#include "board/bench/campaign_arguments.h"
#include "board/bench/devices/devices_command.h"
#include "board/bench/journal_arguments.h"
#include "board/bench/look/look_command.h"
#include "board/bench/new_arguments.h"
#include "board/bench/number_range.h"
#include "board/bench/output/text_output.h"
#include "board/bench/pose/pose_command.h"
#include "board/bench/pose/pose_options.h"
#include "board/bench/replay/replay_command.h"
#include "board/bench/replay_arguments.h"
#include "board/bench/simulate/simulate_command.h"
#include "board/bench/simulate/simulate_options.h"
#include "board/bench/talk_arguments.h"
#include "board/box/version.h"
#include "drivers/files/commit_together.h"

namespace tubesight::board {
namespace {

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
                   "Stills: PNG, PGM or what ffmpeg reads; or recordings and videos")
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
  pose->add_flag("--ignore-scan-flag", options.ignore_scan_flag,
                 "Believe [camera] scan where a recording's flag says another order of lines");
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
                   "Stills: PNG, PGM or what ffmpeg reads; or recordings and videos, their first "
                   "frame")
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

ExitStatus refuse(const std::string& text) {
  std::fprintf(stderr, "tubesight: %s (tubesight help tells more)\n", text.c_str());
  return ExitStatus::kWrongInput;
}

/// Help and version, or one line about what is wrong.
ExitStatus answer(const CLI::App& app, const CLI::ParseError& problem) {
  if (problem.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    return app.exit(problem) == 0 ? ExitStatus::kDone : ExitStatus::kWrongInput;
  }
  return refuse(explain_refusal(app, problem));
}

/// The arguments as CLI11 takes them, the last one first: `help COMMAND` is `COMMAND --help`.
std::vector<std::string> arguments_of(int argc, const char* const* argv) {
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    arguments.emplace_back(argv[i]);
  }
  if (!arguments.empty() && arguments.front() == "help") {
    arguments.erase(arguments.begin());
    arguments.insert(arguments.begin() + (arguments.empty() ? 0 : 1), "--help");
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

/// Runs a command whose outputs are put in their places together when it is done, or not at all:
/// when an argument or a file is wrong, or when one of them cannot be written.
template <typename Command>
ExitStatus put_in_place_together(Command command) {
  drivers::CommitTogether outputs;
  const ExitStatus status = command();
  if (status == ExitStatus::kWrongInput) {
    return status;
  }
  if (!outputs.commit()) {
    if (!outputs.message().empty()) {
      tell(outputs.message());
    }
    return ExitStatus::kJobFailed;
  }
  return status;
}

/// All commands with their options, and which of them was named.
class Commands {
 public:
  explicit Commands(CLI::App& app)
      : made_(add_new(app, new_options_)),
        replay_(add_replay(app, replay_options_)),
        pose_(add_pose(app, pose_options_)),
        look_(add_look(app, look_options_)),
        calibrate_(add_calibrate(app, calibrate_arguments_)),
        budget_(add_budget(app, budget_options_)),
        campaign_(add_campaign(app, campaign_options_)),
        simulate_(add_simulate(app, simulate_options_)),
        devices_(add_devices(app, devices_options_)),
        journal_(add_journal(app, journal_options_)) {
    // What `devices` lists is all that it does.
    for (CLI::App* const command :
         app.get_subcommands([this](const CLI::App* each) { return each != devices_; })) {
      add_talk(*command);
    }
  }

  ExitStatus run() {
    if (campaign_->parsed()) {  // its progress is kept while it runs
      return run_campaign(campaign_options_, program_version());
    }
    return put_in_place_together([this] { return run_named(); });
  }

 private:
  ExitStatus run_named() {
    if (made_->parsed()) {
      return run_new(new_options_);
    }
    if (devices_->parsed()) {
      return run_devices(devices_options_);
    }
    if (journal_->parsed()) {
      return run_journal(journal_options_);
    }
    if (pose_->parsed()) {
      return run_pose(pose_options_);
    }
    if (calibrate_->parsed()) {
      return run_calibrate(calibrate_arguments_);
    }
    if (budget_->parsed()) {
      return run_budget(budget_options_);
    }
    if (look_->parsed()) {
      return run_look(look_options_);
    }
    if (simulate_->parsed()) {
      return run_simulate(simulate_options_);
    }
    return replay_->parsed() ? run_replay(replay_options_) : ExitStatus::kWrongInput;
  }

  NewOptions new_options_;
  ReplayOptions replay_options_;
  PoseCommandOptions pose_options_;
  LookOptions look_options_;
  CalibrateArguments calibrate_arguments_;
  BudgetOptions budget_options_;
  CampaignOptions campaign_options_;
  SimulateOptions simulate_options_;
  DevicesOptions devices_options_;
  JournalOptions journal_options_;
  const CLI::App* made_;
  const CLI::App* replay_;
  const CLI::App* pose_;
  const CLI::App* look_;
  const CLI::App* calibrate_;
  const CLI::App* budget_;
  const CLI::App* campaign_;
  const CLI::App* simulate_;
  const CLI::App* devices_;
  const CLI::App* journal_;
};

}  // namespace

ExitStatus run_command_line(int argc, const char* const* argv) {
  CLI::App app("Tubesight, the vision box of a servicing robot for tubesheets", "tubesight");
  app.set_version_flag("-V,--version", version_text("tubesight"),
                       "Print version, commit and arithmetic, and exit");
  app.require_subcommand(1);
  const auto commands = std::make_unique<Commands>(app);
  std::vector<std::string> arguments = arguments_of(argc, argv);
  if (!arguments.empty() && !arguments.back().starts_with('-')) {
    if (const std::string wrong = why_no_command(app, arguments.back()); !wrong.empty()) {
      return refuse(wrong);
    }
  }
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& problem) {
    return answer(app, problem);
  }
  if (const std::string wrong = find_wrong_arguments(*app.get_subcommands().front());
      !wrong.empty()) {
    return refuse(wrong);
  }
  return commands->run();
}

}  // namespace tubesight::board
