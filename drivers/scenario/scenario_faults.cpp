#include "drivers/scenario/scenario_faults.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/scenario/scenario_keys.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::drivers {
namespace {

using core::TubeAddress;
using drivers::Fault;
using drivers::FaultKind;
using drivers::TableReader;
using drivers::TomlWriter;

constexpr NumberRange kTime{0.0, kLongest_s, " s"};
constexpr NumberRange kShare{0.0, 1.0, ""};
constexpr NumberRange kGrey{0.0, 255.0, ""};
constexpr std::int32_t kLamps = 12;

// The keys of a `[[fault]]`, for its reader and its writer: these two, `kind`, and the parameters.
constexpr NumberKey<Fault> kBegin{"at_s", kTime, &Fault::at_s, Need::kNeeded};
constexpr NumberKey<Fault> kLength{"for_s", kTime, &Fault::for_s, Need::kOptional, 0.0};
constexpr std::string_view kKindKey = "kind";

/// `lamps`: numbers from 1 on, for the bits of Fault::lamps.
constexpr struct LampsKey { std::string_view key = "lamps"; } kLampsKey;
/// `steps`: [rows, columns].
constexpr struct StepsKey { std::string_view key = "steps"; } kStepsKey;

/// Calls `visit` with each key of a kind's parameters.
template <typename Visit>
void for_each_parameter(FaultKind kind, Visit visit) {
  using Number = NumberKey<Fault>;
  using Three = NumbersKey<Fault, 3>;
  using Switch = SwitchKey<Fault>;
  switch (kind) {
    case FaultKind::kTorn:
    case FaultKind::kBlots:
    case FaultKind::kReflections:
    case FaultKind::kGhost:
    case FaultKind::kSaltPepper: visit(Number{"share", kShare, &Fault::share}); break;
    case FaultKind::kBlack: visit(Number{"level", kGrey, &Fault::level}); break;
    case FaultKind::kBlackLevel:
      visit(Number{"level", kGrey, &Fault::level});
      visit(Number{"share", kShare, &Fault::share});
      break;
    case FaultKind::kCovered:
      visit(Number{"level", kGrey, &Fault::level});
      visit(Number{"share", kShare, &Fault::share});
      visit(Switch{"left", &Fault::told});
      break;
    case FaultKind::kLampOut:
    case FaultKind::kLampDrift: visit(Number{"level", kShare, &Fault::level}); break;
    case FaultKind::kSignalLoss: visit(Switch{"damaged", &Fault::told}); break;
    case FaultKind::kCut: visit(Switch{"counted", &Fault::told}); break;
    case FaultKind::kKnock:
      visit(Number{"angle_deg", {-5.0, 5.0, " degrees"}, &Fault::angle_deg});
      visit(Three{"axis", {-1.0, 1.0, ""}, &Fault::axis});
      break;
    case FaultKind::kLampsDead: visit(kLampsKey); break;
    case FaultKind::kVibration:
      visit(Three{"amplitude_mm", {0.0, 20.0, " mm"}, &Fault::shake_mm});
      visit(Three{"amplitude_deg", {0.0, 5.0, " degrees"}, &Fault::shake_deg});
      visit(Number{"frequency_hz", {0.1, 500.0, " Hz"}, &Fault::frequency_hz});
      break;
    case FaultKind::kPoseStep:
      visit(Three{"by_mm", {-20.0, 20.0, " mm"}, &Fault::shake_mm});
      visit(Three{"by_deg", {-20.0, 20.0, " degrees"}, &Fault::shake_deg});
      break;
    case FaultKind::kJump:
    case FaultKind::kOtherCamera: visit(kStepsKey); break;
    case FaultKind::kEmi:
      visit(Number{"share", kShare, &Fault::share});
      visit(Number{"amplitude", kGrey, &Fault::amplitude});
      break;
    case FaultKind::kHeld:
      visit(Number{"share", kShare, &Fault::share});
      visit(Number{"noise", {0.0, 20.0, ""}, &Fault::amplitude});
      break;
    case FaultKind::kCompressed: visit(Number{"step", {1.0, 32.0, ""}, &Fault::amplitude}); break;
    case FaultKind::kJitter:
      visit(Number{"waver_ms", {0.0, 100.0, " ms"}, &Fault::waver_ms});
      break;
    case FaultKind::kSwapped:
    case FaultKind::kDropped:
    case FaultKind::kRepeated:
    case FaultKind::kSaturated:
    case FaultKind::kSkip:
    case FaultKind::kFrozen: break;
  }
}

void read_key(TableReader& table, LampsKey key, Fault& fault) {
  constexpr const char* kExpected = "numbers of lamps, 1 to 12";
  const toml::array* const lamps = table.list(key.key, true, kExpected);
  if (lamps == nullptr) {
    return;
  }
  for (std::size_t i = 0; i < lamps->size(); ++i) {
    const auto* const number = (*lamps)[i].as_integer();
    if (number == nullptr || number->get() < 1 || number->get() > kLamps) {
      table.complain_entry(key.key, i, (*lamps)[i],
                           drivers::describe((*lamps)[i]) + ", expected " + kExpected);
      continue;
    }
    fault.lamps = static_cast<std::uint16_t>(fault.lamps | (1U << (number->get() - 1)));
  }
  if (lamps->empty()) {
    table.complain(key.key, std::string("an empty list, expected ") + kExpected);
  }
}

void write_key(TomlWriter& toml, LampsKey key, const Fault& fault) {
  std::vector<std::int32_t> lamps;
  for (std::int32_t lamp = 1; lamp <= kLamps; ++lamp) {
    if (((static_cast<unsigned>(fault.lamps) >> static_cast<unsigned>(lamp - 1)) & 1U) != 0) {
      lamps.push_back(lamp);
    }
  }
  toml.wholes(key.key, lamps);
}

void read_key(TableReader& table, StepsKey key, Fault& fault) {
  std::array<std::int32_t, 2> steps{fault.rows, fault.columns};
  table.optional_wholes(key.key, {-50, 50}, steps);
  fault.rows = steps[0];
  fault.columns = steps[1];
}

void write_key(TomlWriter& toml, StepsKey key, const Fault& fault) {
  toml.wholes(key.key, std::array{fault.rows, fault.columns});
}

/// What the parameters of a kind are when they are left out.
Fault usual(FaultKind kind) {
  Fault fault;
  fault.kind = kind;
  switch (kind) {
    case FaultKind::kBlack: fault.level = 4.0; break;
    case FaultKind::kSignalLoss: fault.told = false; break;
    case FaultKind::kKnock:
      fault.axis = {0.0, 1.0, 0.0};
      fault.angle_deg = 0.3;
      break;
    case FaultKind::kVibration: fault.shake_mm = {0.2, 0.2, 0.0}; break;
    case FaultKind::kPoseStep: fault.shake_deg = {0.0, 0.0, 4.0}; break;
    case FaultKind::kJump:
    case FaultKind::kOtherCamera: fault.columns = 1; break;
    case FaultKind::kEmi:
      fault.share = 0.05;
      fault.amplitude = 60.0;
      break;
    case FaultKind::kSaltPepper: fault.share = 0.01; break;
    case FaultKind::kHeld: fault.share = 1.0; break;
    case FaultKind::kCompressed: fault.amplitude = 4.0; break;
    case FaultKind::kJitter: fault.waver_ms = 5.0; break;
    case FaultKind::kBlots:
    case FaultKind::kReflections: fault.share = 0.05; break;
    case FaultKind::kGhost: fault.share = 0.3; break;
    case FaultKind::kBlackLevel: fault.level = 64.0; break;
    case FaultKind::kCovered:
      fault.share = 0.3;
      fault.level = 150.0;
      fault.told = false;
      break;
    default: break;
  }
  return fault;
}

/// What the values alone cannot tell.
void check_parameters(TableReader& table, const FaultContext& context, const Fault& fault) {
  if (fault.kind == FaultKind::kKnock && table.sound("axis") &&
      std::hypot(fault.axis[0], fault.axis[1], fault.axis[2]) < 1e-3) {
    table.complain("axis", "no direction, expected a vector x, y, z of the camera frame");
  }
  if (fault.kind == FaultKind::kSwapped && !context.interlaced) {
    table.complain(kKindKey, "swapped, but the camera is progressive, expected another kind");
  }
  const TubeAddress by{fault.rows, fault.columns};
  const bool steps = fault.kind == FaultKind::kJump || fault.kind == FaultKind::kOtherCamera;
  if (steps && table.sound(kStepsKey.key)) {
    if (const std::string wrong = drivers::why_no_move(*context.sheet, by); !wrong.empty()) {
      table.complain(kStepsKey.key, wrong);
    }
  }
}

void read_time(TableReader& table, const FaultContext& context, Fault& fault) {
  drivers::read_key(table, kBegin, fault);
  drivers::read_key(table, kLength, fault);
  const bool begins = table.sound(kBegin.key);
  const bool lasts = table.sound(kLength.key);
  const std::string limit = "expected within the recording's " +
                            std::to_string(std::llround(context.length_s * 1000.0)) + " ms";
  if (context.length_s <= 0.0) {
    return;
  }
  constexpr double kNothing_s = 1e-6;
  if (begins && fault.at_s >= context.length_s) {
    table.complain(kBegin.key, "after the recording's end, " + limit);
  } else if (begins && lasts && fault.at_s + fault.for_s > context.length_s + kNothing_s) {
    table.complain(kLength.key, "ends after the recording, " + limit);
  }
}

/// A camera shows one picture in the place of its own, not two at a time.
void check_picture(TableReader& table, const Fault& fault, const std::vector<Fault>& before) {
  const auto shows_another = [](const Fault& one) {
    return one.kind == FaultKind::kFrozen || one.kind == FaultKind::kOtherCamera;
  };
  const auto end_s = [](const Fault& one) {
    return one.for_s > 0.0 ? one.at_s + one.for_s : kLongest_s;
  };
  if (!shows_another(fault) || !table.sound(kBegin.key) || !table.sound(kLength.key)) {
    return;
  }
  for (const Fault& other : before) {
    if (shows_another(other) && fault.at_s < end_s(other) && other.at_s < end_s(fault)) {
      table.complain(kKindKey, std::string(drivers::name_of(fault.kind)) +
                                   " while a fault before, " +
                                   std::string(drivers::name_of(other.kind)) +
                                   ", is at work, expected one after the other");
      return;
    }
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
    if (!table.word(kKindKey, drivers::kFaultWords, kind)) {
      // Which keys belong to it cannot be told.
      for (std::size_t any = 0; any < drivers::kFaultWords.size(); ++any) {
        for_each_parameter(static_cast<FaultKind>(any),
                           [&](const auto& key) { table.ignore(key.key); });
      }
      return;
    }
    const Fault read = fault;
    fault = usual(static_cast<FaultKind>(kind));
    fault.at_s = read.at_s;
    fault.for_s = read.for_s;
    for_each_parameter(fault.kind, [&](const auto& key) { read_key(table, key, fault); });
    check_parameters(table, context, fault);
    const bool needs_length = fault.kind == FaultKind::kVibration ||
                              fault.kind == FaultKind::kLampDrift || fault.kind == FaultKind::kSkip;
    if (needs_length && fault.for_s <= 0.0) {
      table.complain(kLength.key, "missing or 0, expected how long it lasts");
    }
    check_picture(table, fault, faults);
    faults.push_back(fault);
    places.push_back(
        {table.name(), table.place_of("at_s"), table.place_of("for_s"), table.place_of("steps")});
  });
}

void write_fault(TomlWriter& toml, const Fault& fault) {
  toml.entry("fault");
  toml.text(kKindKey, drivers::name_of(fault.kind));
  drivers::write_key(toml, kBegin, fault);
  drivers::write_key(toml, kLength, fault);
  for_each_parameter(fault.kind, [&](const auto& key) { write_key(toml, key, fault); });
}

}  // namespace tubesight::drivers
