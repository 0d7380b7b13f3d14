#include "board/bench/calibrate_arguments.h"

#include <cstdio>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "board/bench/calibrate/camera_exchange.h"
#include "board/bench/calibrate/links_command.h"
#include "board/bench/calibrate/zones_command.h"
#include "board/bench/number_range.h"

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
          "Draw what was found: of a camera views, residuals and how well the map is known; of a "
          "tool the docked picture; of a base or zones the sheet with the pairs and how well the "
          "tool is known; of links what they are worth over the sheet")
      ->option_text("PICTURE.png");
}

void add_camera_options(CLI::App& calibrate, CalibrateCameraOptions& camera) {
  calibrate
      .add_option("--write-points", camera.points,
                  "Of a camera: write what the pictures show as points files, and a target.toml "
                  "that reads them")
      ->option_text("FOLDER");
  calibrate
      .add_option("--residuals", camera.residuals,
                  "Of a camera: a table of all dots with what each is off by")
      ->option_text("RESIDUALS.csv");
  calibrate.add_flag("--type", camera.type,
                     "Of a camera: for all of its type that have no calibration of their own");
  CLI::Option* const exported =
      calibrate
          .add_option("--export", camera.exported,
                      "Of a camera: write it as ROS reads it, with what its distortion model costs")
          ->option_text("CAMERA.yaml");
  calibrate
      .add_flag("--opencv", camera.opencv,
                "Export as cv::FileStorage writes it, which strict readers of YAML refuse")
      ->needs(exported);
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
                  "The same, compared with what the dockings or points give and not used")
      ->option_text("ROW,COLUMN...")
      ->expected(2, 1000);
  calibrate
      .add_option("--dock-height-mm", tool.height_mm,
                  "Plane of the tube-ends above the docked tip; default 0")
      ->option_text("H")
      ->check(number_between(-500.0, 500.0))
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
      ->check(number_between(-360.0, 360.0))
      ->needs(dock);
  calibrate
      .add_option("--start", tool.starts,
                  "Tube-ends in the pictures, as of pose: once for all, or for each docking and "
                  "check; default: [start]")
      ->option_text("\"R,C,U,V;...\"");
  calibrate
      .add_flag("--free-efl", tool.free_focal,
                "The camera's EFL is found, too; its other parameters are its type's")
      ->needs(dock);
  calibrate
      .add_option("--points", tool.points,
                  "In place of dockings: points on the guidetube, where they are in the tool frame "
                  "and in the picture")
      ->option_text("POINTS.csv");
  calibrate
      .add_option("--guidetube-mm", tool.guidetube,
                  "The guidetube's diameter and visible length: its silhouette is stored, too")
      ->option_text("D,L");
}

bool is_for_tool(const CalibrateToolOptions& tool) {
  return !tool.checks.empty() || !tool.starts.empty() || !tool.points.empty() ||
         !tool.guidetube.empty();
}

void add_template_options(CLI::App& calibrate, CalibrateTemplateOptions& dots) {
  const auto add = [&](const char* name, auto& value, const char* help, const char* text) {
    return calibrate.add_option(name, value, help)
        ->option_text(text)
        ->each([&dots](const std::string&) { dots.given = true; });
  };
  const CLI::Range dot_range(2, 64);
  const CLI::Validator lengths = number_between(0.05, 1000.0);
  add("--rows", dots.target.rows, "Of a template: lines of dots; default 10", "N")
      ->check(dot_range);
  add("--columns", dots.target.columns, "Of a template: dots in a line; default 10", "N")
      ->check(dot_range);
  add("--spacing-mm", dots.target.spacing_mm, "Of a template: from dot to dot; default 8", "S")
      ->check(lengths);
  add("--row-spacing-mm", dots.target.row_spacing_mm,
      "Of a template: from line to line; default: as from dot to dot", "S")
      ->check(lengths);
  add("--dot-mm", dots.target.dot_mm, "Of a template: diameter of a dot; default 4", "D")
      ->check(lengths);
  add("--lattice", dots.lattice, "Of a template: square (default) or staggered", "NAME")
      ->check(CLI::IsMember({"square", "staggered"}));
  add("--dots", dots.dots, "Of a template: dark (default) on bright, or bright on dark", "NAME")
      ->check(CLI::IsMember({"dark", "bright"}));
  add("--paper", dots.paper,
      "Of a template: A4 (default), A3, A2, letter, tabloid, or WIDTH,HEIGHT in mm", "PAPER");
}

bool is_for_base(const CalibrateBaseOptions& base) {
  return base.level || base.tool_known || !base.sheet.empty() || !base.touches.empty();
}

/// Why options of one calibration were given to another; null when all is well.
const char* find_misplaced(const CalibrateArguments& arguments) {
  const std::string& what = arguments.what;
  if (what != "zones" && !arguments.of_base.empty()) {
    return "--base: of zones alone, expected calibrate zones";
  }
  if (what != "links" && !arguments.arm.empty()) {
    return "--arm: of links alone, expected calibrate links";
  }
  if (what != "camera" && !arguments.camera.exported.empty()) {
    return "--export: of a camera alone, expected calibrate camera";
  }
  if (what != "camera" && (arguments.camera.type || !arguments.camera.points.empty() ||
                           !arguments.camera.residuals.empty())) {
    return "--write-points, --residuals, --type: of a camera alone, expected calibrate camera";
  }
  if (what != "camera" && what != "tool" && arguments.ignore_scan_flag) {
    return "--ignore-scan-flag: of a camera or a tool alone, expected one of these";
  }
  if (what != "base" && is_for_base(arguments.base)) {
    return "--level, --tool-known, --sheet, --touches: of a base alone, expected calibrate base";
  }
  if ((what == "import" || what == "template") && !arguments.base.picture.empty()) {
    return "--picture: of a camera, a tool, a base, zones or links, expected one of these";
  }
  if (what != "template" && arguments.dots.given) {
    return "--rows, --columns, --spacing-mm, --row-spacing-mm, --dot-mm, --lattice, --dots, "
           "--paper: of a template alone, expected calibrate template";
  }
  if (what != "tool" && arguments.tool.docks.empty() && is_for_tool(arguments.tool)) {
    return "--check, --start, --points, --guidetube-mm: of a tool alone, expected calibrate tool";
  }
  if (what != "tool" && !arguments.tool.docks.empty()) {
    return what == "camera" ? "--dock: a camera is not docked, expected calibrate tool"
           : what == "base" ? "--dock: a base is not docked, expected calibrate tool"
                            : "--dock: of a tool alone, expected calibrate tool";
  }
  return nullptr;
}

ExitStatus run_template(CalibrateArguments& arguments) {
  if (!arguments.out.empty() || !arguments.of_base.empty() || !arguments.arm.empty() ||
      is_for_base(arguments.base) || !arguments.tool.docks.empty()) {
    std::fprintf(stderr,
                 "calibrate template: writes the file that is named behind it, expected --rows, "
                 "--columns, --spacing-mm, --row-spacing-mm, --dot-mm, --lattice, --dots, --paper "
                 "alone\n");
    return ExitStatus::kWrongInput;
  }
  arguments.dots.out = arguments.file;
  return run_calibrate_template(arguments.dots);
}

}  // namespace

CLI::App* add_calibrate(CLI::App& app, CalibrateArguments& arguments) {
  CLI::App* const calibrate = app.add_subcommand(
      "calibrate",
      "The camera from views of a dot template, the tool docked on known tubes, or the "
      "robot's base from pairs of poses");
  calibrate
      ->add_option("WHAT", arguments.what,
                   "What is calibrated: camera, tool or base, a base's zones, or an arm's links; "
                   "import: a camera of OpenCV or ROS; template: nothing, but dots to print")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(kCalibrations.begin(), kCalibrations.end())));
  calibrate
      ->add_option(
          "FILE", arguments.file,
          "camera: template and views (TOML); import: a camera's file (YAML); tool: the session, "
          "with camera and tubesheet (TOML); base, zones and links: poses by robot and by vision "
          "(CSV); template: the file to write (.svg or .pdf)")
      ->required();
  calibrate
      ->add_option("--out", arguments.out,
                   "Write the settings found; those that stood there are kept as OUT.toml.bak")
      ->option_text("OUT.toml");
  calibrate->add_flag("--ignore-scan-flag", arguments.ignore_scan_flag,
                      "Of a camera or a tool: believe [camera] scan where a recording's flag says "
                      "another order of lines");
  add_camera_options(*calibrate, arguments.camera);
  add_tool_options(*calibrate, arguments.tool);
  add_base_options(*calibrate, arguments.base);
  add_template_options(*calibrate, arguments.dots);
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
  if (const char* const misplaced = find_misplaced(arguments); misplaced != nullptr) {
    std::fprintf(stderr, "%s\n", misplaced);
    return ExitStatus::kWrongInput;
  }
  const std::string& what = arguments.what;
  if (what == "template") {
    return run_template(arguments);
  }
  if (what == "camera") {
    arguments.camera.target = arguments.file;
    arguments.camera.out = arguments.out;
    arguments.camera.ignore_scan_flag = arguments.ignore_scan_flag;
    arguments.camera.picture = std::exchange(arguments.base.picture, {});
    return run_calibrate_camera(arguments.camera);
  }
  if (what == "import") {
    return run_import_camera({arguments.file, arguments.out});
  }
  if (what == "tool") {
    arguments.tool.picture = std::exchange(arguments.base.picture, {});
  }
  if (what == "links") {
    return run_calibrate_links(
        {arguments.file, arguments.arm, arguments.base.picture, arguments.out});
  }
  if (what == "zones") {
    return run_calibrate_zones(
        {arguments.file, arguments.of_base, arguments.base.picture, arguments.out});
  }
  if (what == "base") {
    arguments.base.pairs = arguments.file;
    arguments.base.out = arguments.out;
    return run_calibrate_base(arguments.base);
  }
  arguments.tool.session = arguments.file;
  arguments.tool.out = arguments.out;
  arguments.tool.ignore_scan_flag = arguments.ignore_scan_flag;
  return run_calibrate_tool(arguments.tool);
}

}  // namespace tubesight::board
