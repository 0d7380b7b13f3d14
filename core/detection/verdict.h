#pragma once

#include <cstdint>

#include "core/detection/portrait.h"

namespace tubesight::core::detection {

/// What a place is by its look.
enum class Verdict : std::uint8_t {
  kUnsure,
  kAlike,   ///< a tube-end as those around it
  kHidden,  ///< one behind something that hides up to half of it
  kPlug,    ///< one with a plug
  kNone     ///< no tube-end
};

/// Tells it. `half_px`: the shorter half axis; `edgeless`: a spot was found and no edge of it.
[[nodiscard]] Verdict judge(const Resemblance& whole, const HalfResemblance& half, double half_px,
                            bool edgeless);

}  // namespace tubesight::core::detection
