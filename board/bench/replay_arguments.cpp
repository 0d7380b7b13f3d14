#include "board/bench/replay_arguments.h"

#include <cstdint>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "board/bench/number_range.h"

namespace tubesight::board {
namespace {

const std::map<std::string, ScalarChoice> kScalars = {
    {"fixed", ScalarChoice::kFixed},
    {"float", ScalarChoice::kFloat},
    {"double", ScalarChoice::kDouble},
};

/// Which part of the recording, and what is asked of it.
void add_replay_choice(CLI::App& replay, ReplayOptions& options) {
  constexpr double kLongest_s = 4e9;
  constexpr std::int64_t kMostFrames = 1'000'000;
  replay
      .add_option("--from", options.from_s,
                  "Begin at this time of the recording; [start] is taken to be clicked there")
      ->option_text("SECONDS")
      ->check(number_between(0.0, kLongest_s));
  replay.add_option("--to", options.to_s, "End at this time of the recording")
      ->option_text("SECONDS")
      ->check(number_between(0.0, kLongest_s));
  replay
      .add_option("--every", options.every,
                  "Every N-th frame alone; of interlaced ones the earlier field")
      ->option_text("N")
      ->check(CLI::Range(std::int64_t{1}, kMostFrames));
  replay.add_flag("--ignore-scan-flag", options.ignore_scan_flag,
                  "Believe [camera] scan where a recording's flag says another order of lines");
  replay.add_flag("--must-track", options.must_track,
                  "End with status 3 when the tracking never started, or was lost");
}

}  // namespace

CLI::App* add_replay(CLI::App& app, ReplayOptions& options) {
  CLI::App* const replay = app.add_subcommand(
      "replay", "The vision box on a recording: tracks, names the tube above the guidetube");
  replay
      ->add_option("SESSION.toml", options.session,
                   "Settings of the session: camera, tool, tubesheet, start (TOML)")
      ->required();
  replay
      ->add_option("RECORDING", options.recording,
                   "Recording: .y4m or .y4m.xz, any video that ffmpeg reads, or - for a y4m stream "
                   "on standard input; its .meta.csv and .events.csv are read when there")
      ->required();
  replay->add_option("--fields", options.fields, "Write one row a field")->option_text("F.csv");
  replay->add_option("--centers", options.centers, "Write one row a tube-end measured")
      ->option_text("C.csv");
  CLI::Option* const overlay =
      replay
          ->add_option("--overlay", options.overlay,
                       "Write what the operator sees, one picture a field: PNG pictures into the "
                       "folder OUT, or a video when OUT ends in .mp4, .mkv, .mov or .y4m")
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
      ->add_option("--replies", options.replies,
                   "Write one row an answer of the box: claims, starts, picks and poses with their "
                   "verdicts")
      ->option_text("R.csv");
  replay->add_option("--summary", options.summary, "Write the summary for machines")
      ->option_text("S.json");
  add_replay_choice(*replay, options);
  replay
      ->add_option_function<std::string>(
          "--scalar", [&options](const std::string& word) { options.scalar = kScalars.at(word); },
          "Arithmetic of the tracking: fixed (default), float or double")
      ->option_text("NAME")
      ->check(CLI::IsMember(kScalars));
  return replay;
}

}  // namespace tubesight::board
