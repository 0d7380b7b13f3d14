#pragma once

#include <cstdint>

#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/base/vector3.h"
#include "core/tracking/field_measurement.h"
#include "core/tracking/motion.h"
#include "core/tracking/primary_tube.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tool_point.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Tubes that a field's output can tell of: the measured ones and recognised plugs.
using TubeSightingList = StaticVector<TubeSighting, kMaxTubesInView + 64>;

/// How the sheet stands, and where the tool is over it.
template <Scalar S>
struct Place {
  SheetPose<S> pose{};
  ToolPoint<S> tool{};

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [sheet, tool_at] = self;
    stream(sheet, tool_at);
  }
};

/// The tube nearest to the tool.
template <Scalar S>
struct NearestTube {
  TubeAddress address{};
  Vector2<Mm<S>> off{};  ///< from its centre to the tool point
  Mm<S> to_edge_mm{};    ///< from the tool point to the edge of its cell
};

template <Scalar S>
[[nodiscard]] NearestTube<S> find_nearest_tube(const TrackingModel<S>& model,
                                               const Place<S>& place);

/// Image of a tube's centre; false where it cannot be projected.
template <Scalar S>
[[nodiscard]] bool locate_tube(const TrackingModel<S>& model, const SheetPose<S>& pose,
                               TubeAddress address, ImagePoint& pixel);

/// Tells of the tube-ends and plugs of a field: all of them in `tubes`, and in `sighting` how many
/// were used and the primary one.
template <Scalar S>
void report_tubes(const FieldRecord<S>& record, const PrimaryTube& primary, Sighting& sighting,
                  TubeSightingList& tubes);

/// Tells where the tool's axis meets the sheet and how it moves, whatever tube that is.
template <Scalar S>
void report_axis(const TrackingModel<S>& model, const Place<S>& place, const Motion<S>& motion,
                 Sighting& sighting);

/// Tells the margin, in deviations.
template <typename M>
void report_margin(M margin, Sighting& sighting) {
  sighting.margin_known = true;
  sighting.margin_permyriad =
      static_cast<std::int32_t>(divide_rounded(std::int64_t{to_scaled(margin, 16)} * 10000, 65536));
}

/// Names the tube and tells the tool's offset from it. Vouched for (aligned) only when
/// sighting.judged is set.
template <Scalar S>
void report_tool(const TrackingModel<S>& model, const SheetPose<S>& pose,
                 const NearestTube<S>& nearest, Sighting& sighting);

}  // namespace tubesight::core::tracking
