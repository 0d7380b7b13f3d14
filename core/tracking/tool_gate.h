#pragma once

#include <algorithm>

#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/base/vector3.h"
#include "core/tracking/motion.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// The validation gate: where the tool can be, how well that is known, and so what may be believed.
///
/// It opens from field to field as the time since the last good one grows, by what the limits of
/// [motion] allow the tool (reach) and by what the prediction is uncertain (deviation). An address
/// is named only while reach and three deviations stay within address_limit_mm(), and a picture is
/// believed only if it shows the tool within the gate. All on the sheet, mm; deviations are one
/// standard deviation. `model` outlives it.
template <Scalar S>
class ToolGate {
 public:
  explicit ToolGate(const TrackingModel<S>& model) : model_(&model) {}

  /// Opens it for a field `span_s` after the last good one. After a picture that refuted the
  /// prediction the motion is known no better for the time that passes: what comes back must fit it
  /// as closely as that one had to, or it is another tube's neighbourhood.
  void open(const Motion<S>& motion, Unit<S> span_s, bool contradicted);

  /// How far from the predicted place the tool can be, by the motion alone.
  [[nodiscard]] Mm<S> reach_mm() const { return reach_mm_; }
  /// How far from it a picture may show the tool and be believed.
  [[nodiscard]] Mm<S> believed_mm() const { return std::min(undisputed_mm_, reach_mm_); }

  /// Whether the tool may be so far off that the nearest tube-end might be a neighbour.
  [[nodiscard]] bool exceeds_limit() const;
  /// Why it is, though no picture was unusable and no field is missing: the limits of [motion]
  /// allow too much between two fields even on a perfect picture (kRate), or this picture is too
  /// poor (kUncertain).
  [[nodiscard]] Reason why_exceeded() const;

  /// Why a field that shows the tool at `seen` is not believed: kJump farther from `expected` than
  /// the gate is wide, kSpeed faster from `last` than anything moves, or kNone. `halved`: half of
  /// the tube-ends are gone that the last field agreed on. That alone is a shadow or a cover; with
  /// a motion beyond half of what [motion] allows it is another place, or a picture smeared on the
  /// way.
  [[nodiscard]] Reason refuses(const Vector2<Mm<S>>& seen, Mm<S> deviation_mm, bool halved,
                               const Vector2<Mm<S>>& expected, const Vector2<Mm<S>>& last,
                               Unit<S> span_s) const;

  /// A field was believed: the place is known to so much, of which `picture_deviation_mm` differs
  /// from picture to picture.
  void close(Mm<S> deviation_mm, Mm<S> picture_deviation_mm);

  /// Nothing is believed of this field: the tool may have strayed as far as it can reach.
  void pass_over() { strayed_mm_ = reach_mm_; }

  /// Half the width of a look around the last place, beyond which a tube-end might be taken for its
  /// neighbour.
  [[nodiscard]] Mm<S> widest_look_mm() const;

  /// The distance of a place from the edge of its tube's cell, less what the tool may have strayed,
  /// in deviations.
  [[nodiscard]] Mm<S> margin(Mm<S> to_edge_mm) const {
    return quotient<Mm<S>>(to_edge_mm - strayed_mm_, predicted_deviation_mm_);
  }

  /// The members of the state; see core/base/state_stream.h. The model is the settings'.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [model, deviation, picture_deviation, predicted_deviation, reach, undisputed, strayed] =
        self;
    stream(deviation, picture_deviation, predicted_deviation, reach, undisputed, strayed);
  }

 private:
  const TrackingModel<S>* model_;
  Mm<S> deviation_mm_{};            ///< of the tool in the last good field
  Mm<S> picture_deviation_mm_{};    ///< of it, without what is systematic
  Mm<S> predicted_deviation_mm_{};  ///< of the tool in this field
  Mm<S> reach_mm_{};
  Mm<S> undisputed_mm_{};  ///< reach_mm_ before any later picture refuted the prediction
  Mm<S> strayed_mm_{};     ///< how far the tool shown may be off besides, while coasting
};

}  // namespace tubesight::core::tracking
