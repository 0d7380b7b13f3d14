#include "board/bench/calibrate_arguments.h"

#include <cstdio>

#include <CLI/CLI.hpp>

#include "board/bench/calibrate/links_command.h"
#include "board/bench/calibrate/zones_command.h"

namespace tubesight::board {
namespace {

void add_base_options(CLI::App& calibrate, CalibrateBaseOptions& base) {
  calibrate.add_flag("--level", base.level,
                     "Of a base: its z axis is square to the sheet, as the robot was installed");
  calibrate.add_flag("--tool-known", base.tool_known,
                     "Of a base: the robot's tool has its x axis where vision's has it");
  calibrate
      .add_option("--sheet", base.sheet,
                  "Of a base: a session whose tubesheet the tool must be known over; default: a "
                  "disc of 3 m around the pairs")
      ->option_text("SESSION.toml");
  calibrate
      .add_option("--touches", base.touches,
                  "Of a base: pairs made by docking, whose base is compared")
      ->option_text("PAIRS.csv");
  calibrate
      .add_option(
          "--picture", base.picture,
          "Of a base, or of zones: draw the sheet with the pairs and how well the tool is known")
      ->option_text("PICTURE.png");
}

void add_camera_options(CLI::App& calibrate, CalibrateCameraOptions& camera) {
  calibrate
      .add_option("--write-points", camera.points,
                  "Of a camera: write what the pictures show as points files, and a target.toml "
                  "that reads them")
      ->option_text("FOLDER");
  calibrate.add_flag("--type", camera.type,
                     "Of a camera: for all of its type that have no calibration of their own");
}

void add_tool_options(CLI::App& calibrate, CalibrateToolOptions& tool) {
  CLI::Option* const dock =
      calibrate
          .add_option("--dock", tool.docks,
                      "Of a tool: a tube it is docked on, and pictures, which are averaged; may "
                      "be repeated")
          ->option_text("ROW,COLUMN...")
          ->expected(2, 1000);
  calibrate
      .add_option("--check", tool.checks,
                  "The same, compared with what the dockings give and not used")
      ->option_text("ROW,COLUMN...")
      ->expected(2, 1000)
      ->needs(dock);
  calibrate
      .add_option("--dock-height-mm", tool.height_mm,
                  "Plane of the tube-ends above the docked tip; default 0")
      ->option_text("H")
      ->check(CLI::Range(-500.0, 500.0))
      ->needs(dock);
  calibrate
      .add_option("--dock-offset-mm", tool.offset_mm,
                  "The docked tip from the tube's centre, on the sheet; without it a clearance "
                  "of 0.15 mm is counted")
      ->option_text("X,Y")
      ->needs(dock);
  calibrate
      .add_option("--heading-deg", tool.heading_deg,
                  "The tool's heading on the sheet in the first docking, a choice; default 0")
      ->option_text("A")
      ->check(CLI::Range(-360.0, 360.0))
      ->needs(dock);
  calibrate
      .add_option("--start", tool.starts,
                  "Tube-ends in the pictures, as of pose: once for all, or for each docking and "
                  "check; default: [start]")
      ->option_text("\"R,C,U,V;...\"")
      ->needs(dock);
}

bool is_for_base(const CalibrateBaseOptions& base) {
  return base.level || base.tool_known || !base.sheet.empty() || !base.touches.empty() ||
         !base.picture.empty();
}

}  // namespace

CLI::App* add_calibrate(CLI::App& app, CalibrateArguments& arguments) {
  CLI::App* const calibrate = app.add_subcommand(
      "calibrate",
      "The camera from views of a dot template, the tool docked on known tubes, or the "
      "robot's base from pairs of poses");
  calibrate
      ->add_option("WHAT", arguments.what,
                   "What is calibrated: camera, tool or base, a base's zones, or an arm's links")
      ->required()
      ->check(CLI::IsMember({"camera", "tool", "base", "zones", "links"}));
  calibrate
      ->add_option(
          "FILE", arguments.file,
          "camera: template and views (TOML); tool: the session, with camera and tubesheet "
          "(TOML); base, zones and links: poses by robot and by vision (CSV)")
      ->required();
  calibrate
      ->add_option("--out", arguments.out,
                   "Write the settings found; those that stood there are kept as OUT.toml.bak")
      ->option_text("OUT.toml");
  add_camera_options(*calibrate, arguments.camera);
  add_tool_options(*calibrate, arguments.tool);
  add_base_options(*calibrate, arguments.base);
  calibrate
      ->add_option("--base", arguments.of_base,
                   "Of zones: a settings file with the [base] that they correct")
      ->option_text("BASE.toml");
  calibrate
      ->add_option("--arm", arguments.arm,
                   "Of links: a settings file whose [robot] has the links on paper")
      ->option_text("ARM.toml");
  return calibrate;
}

ExitStatus run_calibrate(CalibrateArguments& arguments) {
  if (arguments.what != "camera" && (arguments.camera.type || !arguments.camera.points.empty())) {
    std::fprintf(stderr, "--write-points, --type: of a camera alone, expected calibrate camera\n");
    return ExitStatus::kWrongInput;
  }
  if (arguments.what != "zones" && !arguments.of_base.empty()) {
    std::fprintf(stderr, "--base: of zones alone, expected calibrate zones\n");
    return ExitStatus::kWrongInput;
  }
  if (arguments.what != "links" && !arguments.arm.empty()) {
    std::fprintf(stderr, "--arm: of links alone, expected calibrate links\n");
    return ExitStatus::kWrongInput;
  }
  if (arguments.what == "links") {
    return run_calibrate_links({arguments.file, arguments.arm, arguments.out});
  }
  if (arguments.what == "zones") {
    return run_calibrate_zones(
        {arguments.file, arguments.of_base, arguments.base.picture, arguments.out});
  }
  if (arguments.what != "base" && is_for_base(arguments.base)) {
    std::fprintf(stderr,
                 "--level, --tool-known, --sheet, --touches, --picture: of a base alone, expected "
                 "calibrate base\n");
    return ExitStatus::kWrongInput;
  }
  if (arguments.what == "camera") {
    if (!arguments.tool.docks.empty()) {
      std::fprintf(stderr, "--dock: a camera is not docked, expected calibrate tool\n");
      return ExitStatus::kWrongInput;
    }
    arguments.camera.target = arguments.file;
    arguments.camera.out = arguments.out;
    return run_calibrate_camera(arguments.camera);
  }
  if (arguments.what == "base") {
    if (!arguments.tool.docks.empty()) {
      std::fprintf(stderr, "--dock: a base is not docked, expected calibrate tool\n");
      return ExitStatus::kWrongInput;
    }
    arguments.base.pairs = arguments.file;
    arguments.base.out = arguments.out;
    return run_calibrate_base(arguments.base);
  }
  arguments.tool.session = arguments.file;
  arguments.tool.out = arguments.out;
  return run_calibrate_tool(arguments.tool);
}

}  // namespace tubesight::board
