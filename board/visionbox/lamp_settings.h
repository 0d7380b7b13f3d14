#pragma once

#include <cstdint>

#include "board/visionbox/lamp_ramp.h"
#include "board/visionbox/silent_link.h"
#include "drivers/gpio/gpio_dimmer.h"
#include "drivers/pwm/pwm_dimmer.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// Who dims the lamp; the order of the words of `kind`.
enum class LampKind : std::uint8_t { kNone, kPwm, kGpio };

/// The table `[lamp]`.
struct LampSettings {
  LampKind kind = LampKind::kNone;
  bool device_sound = false;  ///< kind, pwm and gpio are without a mistake, whatever the rest is
  drivers::PwmSettings pwm;
  drivers::GpioSettings gpio;
  LampCare care;
  SilentLinkSettings silent_link;
  bool automatic = false;  ///< the level follows the picture until somebody commands one
  bool pattern = false;    ///< the level swings, and the picture must follow
};

/// What the light of a source is.
enum class SourceLight : std::uint8_t {
  kRecorded,   ///< it was; nobody dims it
  kSimulated,  ///< the simulated lamp, which the box dims
  kCamera,     ///< that of the lamp in `[lamp]`, where there is one
  kUnknown,  ///< the source's kind is a mistake, which is told: nothing is said of the lamp for it
};

/// What else a box has that its lamp is asked about.
struct LampCompany {
  SourceLight light = SourceLight::kRecorded;
  bool link = false;         ///< there is a robot that may fall silent
  double exposure_ms = 0.0;  ///< of the camera; 0: nobody says
};

/// By how much the light of two exposures can differ under pulses that are not in step with them,
/// as a share of the mean, at half light: of the pulses that do not fit in whole, one exposure may
/// see all and another none.
[[nodiscard]] double beat_of_pulses(double pulses_hz, double exposure_ms);

/// Reads the table; mistakes go to the reader's problems.
void read_lamp(drivers::TableReader& table, const LampCompany& company, LampSettings& lamp);

}  // namespace tubesight::board
