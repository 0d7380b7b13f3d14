#pragma once

#include <optional>

#include "core/base/scalar.h"
#include "core/base/vector3.h"
#include "core/tracking/normal_equations.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// Where the guidetube's axis meets the tubesheet [Fallon eq. 6.15-6.25].
template <Scalar S>
struct ToolPoint {
  Vector2<Mm<S>> local{};  ///< on the sheet, mm from the anchor's centre
  Vector3<Mm<S>> point{};  ///< the same in the camera frame
  Mm<S> height_mm{};       ///< distance of the tip from the plane of the tube-ends

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [on_sheet, in_camera, height] = self;
    stream(on_sheet, in_camera, height);
  }
};

/// Intersects the axis with the plane: Eq. 6.17 to 6.21, for a sheet that may lean against the
/// guidetube, whose axis and normal the source takes as parallel. Empty when they are over 25
/// degrees apart.
template <Scalar S>
[[nodiscard]] std::optional<ToolPoint<S>> find_tool_point(const TrackingModel<S>& model,
                                                          const SheetPose<S>& pose);

/// The standard deviation of the tool point on the sheet, mm (root of the sum over both
/// directions), for edges of `kEdgeDeviationQ10`. `equations` as fit_pose() left them.
template <Scalar S>
[[nodiscard]] Mm<S> tool_point_deviation(const SheetPose<S>& pose, const ToolPoint<S>& tool,
                                         const NormalEquations<S>& equations);

/// Whether the guidetube surely does not stand before a tube's site, wherever it is seen from: in
/// the picture the site is clear of the guidetube, which runs from its tip away from the sheet and
/// is taken to be as thick as the shortest lattice step. False where that cannot be told.
template <Scalar S>
[[nodiscard]] bool clear_of_guidetube(const TrackingModel<S>& model, const SheetPose<S>& pose,
                                      TubeAddress address);

}  // namespace tubesight::core::tracking
