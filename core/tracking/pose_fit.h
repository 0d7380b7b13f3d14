#pragma once

#include <cstdint>

#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/tracking/normal_equations.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"
#include "core/tracking/tube_measurement.h"

namespace tubesight::core::tracking {

/// Standard deviation that one edge point of weight 1 is taken to have, px in 1/1024.
inline constexpr int kEdgeDeviationQ10 = 205;  // 0.2 px

/// The tube-ends measured in one field.
template <Scalar S>
using MeasurementList = StaticVector<TubeMeasurement<S>, kMaxTubesInView>;

/// How firmly the fit is held to what is known without the picture. A weight w stands for a
/// standard deviation of kEdgeDeviation / sqrt(w) in the unknown's unit (1/128 rad, mm).
template <Scalar S>
struct PosePrior {
  Mm<S> lean_weight{};    ///< the sheet's normal along the guidetube [Fallon 6.5, assumption 1]
  Mm<S> turn_weight{};    ///< no turn since the prediction
  Mm<S> height_weight{};  ///< no change of distance since the prediction
};

/// How a fit ended.
template <Scalar S>
struct PoseFit {
  bool solved = false;
  std::int32_t used = 0;  ///< tube-ends that agree with the plane
  Px<S> rms_px{};         ///< of their distances from the fitted places

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [is_solved, tubes, rms] = self;
    stream(is_solved);
    stream.number(tubes, 0, kMaxTubesInView);
    stream(rms);
  }
};

/// Fits the pose to all measured tube-ends by weighted least squares on the full projection,
/// leaning sheet included; tube-ends that disagree with the plane are marked unused.
///
/// `pose` is the prediction and becomes the fit. Gauss-Newton steps until nothing that matters
/// changes, four at most; the outlier limit follows the median distance. `equations` is left
/// factored at the last step, for deviations. Not solved with no tube-end or a singular geometry.
/// Some 2,500 instructions a tube-end.
template <Scalar S>
[[nodiscard]] PoseFit<S> fit_pose(const TrackingModel<S>& model, const PosePrior<S>& prior,
                                  MeasurementList<S>& tubes, NormalEquations<S>& equations,
                                  SheetPose<S>& pose);

}  // namespace tubesight::core::tracking
