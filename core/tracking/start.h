#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/base/reply.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/tracking/field_measurement.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::tracking {

using core::StartRefusal;

/// A click as the path takes it: address and full-frame position in 1/65536 px.
struct StartClick {
  TubeAddress address{};
  std::int32_t u_q16 = 0;
  std::int32_t v_q16 = 0;

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [tube, u, v] = self;
    stream(tube, u, v);
  }
};

using StartClickList = StaticVector<StartClick, kMaxStartPoints>;

/// Finds the pose from an operator's rough clicks in one field [Fallon 6.1].
///
/// Each click's tube-end is found by bisection; their centres on the virtual plane give heading,
/// height and place of a level sheet, whose handedness and residual refute wrong addresses. The
/// caller's fit on the whole window then confirms it. `pose` is written on kNone only.
template <Scalar S>
[[nodiscard]] StartRefusal find_start_pose(const TrackingModel<S>& model,
                                           const tubesheet::SheetMap& map, const FieldView& field,
                                           const StartClickList& clicks, LightLevels& light,
                                           SheetPose<S>& pose);

}  // namespace tubesight::core::tracking
