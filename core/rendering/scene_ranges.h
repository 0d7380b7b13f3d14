#pragma once

#include <array>
#include <cstddef>

#include "core/rendering/scene.h"

namespace tubesight::core::rendering {

/// What one number of a look may be, limits included.
template <typename Look>
struct LookRange {
  double Look::*member;
  double least;
  double most;
};

// Every number of the looks. Renderer::configure() refuses a scene that is not within; who reads
// scenes from files takes the same limits, to say which number it was. Apart from them the land of
// a fillet weld is not wider than the fillet.

inline constexpr std::array kSheetLookRanges = {
    LookRange<SheetLook>{&SheetLook::plate, 0.01, 1.0},
    LookRange<SheetLook>{&SheetLook::gloss, 0.0, 1.0},
    LookRange<SheetLook>{&SheetLook::texture, 0.0, 0.5},
    LookRange<SheetLook>{&SheetLook::stains, 0.0, 0.5},
    LookRange<SheetLook>{&SheetLook::weld, 0.0, 1.0},
    LookRange<SheetLook>{&SheetLook::weld_mm, 0.0, 10.0},
    LookRange<SheetLook>{&SheetLook::fillet_mm, 0.5, 15.0},
    LookRange<SheetLook>{&SheetLook::fillet_height_mm, 0.0, 15.0},
    LookRange<SheetLook>{&SheetLook::land_mm, 0.1, 10.0},
    LookRange<SheetLook>{&SheetLook::wall, 0.0, 1.0},
    LookRange<SheetLook>{&SheetLook::bore_spread_mm, 0.0, 0.5},
    LookRange<SheetLook>{&SheetLook::nicked, 0.0, 1.0},
    LookRange<SheetLook>{&SheetLook::nick_mm, 0.0, 3.0},
    LookRange<SheetLook>{&SheetLook::boron, 0.0, 1.0},
    LookRange<SheetLook>{&SheetLook::plug, 0.0, 1.0},
    LookRange<SheetLook>{&SheetLook::plug_hole, 0.0, 0.9},
    LookRange<SheetLook>{&SheetLook::plug_height_mm, 0.0, 10.0},
};

inline constexpr std::array kLampLookRanges = {
    LookRange<LampLook>{&LampLook::ring_radius_mm, 1.0, 200.0},
    LookRange<LampLook>{&LampLook::below_tip_mm, 0.0, 500.0},
    LookRange<LampLook>{&LampLook::strength, 0.0, 10.0},
    LookRange<LampLook>{&LampLook::tilt_deg, -60.0, 60.0},
    LookRange<LampLook>{&LampLook::beam, 0.0, 8.0},
    LookRange<LampLook>{&LampLook::ambient, 0.0, 1.0},
    LookRange<LampLook>{&LampLook::led_radius_mm, 1.0, 100.0},
    LookRange<LampLook>{&LampLook::led_strength, 0.0, 10.0},
};

inline constexpr std::array kSensorLookRanges = {
    LookRange<SensorLook>{&SensorLook::blur_px, 0.3, 4.0},
    LookRange<SensorLook>{&SensorLook::vignetting, 0.0, 1.0},
    LookRange<SensorLook>{&SensorLook::veil, 0.0, 0.5},
    LookRange<SensorLook>{&SensorLook::blooming, 0.0, 1.0},
    LookRange<SensorLook>{&SensorLook::blooming_px, 1.0, 100.0},
    LookRange<SensorLook>{&SensorLook::gain, 0.01, 10.0},
    LookRange<SensorLook>{&SensorLook::offset, -50.0, 200.0},
    LookRange<SensorLook>{&SensorLook::saturation, 16.0, 255.0},
    LookRange<SensorLook>{&SensorLook::shot_noise, 0.0, 2.0},
    LookRange<SensorLook>{&SensorLook::read_noise, 0.0, 50.0},
    LookRange<SensorLook>{&SensorLook::emi_share, 0.0, 1.0},
    LookRange<SensorLook>{&SensorLook::emi_amplitude, 0.0, 255.0},
    LookRange<SensorLook>{&SensorLook::salt_and_pepper, 0.0, 1.0},
};

inline constexpr std::array kGuidetubeLookRanges = {
    LookRange<GuidetubeLook>{&GuidetubeLook::radius_mm, 0.0, 100.0},
    LookRange<GuidetubeLook>{&GuidetubeLook::length_mm, 0.0, 1000.0},
    LookRange<GuidetubeLook>{&GuidetubeLook::reflectance, 0.0, 1.0},
    LookRange<GuidetubeLook>{&GuidetubeLook::shadow, 0.0, 1.0},
};

/// Whether all numbers are within their ranges; NaN is in none.
template <typename Look, std::size_t N>
[[nodiscard]] constexpr bool within(const std::array<LookRange<Look>, N>& ranges,
                                    const Look& look) {
  for (const LookRange<Look>& range : ranges) {
    const double value = look.*range.member;
    if (!(value >= range.least && value <= range.most)) {
      return false;
    }
  }
  return true;
}

}  // namespace tubesight::core::rendering
