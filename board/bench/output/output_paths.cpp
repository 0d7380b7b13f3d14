#include "board/bench/output/output_paths.h"

#include <filesystem>
#include <system_error>

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

}  // namespace tubesight::board
