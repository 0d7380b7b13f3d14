#pragma once

#include <array>
#include <string_view>

#include "core/rendering/scene.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// A key of a table that stands for one number of a struct; the default is the struct's.
template <typename Struct>
struct NumberKey {
  std::string_view key;
  drivers::NumberRange range;
  double Struct::*member;
};

// What the scene looks like, for the reader and the writer of scenarios. The ranges are within the
// renderer's, which refuses a scene without saying of which number.

using core::rendering::GuidetubeLook;
using core::rendering::LampLook;
using core::rendering::SensorLook;
using core::rendering::SheetLook;

/// `[look]`
inline constexpr std::array kSheetLookKeys = {
    NumberKey<SheetLook>{"plate", {0.01, 1.0, ""}, &SheetLook::plate},
    NumberKey<SheetLook>{"gloss", {0.0, 1.0, ""}, &SheetLook::gloss},
    NumberKey<SheetLook>{"texture", {0.0, 0.5, ""}, &SheetLook::texture},
    NumberKey<SheetLook>{"stains", {0.0, 0.5, ""}, &SheetLook::stains},
    NumberKey<SheetLook>{"weld", {0.0, 1.0, ""}, &SheetLook::weld},
    NumberKey<SheetLook>{"weld_mm", {0.0, 10.0, " mm"}, &SheetLook::weld_mm},
    NumberKey<SheetLook>{"fillet_mm", {0.5, 15.0, " mm"}, &SheetLook::fillet_mm},
    NumberKey<SheetLook>{"fillet_height_mm", {0.0, 15.0, " mm"}, &SheetLook::fillet_height_mm},
    NumberKey<SheetLook>{"land_mm", {0.1, 10.0, " mm"}, &SheetLook::land_mm},
    NumberKey<SheetLook>{"wall", {0.0, 1.0, ""}, &SheetLook::wall},
    NumberKey<SheetLook>{"bore_spread_mm", {0.0, 0.5, " mm"}, &SheetLook::bore_spread_mm},
    NumberKey<SheetLook>{"nicked", {0.0, 1.0, ""}, &SheetLook::nicked},
    NumberKey<SheetLook>{"nick_mm", {0.0, 3.0, " mm"}, &SheetLook::nick_mm},
    NumberKey<SheetLook>{"boron", {0.0, 1.0, ""}, &SheetLook::boron},
    NumberKey<SheetLook>{"plug", {0.0, 1.0, ""}, &SheetLook::plug},
    NumberKey<SheetLook>{"plug_hole", {0.0, 0.9, ""}, &SheetLook::plug_hole},
    NumberKey<SheetLook>{"plug_height_mm", {0.0, 10.0, " mm"}, &SheetLook::plug_height_mm},
};

/// `[lamp]`, beside lamp_permille, pwm_hz and ring
inline constexpr std::array kLampLookKeys = {
    NumberKey<LampLook>{"ring_radius_mm", {1.0, 200.0, " mm"}, &LampLook::ring_radius_mm},
    NumberKey<LampLook>{"below_tip_mm", {0.0, 500.0, " mm"}, &LampLook::below_tip_mm},
    NumberKey<LampLook>{"strength", {0.0, 10.0, ""}, &LampLook::strength},
    NumberKey<LampLook>{"tilt_deg", {-60.0, 60.0, " degrees"}, &LampLook::tilt_deg},
    NumberKey<LampLook>{"beam", {0.0, 8.0, ""}, &LampLook::beam},
    NumberKey<LampLook>{"ambient", {0.0, 1.0, ""}, &LampLook::ambient},
    NumberKey<LampLook>{"led_radius_mm", {1.0, 100.0, " mm"}, &LampLook::led_radius_mm},
    NumberKey<LampLook>{"led_strength", {0.0, 10.0, ""}, &LampLook::led_strength},
};

/// `[sensor]`
inline constexpr std::array kSensorLookKeys = {
    NumberKey<SensorLook>{"blur_px", {0.3, 4.0, " px"}, &SensorLook::blur_px},
    NumberKey<SensorLook>{"vignetting", {0.0, 1.0, ""}, &SensorLook::vignetting},
    NumberKey<SensorLook>{"veil", {0.0, 0.5, ""}, &SensorLook::veil},
    NumberKey<SensorLook>{"blooming", {0.0, 1.0, ""}, &SensorLook::blooming},
    NumberKey<SensorLook>{"blooming_px", {1.0, 100.0, " px"}, &SensorLook::blooming_px},
    NumberKey<SensorLook>{"gain", {0.01, 10.0, ""}, &SensorLook::gain},
    NumberKey<SensorLook>{"offset", {-50.0, 200.0, ""}, &SensorLook::offset},
    NumberKey<SensorLook>{"saturation", {16.0, 255.0, ""}, &SensorLook::saturation},
    NumberKey<SensorLook>{"shot_noise", {0.0, 2.0, ""}, &SensorLook::shot_noise},
    NumberKey<SensorLook>{"read_noise", {0.0, 50.0, ""}, &SensorLook::read_noise},
    NumberKey<SensorLook>{"emi_share", {0.0, 1.0, ""}, &SensorLook::emi_share},
    NumberKey<SensorLook>{"emi_amplitude", {0.0, 255.0, ""}, &SensorLook::emi_amplitude},
    NumberKey<SensorLook>{"salt_and_pepper", {0.0, 1.0, ""}, &SensorLook::salt_and_pepper},
};

/// `[guidetube]`
inline constexpr std::array kGuidetubeLookKeys = {
    NumberKey<GuidetubeLook>{"radius_mm", {0.0, 100.0, " mm"}, &GuidetubeLook::radius_mm},
    NumberKey<GuidetubeLook>{"length_mm", {0.0, 1000.0, " mm"}, &GuidetubeLook::length_mm},
    NumberKey<GuidetubeLook>{"reflectance", {0.0, 1.0, ""}, &GuidetubeLook::reflectance},
    NumberKey<GuidetubeLook>{"shadow", {0.0, 1.0, ""}, &GuidetubeLook::shadow},
};

/// Reads the keys of `keys` that stand in the table.
template <typename Struct, std::size_t N>
void read_numbers(drivers::TableReader& table, const std::array<NumberKey<Struct>, N>& keys,
                  Struct& values) {
  for (const NumberKey<Struct>& key : keys) {
    table.optional_number(key.key, key.range, values.*key.member);
  }
}

}  // namespace tubesight::board
