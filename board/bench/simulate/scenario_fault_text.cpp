#include "board/bench/simulate/scenario_fault_text.h"

#include <array>
#include <string>

namespace tubesight::board {
namespace {

using drivers::Fault;
using drivers::FaultKind;
using drivers::TomlWriter;

void write_lamps(TomlWriter& toml, const Fault& fault) {
  constexpr std::int32_t kLamps = 12;
  std::string lamps;
  for (std::int32_t lamp = 1; lamp <= kLamps; ++lamp) {
    if (((static_cast<unsigned>(fault.lamps) >> static_cast<unsigned>(lamp - 1)) & 1U) != 0) {
      lamps += (lamps.empty() ? "" : ", ") + std::to_string(lamp);
    }
  }
  toml.raw("lamps", "[" + lamps + "]");
}

void write_parameters(TomlWriter& toml, const Fault& fault) {
  switch (fault.kind) {
    case FaultKind::kTorn:
    case FaultKind::kSaltPepper: toml.number("share", fault.share); break;
    case FaultKind::kBlack:
    case FaultKind::kLampOut:
    case FaultKind::kLampDrift: toml.number("level", fault.level); break;
    case FaultKind::kSignalLoss: toml.word("damaged", fault.told); break;
    case FaultKind::kCut: toml.word("counted", fault.told); break;
    case FaultKind::kKnock:
      toml.number("angle_deg", fault.angle_deg);
      toml.numbers("axis", fault.axis);
      break;
    case FaultKind::kLampsDead: write_lamps(toml, fault); break;
    case FaultKind::kVibration:
      toml.numbers("amplitude_mm", fault.shake_mm);
      toml.numbers("amplitude_deg", fault.shake_deg);
      toml.number("frequency_hz", fault.frequency_hz);
      break;
    case FaultKind::kJump: toml.numbers("steps", std::array{fault.rows, fault.columns}); break;
    case FaultKind::kEmi:
      toml.number("share", fault.share);
      toml.number("amplitude", fault.amplitude);
      break;
    case FaultKind::kSwapped:
    case FaultKind::kDropped:
    case FaultKind::kRepeated:
    case FaultKind::kSaturated: break;
  }
}

}  // namespace

void write_fault(TomlWriter& toml, const Fault& fault) {
  toml.entry("fault");
  toml.text("kind", std::string(drivers::name_of(fault.kind)).c_str());
  toml.number("at_s", fault.at_s);
  if (fault.for_s > 0.0) {
    toml.number("for_s", fault.for_s);
  }
  write_parameters(toml, fault);
}

}  // namespace tubesight::board
