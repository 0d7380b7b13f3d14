#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <type_traits>

#include "core/base/image_view.h"
#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core::lighting {

/// The lamp's light on one place of the sheet, in one field.
struct TubeLight {
  TubeAddress address{};
  std::int32_t light_q4 = 0;  ///< 1/16 grey level
};

template <typename Self, typename Stream>
requires std::same_as<std::remove_const_t<Self>, TubeLight>
void transfer(Self& self, Stream& stream) {
  auto& [address, light] = self;
  stream(address);
  stream.number(light, 0, 1 << 16);
}

using TubeLightList = StaticVector<TubeLight, kMaxTubesInView>;

/// From here on a rim is as bright as the camera goes and follows no lamp.
inline constexpr std::int32_t kGlaring_q4 = 200 * 16;
/// Below this the camera's noise is what changes.
inline constexpr std::int32_t kFaint_q4 = 12 * 16;

/// The measured tube-ends' contrasts: how much brighter a rim is than the inside, which has no
/// light of the lamp. They follow the lamp whatever the camera's black level is, and are measured
/// anyway.
void list_tube_light(std::span<const TubeSighting> tubes, TubeLightList& lights);

/// The same where nobody knows which tube-ends are seen: lines of pixels spread over the window
/// under addresses that no tube has. It means something while the tool stands still. The black
/// level is in it.
void list_window_light(const FieldView& field, const PixelBox& window, TubeLightList& lights);

/// The mean, 1/16 grey level; 0 of none.
[[nodiscard]] std::int32_t mean_light_q4(const TubeLightList& lights);

}  // namespace tubesight::core::lighting
