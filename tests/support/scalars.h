#pragma once

#include <gtest/gtest.h>

#include "core/base/scalar.h"

namespace tubesight::tests {

/// The arithmetics that a typed suite runs in. Where a preset leaves `float` and `double` out they
/// are not compiled either (TUBESIGHT_TESTS_FIXED_ONLY): under the sanitizers and under emulation
/// fixed point is what can go wrong.
#ifdef TUBESIGHT_TESTS_FIXED_ONLY
using Scalars = ::testing::Types<core::FixedPoint>;
#else
using Scalars = ::testing::Types<core::FixedPoint, float, double>;
#endif

}  // namespace tubesight::tests
