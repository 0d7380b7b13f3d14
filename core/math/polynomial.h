#pragma once

#include <array>
#include <cstddef>

#include "core/base/static_vector.h"

namespace tubesight::core::math {

/// Coefficients of a polynomial of the fourth degree or less, that of x^0 first.
using Quartic = std::array<double, 5>;

/// The real roots of a quartic (or lower) between `least` and `most`, in rising order.
///
/// Between two neighbouring roots of the derivative a polynomial rises or falls, so that one root
/// at most lies there: found by bisection, degree by degree. Where it touches zero to within 1e-9
/// of its terms' sizes, the touching point is given once.
[[nodiscard]] StaticVector<double, 8> real_roots(const Quartic& coefficients, double least,
                                                 double most);

}  // namespace tubesight::core::math
