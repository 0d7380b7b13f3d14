#include "board/bench/new_arguments.h"

#include <string>

#include <CLI/CLI.hpp>

namespace tubesight::board {

CLI::App* add_new(CLI::App& app, NewOptions& options) {
  CLI::App* const made = app.add_subcommand(
      "new", "Writes a commented session for a video; asks what the options do not tell");
  made->add_option("SESSION.toml", options.session, "The session to write; not one that is there")
      ->required();
  const auto add = [&](const char* name, std::string& value, const char* help, const char* text) {
    return made->add_option(name, value, help)->option_text(text);
  };
  add("--from", options.video, "A recording, or a still, of the tubesheet", "VIDEO")->required();
  CLI::Option* const camera =
      add("--camera", options.camera,
          "The camera's calibration: settings (TOML), or YAML of OpenCV, ROS or Kalibr", "FILE");
  CLI::Option* const focal =
      add("--efl-mm", options.focal_mm, "In its place: the lens' focal length", "F");
  camera->excludes(focal);
  add("--pixel-um", options.pixel_um, "A pixel on the sensor; default: asked for", "P[,Q]")
      ->needs(focal);
  add("--scan", options.scan, "even-first, odd-first or progressive; default: as the video says",
      "NAME");
  add("--lattice", options.lattice, "square or triangular; default: as the first frame shows",
      "NAME");
  add("--pitch-mm", options.pitch_mm, "From centre to centre of neighbouring tubes", "P");
  add("--bore-mm", options.bore_mm, "Inside diameter of a tube-end", "D");
  add("--weld", options.weld, "flush (default) or fillet", "NAME");
  add("--tool-mm", options.tool_mm,
      "The guidetube's tip seen from the camera; default: below the first click", "X,Y,Z");
  add("--tool-deg", options.tool_deg, "How it is turned: alpha, beta, gamma; default 0,0,0",
      "A,B,C");
  add("--at", options.at,
      "Address of the tube-end in the first frame's middle, for the clicks; default: no clicks",
      "ROW,COLUMN");
  return made;
}

}  // namespace tubesight::board
