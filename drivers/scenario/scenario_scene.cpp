#include "drivers/scenario/scenario_scene.h"

#include <array>
#include <string>
#include <utility>

#include "core/tubesheet/sheet_places.h"
#include "drivers/files/decimal.h"
#include "drivers/scenario/scenario_keys.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::drivers {
namespace {

using core::TubeAddress;
using core::rendering::PlugKind;
using core::rendering::Scene;
using drivers::TableReader;

/// True minus told.
void read_calibration_error(TableReader& table, Scene& scene) {
  CalibrationError error;
  drivers::read_keys(table, kCalibrationErrorKeys, error);
  for (std::size_t i = 0; i < 3; ++i) {
    scene.tool.position_mm[i] += error.tool_position_mm[i];
    scene.tool.rotation_deg[i] += error.tool_rotation_deg[i];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    scene.camera.center_px[i] += error.center_px[i];
  }
  core::tubesheet::stretch(scene.sheet, 1.0 + error.pitch_share);
  scene.camera.focal_length_mm += error.focal_length_mm;
  scene.camera.horizontal_scale += error.horizontal_scale;
  scene.camera.distortion_per_mm2 += error.distortion_per_mm2;
  scene.sheet.bore_mm += error.bore_mm;
  std::string wrong;
  if (scene.camera.focal_length_mm < 0.1 || scene.sheet.bore_mm < 1.0) {
    table.complain(scene.sheet.bore_mm < 1.0 ? "bore_mm" : "focal_length_mm",
                   "nothing is left of it, expected a smaller error");
  } else if (wrong = drivers::why_picture_folds(scene.camera); !wrong.empty()) {
    table.complain("distortion_per_mm2", wrong);
  } else if (wrong = drivers::why_bore_too_wide(scene.sheet); !wrong.empty()) {
    table.complain("bore_mm", wrong);
  }
}

/// Calls `take(address)` for each address of a list; it says what is wrong with it.
template <typename Take>
void read_tubes(TableReader& table, std::string_view key, const core::TubesheetSettings& sheet,
                Take take) {
  const toml::array* const list = table.list(key, false, "[[row, column], ...]");
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    TubeAddress address;
    std::string wrong;
    if (!drivers::read_address((*list)[i], address)) {
      wrong = drivers::why_no_address((*list)[i]);
    } else {
      wrong = drivers::why_no_tube(sheet, address);
      wrong = wrong.empty() ? take(address) : wrong;
    }
    if (!wrong.empty()) {
      table.complain_entry(key, i, (*list)[i], wrong);
    }
  }
}

void read_displaced(TableReader& table, const core::TubesheetSettings& told, Scene& scene) {
  const toml::array* const list =
      table.list(kDisplacedKey, false, "[{ row = R, column = C, by_mm = [X, Y, Z] }, ...]");
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const toml::table* const entry = (*list)[i].as_table();
    if (entry == nullptr) {
      table.complain_entry(
          kDisplacedKey, i, (*list)[i],
          drivers::describe((*list)[i]) + ", expected { row = R, column = C, by_mm = [X, Y, Z] }");
      continue;
    }
    const std::size_t before = table.problems().size();
    TableReader reader(*entry, table.place_of((*list)[i]),
                       table.name() + ".displaced[" + std::to_string(i) + "]", table.problems());
    core::rendering::DisplacedTube tube;
    drivers::read_keys(reader, drivers::kAddressKeys, tube.address);
    drivers::read_keys(reader, kDisplacementKeys, tube);
    reader.finish();
    if (table.problems().size() != before) {
      continue;
    }
    std::string wrong = drivers::why_no_tube(told, tube.address);
    if (wrong.empty() && !scene.displaced.try_push_back(tube)) {
      wrong = "too many, expected at most " + std::to_string(scene.displaced.capacity());
    }
    if (!wrong.empty()) {
      table.complain_entry(kDisplacedKey, i, (*list)[i], wrong);
    }
  }
}

/// What stands on the sheet beside what the box is told.
void read_sheet(TableReader& table, const core::TubesheetSettings& told, Scene& scene) {
  const auto plug_of = [&](PlugKind kind) {
    return [&scene, kind](TubeAddress address) -> std::string {
      for (const core::rendering::Plug& plug : scene.plugs) {
        if (plug.address == address) {
          return drivers::address_text(address) + " is listed twice, expected one plug a tube";
        }
      }
      return scene.plugs.try_push_back({address, kind})
                 ? ""
                 : "too many plugs, expected at most " + std::to_string(scene.plugs.capacity());
    };
  };
  for (const PlugsKey& plugs : kPlugsKeys) {
    read_tubes(table, plugs.key, told, plug_of(plugs.kind));
  }
  read_tubes(table, kVoidsKey, told, [&](TubeAddress address) -> std::string {
    for (const TubeAddress plugged : told.plugged) {
      if (plugged == address) {
        return drivers::address_text(address) + " is plugged as well, expected one of them";
      }
    }
    return scene.sheet.missing.try_push_back(address)
               ? ""
               : "too many tubes are missing, expected at most " +
                     std::to_string(scene.sheet.missing.capacity());
  });
  read_displaced(table, told, scene);
}

void read_look(TableReader& table, core::rendering::SheetLook& look) {
  drivers::read_keys(table, kSheetLookKeys, look);
  if (look.land_mm <= look.fillet_mm) {
    return;
  }
  // One of them may be the default: the mistake is told where the other stands.
  if (table.has("land_mm")) {
    table.complain("land_mm", drivers::number_text(look.land_mm) + ", expected at most the " +
                                  drivers::number_text(look.fillet_mm) + " mm of fillet_mm");
  } else {
    table.complain("fillet_mm", drivers::number_text(look.fillet_mm) + ", expected at least the " +
                                    drivers::number_text(look.land_mm) + " mm of land_mm");
  }
}

}  // namespace

void read_scene(drivers::SettingsDocument& document, const core::SessionSettings& told,
                Scene& scene) {
  scene.camera = told.camera;
  scene.tool = told.tool;
  scene.sheet = told.tubesheet;
  scene.look = {};
  scene.sensor = {};
  scene.guidetube = {};
  scene.plugs.clear();
  scene.displaced.clear();
  drivers::read_table(document, "calibration_error", false,
                      [&](TableReader& table) { read_calibration_error(table, scene); });
  drivers::read_table(document, "sheet", false,
                      [&](TableReader& table) { read_sheet(table, told.tubesheet, scene); });
  drivers::read_table(document, "look", false,
                      [&](TableReader& table) { read_look(table, scene.look); });
  drivers::read_table(document, "sensor", false, [&](TableReader& table) {
    drivers::read_keys(table, kSensorLookKeys, scene.sensor);
  });
  drivers::read_table(document, "guidetube", false, [&](TableReader& table) {
    drivers::read_keys(table, kGuidetubeLookKeys, scene.guidetube);
  });
}

void read_lamp(drivers::SettingsDocument& document, drivers::SimulatedLight& light,
               core::rendering::LampLook& look) {
  light = {};
  look = {};
  drivers::read_table(document, "lamp", false, [&](TableReader& table) {
    drivers::read_keys(table, kLightKeys, light);
    drivers::read_keys(table, kLampLookKeys, look);
  });
}

}  // namespace tubesight::drivers
