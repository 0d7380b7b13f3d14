// expect: no match for .operator\+
// Two formats do not add up without saying which one is meant.
#include "core/base/fixed.h"

namespace core = tubesight::core;
using Px = core::Fixed<16, 16>;
using Mm = core::Fixed<12, 20>;

#ifdef TUBESIGHT_MUST_NOT_COMPILE
Px sum(Px a, Mm b) { return a + b; }
#else
Px sum(Px a, Mm b) { return a + core::convert<Px>(b); }
#endif
