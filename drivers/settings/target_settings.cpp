#include "drivers/settings/target_settings.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <tuple>

#include "drivers/settings/read_table.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/table_keys.h"

namespace tubesight::drivers {
namespace {

constexpr std::array<std::string_view, 4> kTargetTables = {"camera", "camera_quality", "target",
                                                           "view"};
constexpr std::array<std::string_view, 2> kLatticeWords = {"square", "staggered"};
constexpr std::array<std::string_view, 2> kDotWords = {"bright", "dark"};

constexpr WholeRange kDots{2, 64};
constexpr NumberRange kSpacing{0.05, 1000.0, " mm"};
constexpr NumberRange kDot{0.0, 1000.0, " mm"};
constexpr NumberRange kLens{0.1, 1000.0, " mm"};
constexpr NumberRange kHeight{-10000.0, 10000.0, " mm"};

/// Of `[camera]` what is known before a calibration.
constexpr std::tuple kSensorKeys{std::get<0>(kCameraKeys), std::get<1>(kCameraKeys),
                                 std::get<2>(kCameraKeys), std::get<4>(kCameraKeys),
                                 std::get<5>(kCameraKeys), std::get<6>(kCameraKeys),
                                 std::get<7>(kCameraKeys)};

constexpr std::tuple kSizeKeys{
    WholeKey<TargetSettings>{"rows", kDots, &TargetSettings::rows, Need::kNeeded},
    WholeKey<TargetSettings>{"columns", kDots, &TargetSettings::columns, Need::kNeeded},
    WordKey<TargetSettings, DotLattice>{"lattice", kLatticeWords, &TargetSettings::lattice},
    NumberKey<TargetSettings>{"spacing_mm", kSpacing, &TargetSettings::spacing_mm, Need::kNeeded},
    NumberKey<TargetSettings>{"row_spacing_mm", kSpacing, &TargetSettings::row_spacing_mm},
    NumberKey<TargetSettings>{"dot_mm", kDot, &TargetSettings::dot_mm, Need::kNeeded},
    NumberKey<TargetSettings>{"lens_mm", kLens, &TargetSettings::lens_mm, Need::kOptional, 0.0},
};

void read_camera_sensor(TableReader& table, core::CameraSettings& camera) {
  ignore_keys(table, kCameraKeys);  // a calibrated camera may be calibrated again
  read_keys(table, kSensorKeys, camera);
}

void read_target(TableReader& table, TargetSettings& target) {
  read_keys(table, kSizeKeys, target);
  if (!(target.row_spacing_mm > 0.0)) {
    target.row_spacing_mm = target.spacing_mm;
  }
  std::size_t dots = 0;
  table.optional_word("dots", kDotWords, dots);
  target.bright = dots == 0;
  if (table.sound("dot_mm") && table.sound("spacing_mm") && target.dot_mm >= target.spacing_mm) {
    table.complain("dot_mm", toml_number(target.dot_mm) + ", expected less than the " +
                                 toml_number(target.spacing_mm) + " mm of spacing_mm");
  }
}

void read_view(TableReader& table, const std::filesystem::path& folder, ViewSettings& view) {
  if (table.has("height_mm")) {
    view.staged = table.number("height_mm", kHeight, view.height_mm);
  }
  const auto from_here = [&](const std::string& name) { return (folder / name).string(); };
  if (table.has("points")) {
    std::string name;
    if (table.text("points", name)) {
      view.points = from_here(name);
    }
  }
  if (table.has("images") == table.has("points")) {
    table.ignore("images");
    table.complain(table.has("images") ? "images" : "points",
                   table.has("images")
                       ? "beside points, expected one of the two"
                       : "missing, expected images = [\"...\"] or points = \"...\"");
    return;
  }
  const toml::array* const images = table.list("images", false, "[\"near-0.png\", ...]");
  for (std::size_t i = 0; images != nullptr && i < images->size(); ++i) {
    const auto name = (*images)[i].value<std::string>();
    if (!name || name->empty()) {
      table.complain_entry("images", i, (*images)[i], "not a file's name, expected \"near-0.png\"");
    } else {
      view.images.push_back(from_here(*name));
    }
  }
  if (images != nullptr && images->empty()) {
    table.complain("images", "an empty list, expected pictures");
  }
}

}  // namespace

core::Result<void> load_target(const std::string& path, TargetFile& file, Messages& messages) {
  DiskFiles files;
  return load_target(files, path, file, messages);
}

core::Result<void> load_target(TextFiles& files, const std::string& path, TargetFile& file,
                               Messages& messages) {
  file = {};
  SettingsDocument document;
  document.load(files, path, kTargetTables);
  read_table(document, "camera", true,
             [&](TableReader& table) { read_camera_sensor(table, file.camera); });
  // What stands beside the table of a camera that was calibrated before; of it the camera's name
  // alone is what is known beforehand.
  read_table(document, "camera_quality", false, [&](TableReader& table) {
    read_camera_device(table, file.device);
    for (const std::string_view key : {"id", "made_at", "sigma", "correlation", "verdict"}) {
      table.ignore(key);
    }
  });
  read_table(document, "target", true,
             [&](TableReader& table) { read_target(table, file.target); });
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  read_each_table(document, "view", [&](TableReader& table, std::size_t) {
    ViewSettings view;
    read_view(table, folder, view);
    file.views.push_back(view);
  });
  if (document.find("view") == nullptr && document.complete()) {
    document.problems().push_back(
        {{}, "view: the tables are missing, expected a [[view]] for each height or pose"});
  }
  return document.report(messages);
}

std::string target_text(const TargetFile& file, const std::vector<std::string>& points) {
  TomlWriter toml(TomlManner::kShort);
  toml.table("camera");
  write_keys(toml, kSensorKeys, file.camera);
  if (!file.device.serial.empty() || !file.device.model.empty()) {
    toml.table("camera_quality");
    toml.text("serial", file.device.serial);
    toml.text("model", file.device.model);
  }
  toml.table("target");
  write_keys(toml, kSizeKeys, file.target);
  toml.text("dots", kDotWords[file.target.bright ? 0 : 1]);
  for (std::size_t i = 0; i < file.views.size(); ++i) {
    toml.entry("view");
    toml.text("points", points[i]);
    if (file.views[i].staged) {
      toml.number("height_mm", file.views[i].height_mm);
    }
  }
  return toml.take();
}

}  // namespace tubesight::drivers
