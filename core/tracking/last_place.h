#pragma once

#include "core/base/field.h"
#include "core/base/scalar.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"
#include "core/tracking/start.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Remembers where on the sheet the tool was seen last, whatever became of the track since, and
/// says whether a start can be true: nothing comes from there faster than at the greatest speed of
/// [motion].
///
/// It knows nothing before the first field that is believed. Whoever insists on a start may be
/// right all the same, as a track can be wrong in a way that no picture shows.
template <Scalar S>
class LastPlace {
 public:
  /// A field was believed: it shows the tool at `local` from the centre of `anchor`, mm.
  void believe(const Field& field, TubeAddress anchor, const Vector2<Mm<S>>& local);

  /// Whether these clicks into the field put the tool where it cannot have come since: farther than
  /// the greatest speed, and half a lattice step for what clicks leave open. False where they show
  /// no pose at all, which is another refusal. Where time goes back, none has passed.
  [[nodiscard]] bool refutes(const Field& field, StartSearch<S>& search) const;

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [known, anchor, local, time] = self;
    stream(known, anchor, local, time);
  }

 private:
  bool known_ = false;
  TubeAddress anchor_{};
  Vector2<Mm<S>> local_{};
  FieldTime time_{0};
};

}  // namespace tubesight::core::tracking
