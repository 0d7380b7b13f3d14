#pragma once

#include <cstdint>

namespace tubesight::board::campaign {

/// Limits between which a probability lies.
struct BinomialBounds {
  double lower = 0.0;
  double upper = 1.0;
};

/// The Clopper-Pearson interval: the probability of an event seen in `events` of `trials`
/// independent trials lies between the bounds, with 95 % confidence (2.5 % on either side).
///
/// Needs 0 <= events <= trials; without trials anything is possible.
[[nodiscard]] BinomialBounds binomial_bounds(std::int64_t events, std::int64_t trials);

}  // namespace tubesight::board::campaign
