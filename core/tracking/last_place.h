#pragma once

#include "core/base/field.h"
#include "core/base/scalar.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"
#include "core/tracking/motion.h"
#include "core/tracking/start.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Remembers where on the sheet the tool was seen last, whatever became of the track since, and
/// says whether a start can be true: nothing comes from there faster than at the greatest speed of
/// [motion], nor leaves the way that it was on faster than at the greatest acceleration.
///
/// It knows nothing before the first field that is believed. Whoever insists on a start may be
/// right all the same, as a track can be wrong in a way that no picture shows.
template <Scalar S>
class LastPlace {
 public:
  /// A field was believed: it shows the tool at `local` from the centre of `anchor`, mm, with this
  /// motion.
  void believe(const Field& field, TubeAddress anchor, const Vector2<Mm<S>>& local,
               const Motion<S>& motion);

  /// Whether these clicks into the field put the tool where it cannot have come since: farther than
  /// by the greatest speed, or by the greatest acceleration from where its motion leads, and half a
  /// lattice step for what clicks leave open. False where they show
  /// no pose at all, which is another refusal. Where time goes back, none has passed.
  [[nodiscard]] bool refutes(const Field& field, StartSearch<S>& search) const;

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [known, moves, anchor, local, velocity, interval, time] = self;
    stream(known, moves, anchor, local, velocity, interval, time);
  }

 private:
  [[nodiscard]] bool within_reach(const TrackingModel<S>& model, const Vector2<Mm<S>>& way,
                                  FieldTime since) const;

  bool known_ = false;
  bool motion_known_ = false;
  TubeAddress anchor_{};
  Vector2<Mm<S>> local_{};
  Vector2<Mm<S>> velocity_mm_s_{};  ///< over the last interval_s_, sheet axes
  Unit<S> interval_s_{};
  FieldTime time_{0};
};

}  // namespace tubesight::core::tracking
