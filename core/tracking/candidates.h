#pragma once

#include <cstdint>

#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::tracking {

/// A tube that the search window should show.
template <Scalar S>
struct Candidate {
  TubeAddress address{};
  TubeState state = TubeState::kOpen;
  Vector2<Mm<S>> local{};         ///< mm from the pose's anchor
  Vector2<Px<S>> center_px{};     ///< image of its centre
  std::int32_t distance2_px = 0;  ///< squared distance from the optimum point, px^2
};

template <Scalar S>
using CandidateList = StaticVector<Candidate<S>, kMaxTubesInView>;

/// Places where the settings say that no open tube-end is: plugs, and sites without a tube.
template <Scalar S>
using SiteList = StaticVector<Candidate<S>, 24>;

/// Lists the tubes whose centres the pose puts into the search window, nearest to the optimum point
/// first [Fallon 6.2]; when there are more than the list holds, the nearest. `closed` gets the
/// sites that should be closed in the same way; plugs are in both.
///
/// At most 64 x 64 addresses are looked at; some 150 instructions each.
template <Scalar S>
void list_candidates(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
                     const SheetPose<S>& pose, CandidateList<S>& candidates,
                     SiteList<S>* closed = nullptr);

}  // namespace tubesight::core::tracking
