// expect: no match for .operator\+
// A bare floating-point constant does not slip into a fixed-point expression.
#include "core/base/fixed.h"

using Mm = tubesight::core::Fixed<16, 16>;

Mm raised(Mm height_mm) {
#ifdef TUBESIGHT_MUST_NOT_COMPILE
  return height_mm + 0.5;
#else
  return height_mm + Mm(0.5);
#endif
}
