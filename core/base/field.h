#pragma once

#include <chrono>
#include <cstdint>

#include "core/base/image_view.h"

namespace tubesight::core {

/// Instants of the clock that stamps fields: nanoseconds from its own zero.
using FieldTime = std::chrono::nanoseconds;

/// Whether a field's pixels can be believed.
enum class FieldStatus : std::uint8_t {
  kGood,     ///< complete
  kDamaged,  ///< lines are missing or the signal was lost: pixels are not to be used
  kMissing,  ///< no field came in time: there are no pixels and no sequence number
};

/// The level of a lamp that nobody dims.
inline constexpr std::int32_t kFullLamp_permille = 1000;

/// One field as the camera delivered it, or the news that none came.
///
/// A missing field has a number and an instant alone, that of the moment at which it was given up.
struct Field {
  FieldView pixels;  ///< valid unless missing; damaged ones are any bytes
  Parity parity = Parity::kProgressive;
  FieldStatus status = FieldStatus::kGood;
  std::int64_t sequence = 0;  ///< grows by one a field; a gap means lost fields
  FieldTime mid_exposure{0};
  /// Counts what the session is given, in files 2 * frame, plus 1 for the later field of a frame.
  std::int64_t number = 0;
  std::int32_t lamp_permille = kFullLamp_permille;  ///< level in force while it was exposed
};

}  // namespace tubesight::core
