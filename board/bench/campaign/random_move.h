#pragma once

#include <cstdint>
#include <memory>

#include "board/bench/campaign/stratum.h"
#include "core/rendering/truth.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::board::campaign {

/// The name of what is drawn; changes whenever a move of a seed and number would become another.
inline constexpr const char* kDesign = "design-4";

/// What is drawn beside what every move is drawn of.
struct DrawOptions {
  bool sizes = false;  ///< pictures of other sizes and rates
};

/// Makes moves of a campaign; the same seed and number make the same move, whatever was made
/// before.
class MoveMaker {
 public:
  explicit MoveMaker(const DrawOptions& options = {}) : options_(options) {}

  /// Draws a move into `scenario`, all of which is replaced.
  void make(std::uint64_t seed, std::int64_t move, drivers::Scenario& scenario);

 private:
  DrawOptions options_;
  std::unique_ptr<core::rendering::Truth> truth_ = std::make_unique<core::rendering::Truth>();
};

}  // namespace tubesight::board::campaign
