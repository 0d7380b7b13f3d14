#pragma once

#include <span>

#include "core/base/scalar.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"
#include "core/tracking/tube_measurement.h"

namespace tubesight::core::tracking {

/// The primary tube [Fallon 6.2]: the measured tube-end nearest to the optimum point of the
/// picture, from which the others are told.
///
/// It is kept until another is nearer by 10 %, so that it does not flicker between two.
class PrimaryTube {
 public:
  void forget() { known_ = false; }

  /// Chooses among a field's tube-ends that were used; without one it stays.
  template <Scalar S>
  void choose(std::span<const TubeMeasurement<S>> measured, const Vector2<Px<S>>& optimum_px);

  [[nodiscard]] bool known() const { return known_; }
  /// Valid when known.
  [[nodiscard]] TubeAddress address() const { return address_; }
  [[nodiscard]] bool is(TubeAddress address) const { return known_ && address == address_; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [is_known, tube] = self;
    stream(is_known, tube);
  }

 private:
  bool known_ = false;
  TubeAddress address_{};
};

}  // namespace tubesight::core::tracking
