// expect: constant_does_not_fit
// A constant that leaves its format is refused.
#include "core/base/constant.h"

using Unit = tubesight::core::Unit<tubesight::core::FixedPoint>;

Unit most() {
#ifdef TUBESIGHT_MUST_NOT_COMPILE
  return tubesight::core::constant<Unit>(2.0);
#else
  return tubesight::core::constant<Unit>(1.75);
#endif
}
