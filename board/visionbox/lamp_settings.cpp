#include "board/visionbox/lamp_settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "board/visionbox/refused_keys.h"

namespace tubesight::board {
namespace {

using drivers::TableReader;

constexpr std::array<std::string_view, 3> kKinds = {"none", "pwm", "gpio"};
constexpr std::array<std::string_view, 2> kPwmKeys = {"channel", "inverted"};
constexpr std::array<std::string_view, 3> kGpioKeys = {"lines", "active_low", "priority"};
constexpr std::array<std::string_view, 7> kSharedKeys = {
    "chip",          "frequency_hz",   "soft_ms",        "full_for_s",
    "rest_permille", "silent_after_s", "silent_permille"};

constexpr std::array<std::string_view, 2> kRuleKeys = {"automatic", "pattern"};

constexpr drivers::WholeRange kChannel{0, 255};
constexpr drivers::WholeRange kPwmFrequency{100, 100'000};
/// A thread is to be woken twice in each period.
constexpr drivers::WholeRange kGpioFrequency{100, 5'000};
constexpr drivers::WholeRange kPriority{0, 99};
constexpr drivers::WholeRange kSoft{0, 10'000};
constexpr drivers::WholeRange kFullFor{0, 3'600};
/// Full light would be no rest, and nothing would be spared.
constexpr drivers::WholeRange kRest{0, 999};
constexpr drivers::WholeRange kSilentAfter{0, 86'400};

void read_care(TableReader& table, LampCare& care) {
  auto soft_ms = static_cast<std::int32_t>(care.soft.count());
  std::int32_t full_for_s = 0;
  table.optional_whole("soft_ms", kSoft, soft_ms);
  table.optional_whole("full_for_s", kFullFor, full_for_s);
  care.soft = std::chrono::milliseconds(soft_ms);
  care.full_for = std::chrono::seconds(full_for_s);
  if (full_for_s > 0) {
    table.whole("rest_permille", kRest, care.rest_permille);
  } else if (table.sound("full_for_s")) {
    refuse_keys(table, std::array<std::string_view, 1>{"rest_permille"},
                "of a time at full power, which needs full_for_s");
  } else {
    table.ignore("rest_permille");
  }
}

void read_silent_link(TableReader& table, bool link, SilentLinkSettings& silent) {
  std::int32_t after_s = 0;
  if (table.optional_whole("silent_after_s", kSilentAfter, after_s) && after_s > 0 && !link) {
    table.complain("silent_after_s", "of a robot's link, which is \"none\", expected it left out");
  }
  silent.after = std::chrono::seconds(after_s);
  if (after_s > 0) {
    table.whole("silent_permille", kRest, silent.most_permille);
  } else if (table.sound("silent_after_s")) {
    refuse_keys(table, std::array<std::string_view, 1>{"silent_permille"},
                "of a silent link, which needs silent_after_s");
  } else {
    table.ignore("silent_permille");
  }
}

void read_pwm(TableReader& table, drivers::PwmSettings& pwm) {
  table.text("chip", pwm.chip);
  table.whole("channel", kChannel, pwm.channel);
  table.optional_whole("frequency_hz", kPwmFrequency, pwm.frequency_hz);
  table.optional_switch("inverted", pwm.inverted);
  refuse_keys(table, kGpioKeys, "of another kind of lamp");
}

void read_gpio(TableReader& table, drivers::GpioSettings& gpio) {
  table.text("chip", gpio.bank.chip);
  if (!table.has("lines")) {
    table.complain("lines", "missing, expected 1 to 8 lines by number or name: [\"18\"]");
  }
  if (table.optional_texts("lines", gpio.bank.lines) && table.has("lines") &&
      (gpio.bank.lines.empty() ||
       gpio.bank.lines.size() > static_cast<std::size_t>(drivers::kMostLines))) {
    table.complain("lines", std::to_string(gpio.bank.lines.size()) + " lines, expected 1 to 8");
  }
  const bool pulsed = gpio.bank.lines.size() == 1;
  table.optional_switch("active_low", gpio.bank.active_low);
  if (pulsed) {
    table.optional_whole("frequency_hz", kGpioFrequency, gpio.frequency_hz);
    table.optional_whole("priority", kPriority, gpio.priority);
  } else {
    refuse_keys(table, std::array<std::string_view, 2>{"frequency_hz", "priority"},
                "of pulses, which a single line has");
  }
  refuse_keys(table, kPwmKeys, "of another kind of lamp");
}

void read_rules(TableReader& table, bool usual, LampSettings& lamp) {
  lamp.automatic = usual;
  lamp.pattern = usual;
  table.optional_switch("automatic", lamp.automatic);
  table.optional_switch("pattern", lamp.pattern);
}

/// Above that the pattern is not found in the picture, by lamp_beat_study.
constexpr double kMostBeat = 0.05;

/// A pattern that nothing could find: better told now than `unknown` for ever.
void check_beat(TableReader& table, const LampSettings& lamp, double exposure_ms) {
  const bool pwm = lamp.kind == LampKind::kPwm;
  const std::int32_t pulses_hz = pwm ? lamp.pwm.frequency_hz : lamp.gpio.frequency_hz;
  const double beat = beat_of_pulses(pulses_hz, exposure_ms);
  if (!lamp.pattern || exposure_ms <= 0.0 || beat <= kMostBeat || !table.sound("frequency_hz")) {
    return;
  }
  // One more or less of so many.
  const auto enough_hz = static_cast<std::int64_t>(std::ceil(1000.0 / kMostBeat / exposure_ms));
  const bool can = enough_hz <= (pwm ? kPwmFrequency : kGpioFrequency).most;
  table.complain("frequency_hz",
                 std::to_string(pulses_hz) + " pulses a second beat with the exposure by " +
                     std::to_string(std::lround(beat * 100.0)) + " % of the light, expected " +
                     (can ? std::to_string(enough_hz) + " or more, or " : "") + "pattern = false");
}

}  // namespace

double beat_of_pulses(double pulses_hz, double exposure_ms) {
  const double pulses = pulses_hz * exposure_ms / 1000.0;
  const double left = pulses - std::floor(pulses);
  return pulses > 0.0 ? 2.0 * std::min(left, 1.0 - left) / pulses : 0.0;
}

void read_lamp(TableReader& table, const LampCompany& company, LampSettings& lamp) {
  std::size_t kind = 0;
  const bool camera =
      company.light == SourceLight::kCamera || company.light == SourceLight::kUnknown;
  if (!table.word("kind", kKinds, kind) || (kind != 0 && !camera)) {
    if (table.sound("kind")) {
      table.complain("kind", std::string(kKinds[kind]) +
                                 ", expected \"none\": a source that is played has its own light");
    }
    ignore_keys(table, kPwmKeys);
    ignore_keys(table, kGpioKeys);
    ignore_keys(table, kSharedKeys);
    ignore_keys(table, kRuleKeys);
    return;
  }
  lamp.kind = static_cast<LampKind>(kind);
  if (lamp.kind == LampKind::kNone) {
    refuse_keys(table, kPwmKeys, "of another kind of lamp");
    refuse_keys(table, kGpioKeys, "of another kind of lamp");
    refuse_keys(table, kSharedKeys, "of another kind of lamp");
    if (company.light == SourceLight::kSimulated || company.light == SourceLight::kUnknown) {
      read_rules(table, false, lamp);
    } else {
      refuse_keys(table, kRuleKeys, "of a lamp that the box dims");
    }
    return;
  }
  const std::size_t before = table.problems().size();
  if (lamp.kind == LampKind::kPwm) {
    read_pwm(table, lamp.pwm);
  } else {
    read_gpio(table, lamp.gpio);
  }
  lamp.device_sound = table.problems().size() == before;
  // Steps do not swing by a hundredth; pulses of a thread may beat with the exposure.
  const bool stepped = lamp.kind == LampKind::kGpio && lamp.gpio.bank.lines.size() > 1;
  if (stepped) {
    refuse_keys(table, std::array<std::string_view, 1>{"pattern"}, "of a lamp without steps");
    table.optional_switch("automatic", lamp.automatic);
  } else {
    read_rules(table, lamp.kind == LampKind::kPwm, lamp);
    check_beat(table, lamp, company.exposure_ms);
  }
  read_care(table, lamp.care);
  read_silent_link(table, company.link, lamp.silent_link);
}

}  // namespace tubesight::board
