#include "board/bench/output_paths.h"

#include <array>
#include <filesystem>
#include <system_error>
#include <vector>

#include "drivers/replay/companion.h"

namespace tubesight::board {
namespace {

namespace fs = std::filesystem;

/// Where a path leads, links resolved as far as it exists; empty for what may be shared.
std::string place_of(const std::string& path) {
  std::error_code ignored;
  if (path.empty() || (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) &&
                       !fs::is_directory(path, ignored))) {
    return {};
  }
  fs::path place = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  if (!place.has_filename()) {
    place = place.parent_path();  // "folder/"
  }
  return place.string();
}

}  // namespace

std::string find_clash(std::span<const NamedPath> inputs, std::span<const NamedPath> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string place = place_of(outputs[i].path);
    if (place.empty()) {
      continue;
    }
    const auto clash = [&](const NamedPath& other) {
      return outputs[i].name + ": '" + outputs[i].path + "' is also " + other.name +
             ", expected a place of its own";
    };
    for (const NamedPath& input : inputs) {
      if (place == place_of(input.path)) {
        return clash(input);
      }
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (place == place_of(outputs[k].path)) {
        return clash(outputs[k]);
      }
    }
  }
  return {};
}

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
  };
  const std::array outputs = {
      NamedPath{"--fields", options.fields},
      NamedPath{"--centers", options.centers},
      NamedPath{"--overlay", options.overlay},
      NamedPath{"--poses", options.poses},
  };
  return find_clash(inputs, outputs);
}

std::string find_output_conflict(const PoseCommandOptions& options) {
  std::vector<NamedPath> inputs = {{"the session", options.session}};
  for (const std::string& image : options.images) {
    inputs.push_back({"a picture", image});
  }
  const std::array outputs = {
      NamedPath{"--csv", options.csv},
      NamedPath{"--covariance", options.covariance},
      NamedPath{"--overlay", options.overlay},
  };
  return find_clash(inputs, outputs);
}

}  // namespace tubesight::board
