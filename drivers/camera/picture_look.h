#pragma once

#include <cstdint>

#include "core/base/image_view.h"

namespace tubesight::drivers {

/// What a picture looks like at a glance.
enum class Look : std::uint8_t {
  kPicture,
  kNoise,  ///< snow: bright and dark without any shape
  kBlank,  ///< one grey all over that no sheet and no darkness has: a grabber's blue, or grey
  kBlack,  ///< one grey all over, black; the session says itself that there is no light
};

/// Looks at some 256 places of a field: what a grabber makes up when it has no signal.
///
/// Costs some 5 us. A sensor's own noise in the dark is far below what counts as snow.
[[nodiscard]] Look look_at(const core::FieldView& field);

}  // namespace tubesight::drivers
