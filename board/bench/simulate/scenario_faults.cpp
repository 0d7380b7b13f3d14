#include "board/bench/simulate/scenario_faults.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "core/tubesheet/addresses.h"
#include "core/tubesheet/tubesheet_setup.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {
namespace {

using core::TubeAddress;
using drivers::Fault;
using drivers::FaultKind;
using drivers::NumberRange;
using drivers::TableReader;

constexpr double kLongest_s = 86400.0;
constexpr NumberRange kTime{0.0, kLongest_s, " s"};
constexpr NumberRange kShare{0.0, 1.0, ""};
constexpr NumberRange kGrey{0.0, 255.0, ""};
constexpr NumberRange kKnock{-5.0, 5.0, " degrees"};
constexpr NumberRange kDirection{-1.0, 1.0, ""};
constexpr NumberRange kShake_mm{0.0, 20.0, " mm"};
constexpr NumberRange kShake_deg{0.0, 5.0, " degrees"};
constexpr NumberRange kFrequency{0.1, 500.0, " Hz"};
constexpr drivers::WholeRange kSteps{-50, 50};
constexpr std::int32_t kLamps = 12;

void read_lamps(TableReader& table, Fault& fault) {
  constexpr const char* kExpected = "numbers of lamps, 1 to 12";
  const toml::array* const lamps = table.list("lamps", true, kExpected);
  if (lamps == nullptr) {
    return;
  }
  for (std::size_t i = 0; i < lamps->size(); ++i) {
    const auto* const number = (*lamps)[i].as_integer();
    if (number == nullptr || number->get() < 1 || number->get() > kLamps) {
      table.complain_entry("lamps", i, (*lamps)[i],
                           drivers::describe((*lamps)[i]) + ", expected " + kExpected);
      continue;
    }
    fault.lamps = static_cast<std::uint16_t>(fault.lamps | (1U << (number->get() - 1)));
  }
  if (lamps->empty()) {
    table.complain("lamps", std::string("an empty list, expected ") + kExpected);
  }
}

void read_knock(TableReader& table, Fault& fault) {
  fault.axis = {0.0, 1.0, 0.0};
  fault.angle_deg = 0.3;
  table.optional_number("angle_deg", kKnock, fault.angle_deg);
  if (table.optional_numbers("axis", kDirection, fault.axis) &&
      std::hypot(fault.axis[0], fault.axis[1], fault.axis[2]) < 1e-3) {
    table.complain("axis", "no direction, expected a vector x, y, z of the camera frame");
  }
}

void read_jump(TableReader& table, const FaultContext& context, Fault& fault) {
  std::array<std::int32_t, 2> steps{0, 1};
  if (!table.optional_wholes("steps", kSteps, steps)) {
    return;
  }
  fault.rows = steps[0];
  fault.columns = steps[1];
  const TubeAddress by{steps[0], steps[1]};
  if (core::tubesheet::is_symmetry(*context.sheet, by)) {
    return;
  }
  if (context.sheet->odd_row_shift != 0.0 && core::tubesheet::in_odd_row(by)) {
    table.complain("steps", "an odd number of rows, expected an even one on this sheet");
  } else {
    table.complain("steps", "an odd sum of rows and columns, expected an even one on this sheet");
  }
}

void read_vibration(TableReader& table, Fault& fault) {
  fault.shake_mm = {0.2, 0.2, 0.0};
  table.optional_numbers("amplitude_mm", kShake_mm, fault.shake_mm);
  table.optional_numbers("amplitude_deg", kShake_deg, fault.shake_deg);
  table.optional_number("frequency_hz", kFrequency, fault.frequency_hz);
}

/// The parameters of each kind, with their defaults.
void read_parameters(TableReader& table, const FaultContext& context, Fault& fault) {
  switch (fault.kind) {
    case FaultKind::kTorn: table.optional_number("share", kShare, fault.share); break;
    case FaultKind::kBlack:
      fault.level = 4.0;
      table.optional_number("level", kGrey, fault.level);
      break;
    case FaultKind::kSignalLoss:
      fault.told = false;
      table.optional_switch("damaged", fault.told);
      break;
    case FaultKind::kCut: table.optional_switch("counted", fault.told); break;
    case FaultKind::kKnock: read_knock(table, fault); break;
    case FaultKind::kLampOut:
    case FaultKind::kLampDrift: table.optional_number("level", kShare, fault.level); break;
    case FaultKind::kLampsDead: read_lamps(table, fault); break;
    case FaultKind::kVibration: read_vibration(table, fault); break;
    case FaultKind::kJump: read_jump(table, context, fault); break;
    case FaultKind::kEmi:
      fault.share = 0.05;
      fault.amplitude = 60.0;
      table.optional_number("share", kShare, fault.share);
      table.optional_number("amplitude", kGrey, fault.amplitude);
      break;
    case FaultKind::kSaltPepper:
      fault.share = 0.01;
      table.optional_number("share", kShare, fault.share);
      break;
    case FaultKind::kSwapped:
      if (!context.interlaced) {
        table.complain("kind", "swapped, but the camera is progressive, expected another kind");
      }
      break;
    case FaultKind::kDropped:
    case FaultKind::kRepeated:
    case FaultKind::kSaturated: break;
  }
}

void read_time(TableReader& table, const FaultContext& context, Fault& fault) {
  const bool begins = table.number("at_s", kTime, fault.at_s);
  const bool lasts = table.optional_number("for_s", kTime, fault.for_s);
  const std::string limit = "expected within the recording's " +
                            std::to_string(std::llround(context.length_s * 1000.0)) + " ms";
  if (context.length_s <= 0.0) {
    return;
  }
  constexpr double kNothing_s = 1e-6;
  if (begins && fault.at_s >= context.length_s) {
    table.complain("at_s", "after the recording's end, " + limit);
  } else if (begins && lasts && fault.at_s + fault.for_s > context.length_s + kNothing_s) {
    table.complain("for_s", "ends after the recording, " + limit);
  }
}

}  // namespace

bool read_faults(drivers::SettingsDocument& document, const FaultContext& context,
                 std::vector<Fault>& faults, std::vector<FaultPlaces>& places) {
  faults.clear();
  places.clear();
  return drivers::read_each_table(document, "fault", [&](TableReader& table, std::size_t) {
    Fault fault;
    std::size_t kind = 0;
    read_time(table, context, fault);
    if (!table.word("kind", drivers::kFaultWords, kind)) {
      // Which keys belong to it cannot be told.
      for (const char* const key :
           {"share", "level", "amplitude", "angle_deg", "axis", "lamps", "amplitude_mm",
            "amplitude_deg", "frequency_hz", "steps", "damaged", "counted"}) {
        table.ignore(key);
      }
      return;
    }
    fault.kind = static_cast<FaultKind>(kind);
    read_parameters(table, context, fault);
    if ((fault.kind == FaultKind::kVibration || fault.kind == FaultKind::kLampDrift) &&
        fault.for_s <= 0.0) {
      table.complain("for_s", "missing or 0, expected how long it lasts");
    }
    faults.push_back(fault);
    places.push_back(
        {table.name(), table.place_of("at_s"), table.place_of("for_s"), table.place_of("steps")});
  });
}

}  // namespace tubesight::board
