#include "board/bench/replay/replay_options.h"

#include <array>

#include "board/bench/input/recording_input.h"
#include "board/bench/output/output_paths.h"
#include "drivers/ffmpeg/ffmpeg_encoder.h"
#include "drivers/replay/companion.h"

namespace tubesight::board {

namespace {

std::string why_no_overlay(const std::string& out) {
  if (out == kStandardStream) {
    return "--overlay: '-' would be pictures on standard output, expected a folder, or a name that "
           "ends in .mp4, .mkv, .mov or .y4m";
  }
  const bool made = ending_of(out) == ".y4m" || drivers::FfmpegEncoder::encodes(out);
  if (!made && is_named_as_file(out)) {
    return "--overlay: '" + out +
           "' is named as a file of another kind, expected a folder for PNG pictures, or a name "
           "that ends in .mp4, .mkv, .mov or .y4m";
  }
  return {};
}

}  // namespace

std::string find_output_conflict(const ReplayOptions& options) {
  if (std::string wrong = why_no_overlay(options.overlay); !wrong.empty()) {
    return wrong;
  }
  const std::array inputs = {
      NamedPath{"the session", options.session},
      NamedPath{"the recording", options.recording},
      NamedPath{"the recording's meta file",
                drivers::companion_path(options.recording, ".meta.csv")},
      NamedPath{"the recording's event file",
                drivers::companion_path(options.recording, ".events.csv")},
      NamedPath{"the recording's state", drivers::companion_path(options.recording, ".state")},
  };
  const std::array outputs = {
      NamedPath{"--fields", options.fields},   NamedPath{"--centers", options.centers},
      NamedPath{"--overlay", options.overlay}, NamedPath{"--poses", options.poses},
      NamedPath{"--pairs", options.pairs},     NamedPath{"--replies", options.replies},
      NamedPath{"--summary", options.summary},
  };
  return find_clash(inputs, outputs);
}

}  // namespace tubesight::board
