#include "board/bench/replay/replay_options.h"

#include <array>

#include "board/bench/output/output_paths.h"
#include "drivers/replay/companion.h"

namespace tubesight::board {

std::string find_output_conflict(const ReplayOptions& options) {
  if (options.overlay.ends_with(".y4m.xz")) {
    return "--overlay: '" + options.overlay +
           "' would be a compressed video, expected a folder or a name that ends in .y4m";
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
      NamedPath{"--pairs", options.pairs},
  };
  return find_clash(inputs, outputs);
}

}  // namespace tubesight::board
