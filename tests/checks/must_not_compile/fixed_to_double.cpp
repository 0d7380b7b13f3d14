// expect: cannot convert
// The way back to floating point is spelt out too.
#include "core/base/fixed.h"

using Mm = tubesight::core::Fixed<16, 16>;

#ifdef TUBESIGHT_MUST_NOT_COMPILE
double shown_mm(Mm a) { return a; }
#else
double shown_mm(Mm a) { return static_cast<double>(a); }
#endif
