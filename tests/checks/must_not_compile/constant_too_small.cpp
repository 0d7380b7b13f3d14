// expect: constant_does_not_fit
// A constant that its steps would round to nothing is refused.
#include "core/base/constant.h"

using Mm = tubesight::core::Mm<tubesight::core::FixedPoint>;

Mm least() {
#ifdef TUBESIGHT_MUST_NOT_COMPILE
  return tubesight::core::constant<Mm>(0.0001);
#else
  return tubesight::core::constant<Mm, 16>(0.0001);
#endif
}
