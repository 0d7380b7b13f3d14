#pragma once

#include "core/base/scalar.h"
#include "core/base/vector3.h"

namespace tubesight::core::tracking {

/// The length of a vector on the sheet, mm.
template <typename M>
[[nodiscard]] M plane_length(const Vector2<M>& v) {
  return root<M>(product(v.x, v.x) + product(v.y, v.y));
}

}  // namespace tubesight::core::tracking
