#pragma once

#include <cstdint>

#include "core/base/constant.h"
#include "core/base/image_view.h"
#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/tracking/candidates.h"
#include "core/tracking/field_measurement.h"
#include "core/tracking/map_shift.h"
#include "core/tracking/normal_equations.h"
#include "core/tracking/pose_fit.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/start.h"
#include "core/tracking/tool_point.h"
#include "core/tracking/tracking_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::tracking {

/// What is expected of a field before it is looked at.
template <Scalar S>
struct Expectation {
  SheetPose<S> pose{};       ///< the predicted one
  Mm<S> reach_mm{};          ///< how far the tool may be from where it puts it
  bool from_motion = false;  ///< turn and height are as predicted, but for what a field may change
  bool confirm_all =
      false;  ///< the tube-ends looked at must be there: half, or many where it is dark
};

/// How well height, heading and lean are known, one standard deviation each.
template <Scalar S>
struct AttitudeDeviation {
  Mm<S> height_mm{};
  Mm<S> heading_rad{};
  Mm<S> lean_rad{};

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [height, heading, lean] = self;
    stream(height, heading, lean);
  }
};

/// What a look at one field found.
template <Scalar S>
struct Observation {
  bool fitted = false;             ///< pose, tool and deviations are valid
  Reason trouble = Reason::kNone;  ///< why it is not fitted
  bool contradiction = false;      ///< the picture is good and refutes the expectation
  std::int32_t looked_at = 0;      ///< tube-ends that should be seen wholly
  PoseFit<S> fit{};
  SheetPose<S> pose{};
  ToolPoint<S> tool{};
  Mm<S> deviation_mm{};          ///< of the tool on the sheet, one standard deviation
  Mm<S> picture_deviation_mm{};  ///< the picture's share of it
  AttitudeDeviation<S> attitude{};

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [is_fitted, why_not, refuted, looked, fitting, sheet, tool_at, deviation,
           picture_deviation, attitudes] = self;
    stream(is_fitted);
    stream.choice(why_not, kLastReason);
    stream(refuted);
    stream.number(looked, 0, 2 * kMaxTubesInView);
    stream(fitting, sheet, tool_at, deviation, picture_deviation, attitudes);
  }
};

/// What the fit, the calibration and the sheet leave uncertain even on a perfect picture, mm.
template <typename M>
[[nodiscard]] M systematic_deviation_mm() {
  return constant<M>(0.1);
}

/// Looks at fields: light, tube-ends where they are expected, pose, tool point, and how well all
/// that is known. It says what the picture shows and believes nothing.
///
/// Light levels and recognised plugs are learnt from field to field. `model` and `map` outlive it.
template <Scalar S>
class SheetObserver {
 public:
  SheetObserver(const TrackingModel<S>& model, const tubesheet::SheetMap& map)
      : model_(&model), map_(&map) {}

  /// A new start: what was learnt of light and plugs is forgotten.
  void begin() { begin(first_light<S>(*model_)); }
  /// In this light.
  void begin(const LightLevels& light);

  /// No tube-ends are seen in this field, or none that may be told.
  void clear_field() { record_.begin_field(); }

  /// Looks where the tube-ends are expected. Some 20,000 instructions a tube-end in view.
  [[nodiscard]] Observation<S> observe(const FieldView& field, const Expectation<S>& expected);

  /// observe() that learns nothing: for a picture that is not believed. A number that leaves its
  /// range costs this look alone: it shows nothing then.
  [[nodiscard]] Observation<S> glance(const FieldView& field, const Expectation<S>& expected);

  /// Whether the field looked at last fits the settings' lists better with other addresses.
  [[nodiscard]] bool fits_other_addresses() const {
    return tracking::fits_other_addresses<S>(*model_, *map_, record_);
  }

  /// Tube-ends, plugs and closed sites of the field looked at last.
  [[nodiscard]] const FieldRecord<S>& record() const { return record_; }

  /// The members of the state; see core/base/state_stream.h. Model and map are the settings', and
  /// the last three are written in each field before they are read.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [model, map, record, candidates, closed, equations] = self;
    stream(record);
  }

 private:
  [[nodiscard]] bool outweighs_bright(const PoseFit<S>& fit) const;
  [[nodiscard]] FindingCount measure_in_any_light(const FieldView& field, std::int32_t range_px,
                                                  const PosePrior<S>& prior, Observation<S>& seen);
  [[nodiscard]] FindingCount measure(const FieldView& field, std::int32_t range_px,
                                     const PosePrior<S>& prior, Observation<S>& seen);

  const TrackingModel<S>* model_;
  const tubesheet::SheetMap* map_;
  FieldRecord<S> record_{};
  CandidateList<S> candidates_{};
  SiteList<S> closed_{};  ///< that should be
  NormalEquations<S> equations_{};
};

}  // namespace tubesight::core::tracking
