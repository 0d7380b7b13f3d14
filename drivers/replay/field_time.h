#pragma once

#include <cstdint>

#include "core/base/field.h"

namespace tubesight::drivers {

/// Mid-exposure of the field with this number at a constant rate of frames: number / 2 frames, that
/// is (frame + 0, or + 0.5 for the later field) / rate.
///
/// Integers alone, rounded half up to the nanosecond. number 0..2^33, rate_numerator and
/// rate_denominator 1..10^9 (frames a second); what is beyond 292 years is held there.
[[nodiscard]] core::FieldTime nominal_field_time(std::int64_t number, std::int64_t rate_numerator,
                                                 std::int64_t rate_denominator);

}  // namespace tubesight::drivers
