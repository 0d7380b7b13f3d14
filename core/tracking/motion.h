#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/base/scalar.h"
#include "core/base/vector3.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tool_point.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// A time span of a field or a few in seconds, up to one second.
template <Scalar S>
[[nodiscard]] Unit<S> seconds(FieldTime span);

/// How the tool moved between the last two good fields.
template <Scalar S>
struct Motion {
  bool known = false;
  Unit<S> interval_s{};            ///< between those fields
  Vector2<Mm<S>> velocity_mm_s{};  ///< of the tool point over the sheet, sheet axes
  Mm<S> approach_mm_s{};           ///< of the height
  Vector3<Mm<S>> turn_rad_s{};     ///< of the sheet before the camera, camera axes

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [is_known, interval, velocity, approach, turn] = self;
    stream(is_known, interval, velocity, approach, turn);
  }
};

/// Slower than that over the sheet a tool rests: tube-ends stay where they are in picture and
/// light.
inline constexpr std::int32_t kRest_mm_s = 3;

/// How far tool and picture stand still, as a picture tells.
enum class Rest : std::uint8_t {
  kNone,
  /// Under kRest_mm_s over the sheet, and under 10 mm/s in height and 7 degrees a second in any
  /// turn, which few tube-ends tell no better: the picture moves by half a pixel at most.
  kNearly,
  /// Under kRest_mm_s in height, too, a twentieth of a millimetre from field to field, and 2
  /// degrees a second.
  kStill,
};

template <Scalar S>
[[nodiscard]] Rest rest_of(const Motion<S>& motion);

/// Whether the tool moves so fast, over 30 mm/s, that between two fields of one parity every edge
/// of the picture does by pixels.
template <Scalar S>
[[nodiscard]] bool travels(const Motion<S>& motion);

/// The pose after `span_s` at constant motion.
template <Scalar S>
[[nodiscard]] SheetPose<S> predict(const TrackingModel<S>& model, const SheetPose<S>& pose,
                                   const ToolPoint<S>& tool, const Motion<S>& motion,
                                   Unit<S> span_s);

/// How far from the predicted tool point the tool can be after `span_s` within the limits of
/// [motion], mm.
///
/// The velocity is a mean over the last interval and so half an interval old: a constant
/// acceleration a leads a span (span + interval) / 2 * a astray. Nothing moves farther than at the
/// greatest speed from one extreme to the other.
///
/// After a start the motion is unknown. What is seen at a distance d from the last place is then
/// the same tube-end as long as d plus the greatest speed's way stays below a lattice step; beyond,
/// the tool is taken to have been at rest when an operator clicked into its picture. That holds for
/// any region that is looked at, so that it is drawn as narrow as `deviation_mm`, of the last
/// place, needs to keep within address_limit_mm(); a tool that has left it is not found. It is
/// never narrower than what a tool at rest when clicked can reach.
template <Scalar S>
[[nodiscard]] Mm<S> reachable_mm(const TrackingModel<S>& model, const Motion<S>& motion,
                                 Unit<S> span_s, Mm<S> deviation_mm);

/// How far the tool may be from where it is expected, all told: 0.4 of the shortest lattice step.
/// Beyond, the nearest tube-end might be a neighbour.
template <Scalar S>
[[nodiscard]] Mm<S> address_limit_mm(const TrackingModel<S>& model);

/// What the last velocity's own uncertainty adds to a place predicted over `span_s`: the difference
/// of two places, each known to `place_mm` (one standard deviation of what differs from picture to
/// picture), over their interval, carried on over the span. 0 while the motion is not known.
template <Scalar S>
[[nodiscard]] Mm<S> velocity_deviation_mm(const Motion<S>& motion, Mm<S> place_mm, Unit<S> span_s);

/// The small turn from one pose to another, rad, camera axes; to the third order.
template <Scalar S>
[[nodiscard]] Vector3<Mm<S>> turn_between(const SheetPose<S>& before, const SheetPose<S>& after);

/// The motion from one fitted pose to the next; both with the same anchor.
template <Scalar S>
[[nodiscard]] Motion<S> motion_between(const SheetPose<S>& before, const ToolPoint<S>& tool_before,
                                       const SheetPose<S>& after, const ToolPoint<S>& tool_after,
                                       const Motion<S>& last, Unit<S> span_s);

}  // namespace tubesight::core::tracking
