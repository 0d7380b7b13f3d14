#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/base/scalar.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Where a picture shows the tool.
template <Scalar S>
struct PlaceSeen {
  TubeAddress anchor{};
  Vector2<Mm<S>> local{};  ///< mm from the anchor's centre
  Mm<S> deviation_mm{};    ///< one standard deviation
};

/// Where the track expects the tool, and what it lets it stray.
template <Scalar S>
struct PlaceExpected {
  Vector2<Mm<S>> local{};       ///< mm from the same anchor's centre
  Vector2<Mm<S>> a_field_mm{};  ///< the track's own way from field to field
  Mm<S> reach_mm{};
};

/// Follows the pictures that refuted the track as a motion of their own, lattice steps aside.
///
/// A picture that was spoilt, old or out of order is followed by one that fits the track. After a
/// jump that nothing shows, the sheet's pattern goes on where it is, and a track that drives over
/// it fits by chance. So what comes back is believed only when the refuted pictures do not lead
/// there: three pictures that make one motion within the limits of [motion], the first of them
/// refuted, are a jump. One picture is enough where it fits no instant of the track's own motion,
/// three fields back to two ahead, by far.
///
/// All distances are taken to the nearest tube's: a lattice looks the same at every tube. `model`
/// outlives it.
template <Scalar S>
class RefutedMotion {
 public:
  explicit RefutedMotion(const TrackingModel<S>& model) : model_(&model) {}

  /// The doubt is over, or there is a new start.
  void forget() { pictures_ = 0; }

  /// A picture with most of its tube-ends in one pose refuted the track. Whether that is a jump.
  [[nodiscard]] bool refute(const Field& field, const PlaceSeen<S>& seen,
                            const PlaceExpected<S>& expected);

  /// A picture fits the track again. Whether the refuted ones lead to it all the same: a jump.
  [[nodiscard]] bool come_back(const Field& field, const PlaceSeen<S>& seen);

  /// Whether it cannot be told yet: nothing is vouched for until the next field.
  [[nodiscard]] bool undecided() const { return pictures_ > 0; }

  /// The members of the state; see core/base/state_stream.h. The model is the settings'.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [model, pictures, at, way, interval, off, time] = self;
    stream.number(pictures, 0, kOneMotion);
    stream(at, way, interval, off, time);
  }

 private:
  static constexpr std::int32_t kOneMotion = 3;

  void take(const Field& field, const PlaceSeen<S>& seen);
  [[nodiscard]] bool continues(const PlaceSeen<S>& seen, Unit<S> span_s, Vector2<Mm<S>>& way) const;
  [[nodiscard]] Vector2<Mm<S>> to_nearest(TubeAddress anchor, const Vector2<Mm<S>>& way) const;

  const TrackingModel<S>* model_;
  std::int32_t pictures_ = 0;  ///< that make one motion so far, the last of them at `at_`
  Vector2<Mm<S>> at_{};
  Vector2<Mm<S>> way_{};  ///< to there from the one before; of two pictures and more
  Unit<S> interval_s_{};  ///< between the two
  Mm<S> off_mm_{};        ///< of the last refuted picture, from where the track expected it
  FieldTime time_{0};
};

}  // namespace tubesight::core::tracking
