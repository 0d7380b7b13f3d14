#include "board/bench/command_line.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "board/bench/replay_command.h"
#include "board/bench/replay_options.h"

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
  replay
      ->add_option("--scalar", scalar,
                   "Arithmetic of the tracking: fixed (default), float or double")
      ->option_text("NAME")
      ->check(CLI::IsMember({"fixed", "float", "double"}));
  return replay;
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
  app.set_version_flag("--version", "tubesight " TUBESIGHT_VERSION);
  app.require_subcommand(1);
  ReplayOptions options;
  std::string scalar = "fixed";
  const CLI::App* const replay = add_replay(app, options, scalar);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return answer(app, problem);
  }
  options.scalar = kScalars.at(scalar);
  return replay->parsed() ? run_replay(options) : ExitStatus::kWrongInput;
}

}  // namespace tubesight::board
