#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/base/scalar.h"
#include "core/base/vector3.h"
#include "core/tracking/field_order.h"
#include "core/tracking/sheet_observer.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Shows the judge of the fields' order where each field of a frame saw the tool: the fields that
/// were believed, and those that refuted the prediction, which are looked at once more for it.
///
/// Nothing is believed for its sake; it serves to name the reason if the track is lost. Cameras
/// without fields are not watched. `model` outlives it.
template <Scalar S>
class FieldOrderWatch {
 public:
  explicit FieldOrderWatch(const TrackingModel<S>& model) : model_(&model) {}

  /// A new start: nothing is known.
  void begin();

  /// A field was believed, with the tool there from the anchor.
  void believe(const Field& field, const Vector2<Mm<S>>& tool);

  /// A field refuted the prediction: looks at it as far around the last place (`last`, of a good
  /// field; later that of the field looked at last) as `reach_mm`, in which a tube-end cannot be
  /// mistaken for its neighbour. `contradicted`: the field before it did as well.
  void look_aside(const Field& field, const SheetPose<S>& last, Mm<S> reach_mm, bool contradicted,
                  SheetObserver<S>& observer);

  /// Nothing is known of a field's place.
  void miss() { order_.miss(); }

  /// The anchor moves by so much.
  void move_anchor(const Vector2<Mm<S>>& by);

  /// Whether the fields that were believed come in the wrong order beyond doubt.
  [[nodiscard]] bool wrong() const { return order_.wrong(); }

  /// Whether the places that refuted the prediction make a motion in another order. `field_ns`: the
  /// time from field to field.
  [[nodiscard]] bool explains(std::int64_t field_ns) const;

  /// The members of the state; see core/base/state_stream.h. The model is the settings'.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [model, order, aside, aside_known] = self;
    stream(order, aside, aside_known);
  }

 private:
  void take(const Field& field, const Vector2<Mm<S>>& tool);
  [[nodiscard]] bool has_fields() const { return model_->first_field != Parity::kProgressive; }

  const TrackingModel<S>* model_;
  FieldOrder order_{};
  SheetPose<S> aside_{};  ///< of the last field that refuted the prediction, wherever it was found
  bool aside_known_ = false;
};

}  // namespace tubesight::core::tracking
