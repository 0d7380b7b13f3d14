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
};

/// One field as the camera delivered it.
struct Field {
  FieldView pixels;  ///< valid whatever the status, if damaged: bytes
  Parity parity = Parity::kProgressive;
  FieldStatus status = FieldStatus::kGood;
  std::int64_t sequence = 0;  ///< grows by one a field; a gap means lost fields
  FieldTime mid_exposure{0};
};

}  // namespace tubesight::core
