#include "board/bench/output/output_paths.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "board/bench/input/recording_input.h"
#include "drivers/files/small_letters.h"

namespace tubesight::board {
namespace {

namespace fs = std::filesystem;

/// Endings of files, small letters; a folder "run.1" or "overlay.d" has none of them.
constexpr auto kFileEndings = std::to_array<std::string_view>(
    {".png", ".jpg", ".jpeg", ".gif",    ".bmp",  ".tif", ".tiff", ".webp", ".pgm",  ".ppm",
     ".avi", ".mp4", ".mkv",  ".mov",    ".webm", ".mpg", ".mpeg", ".m4v",  ".ts",   ".mts",
     ".wmv", ".flv", ".ogv",  ".mxf",    ".y4m",  ".csv", ".toml", ".json", ".txt",  ".pdf",
     ".svg", ".zip", ".xz",   ".y4m.xz", ".gz",   ".tar", ".html", ".log",  ".yaml", ".yml"});

/// Where a path leads, links resolved as far as it exists; empty for what may be shared.
std::string place_of(const std::string& path) {
  if (path == kStandardStream) {
    return path;
  }
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

core::Result<void> open_output(drivers::AtomicFile& file, const std::string& path) {
  return path == kStandardStream ? file.open_standard_output() : file.open(path);
}

bool goes_to_standard_output(std::initializer_list<std::string> paths) {
  return std::find(paths.begin(), paths.end(), kStandardStream) != paths.end();
}

std::string ending_of(const std::string& path) {
  const std::string name = drivers::small_letters(fs::path(path).filename().string());
  constexpr std::string_view kCompressed = ".y4m.xz";
  if (name.ends_with(kCompressed)) {
    return std::string(kCompressed);
  }
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(dot);
}

bool is_named_as_file(const std::string& path) {
  std::error_code ignored;
  return !fs::is_directory(path, ignored) &&
         std::find(kFileEndings.begin(), kFileEndings.end(), ending_of(path)) != kFileEndings.end();
}

std::string why_no_png(const std::string& name, const std::string& path) {
  std::error_code ignored;
  const bool device = fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
  if (path == kStandardStream) {
    return name + ": '-' would be a picture on standard output, expected a name that ends in .png";
  }
  if (device || !is_named_as_file(path) || ending_of(path) == ".png") {
    return {};
  }
  return name + ": '" + path + "' is not named as a PNG picture, expected a name that ends in .png";
}

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
      if (place != kStandardStream && place == place_of(input.path)) {
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
