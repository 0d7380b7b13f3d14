#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/field.h"

namespace tubesight::drivers {

/// Mid-exposure of the field with this number at a constant rate of frames: number / 2 frames, that
/// is (frame + 0, or + 0.5 for the later field) / rate.
///
/// Integers alone, rounded half up to the nanosecond. number 0..2^33, rate_numerator and
/// rate_denominator 1..10^9 (frames a second); what is beyond 292 years is held there.
[[nodiscard]] core::FieldTime nominal_field_time(std::int64_t number, std::int64_t rate_numerator,
                                                 std::int64_t rate_denominator);

/// Reads an instant in seconds with at most 9 decimals, within 4 * 10^9 s of zero, so that
/// differences fit. False, and `time` as it was, for anything else; `expected` then says what was.
[[nodiscard]] bool parse_time(std::string_view text, core::FieldTime& time, const char*& expected);

}  // namespace tubesight::drivers
