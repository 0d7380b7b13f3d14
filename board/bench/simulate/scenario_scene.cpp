#include "board/bench/simulate/scenario_scene.h"

#include <array>
#include <string>
#include <utility>

#include "board/bench/simulate/scenario_keys.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {
namespace {

using core::TubeAddress;
using core::rendering::PlugKind;
using core::rendering::Scene;
using drivers::NumberRange;
using drivers::TableReader;

constexpr NumberRange kPositionError{-20.0, 20.0, " mm"};
constexpr NumberRange kAngleError{-5.0, 5.0, " degrees"};
constexpr NumberRange kFocalError{-1.0, 1.0, " mm"};
constexpr NumberRange kCenterError{-50.0, 50.0, " px"};
constexpr NumberRange kScaleError{-0.1, 0.1, ""};
constexpr NumberRange kDistortionError{-0.05, 0.05, " per mm2"};
constexpr NumberRange kPitchError{-0.02, 0.02, ""};
constexpr NumberRange kBoreError{-2.0, 2.0, " mm"};
constexpr NumberRange kDisplacement{-10.0, 10.0, " mm"};

/// True minus told.
void read_calibration_error(TableReader& table, Scene& scene) {
  std::array<double, 3> position{};
  std::array<double, 3> rotation{};
  std::array<double, 2> center{};
  double focal = 0.0;
  double scale = 0.0;
  double distortion = 0.0;
  double pitch = 0.0;
  double bore = 0.0;
  table.optional_numbers("tool_position_mm", kPositionError, position);
  table.optional_numbers("tool_rotation_deg", kAngleError, rotation);
  table.optional_number("focal_length_mm", kFocalError, focal);
  table.optional_numbers("center_px", kCenterError, center);
  table.optional_number("horizontal_scale", kScaleError, scale);
  table.optional_number("distortion_per_mm2", kDistortionError, distortion);
  table.optional_number("pitch_share", kPitchError, pitch);
  table.optional_number("bore_mm", kBoreError, bore);
  for (std::size_t i = 0; i < 3; ++i) {
    scene.tool.position_mm[i] += position[i];
    scene.tool.rotation_deg[i] += rotation[i];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    scene.camera.center_px[i] += center[i];
    scene.sheet.row_step_mm[i] *= 1.0 + pitch;
    scene.sheet.column_step_mm[i] *= 1.0 + pitch;
  }
  scene.camera.focal_length_mm += focal;
  scene.camera.horizontal_scale += scale;
  scene.camera.distortion_per_mm2 += distortion;
  scene.sheet.bore_mm += bore;
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
      table.list("displaced", false, "[{ row = R, column = C, by_mm = [X, Y, Z] }, ...]");
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const toml::table* const entry = (*list)[i].as_table();
    if (entry == nullptr) {
      table.complain_entry(
          "displaced", i, (*list)[i],
          drivers::describe((*list)[i]) + ", expected { row = R, column = C, by_mm = [X, Y, Z] }");
      continue;
    }
    const std::size_t before = table.problems().size();
    TableReader reader(*entry, table.place_of((*list)[i]),
                       table.name() + ".displaced[" + std::to_string(i) + "]", table.problems());
    core::rendering::DisplacedTube tube;
    reader.whole("row", {-9999, 9999}, tube.address.row);
    reader.whole("column", {-9999, 9999}, tube.address.column);
    reader.numbers("by_mm", kDisplacement, tube.by_mm);
    reader.finish();
    if (table.problems().size() != before) {
      continue;
    }
    std::string wrong = drivers::why_no_tube(told, tube.address);
    if (wrong.empty() && !scene.displaced.try_push_back(tube)) {
      wrong = "too many, expected at most " + std::to_string(scene.displaced.capacity());
    }
    if (!wrong.empty()) {
      table.complain_entry("displaced", i, (*list)[i], wrong);
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
  read_tubes(table, "rolled", told, plug_of(PlugKind::kRolled));
  read_tubes(table, "flush", told, plug_of(PlugKind::kFlush));
  read_tubes(table, "voids", told, [&](TubeAddress address) -> std::string {
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
  read_numbers(table, kSheetLookKeys, look);
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
    read_numbers(table, kSensorLookKeys, scene.sensor);
  });
  drivers::read_table(document, "guidetube", false, [&](TableReader& table) {
    read_numbers(table, kGuidetubeLookKeys, scene.guidetube);
  });
}

void read_lamp(drivers::SettingsDocument& document, drivers::SimulatedLight& light,
               core::rendering::LampLook& look) {
  light = {};
  look = {};
  drivers::read_table(document, "lamp", false, [&](TableReader& table) {
    table.optional_whole("lamp_permille", {0, 1000}, light.lamp_permille);
    table.optional_number("pwm_hz", {0.0, 100000.0, " Hz"}, light.pwm_hz);
    table.optional_number("lag_s", {0.0, 60.0, " s"}, light.lag_s);
    table.optional_number("ring", {0.0, 1.0, ""}, light.ring);
    read_numbers(table, kLampLookKeys, look);
  });
}

}  // namespace tubesight::board
