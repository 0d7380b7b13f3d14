#pragma once

#include <cstdint>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/scalar.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/still_picture.h"
#include "core/tracking/tracking_model.h"
#include "core/verification/recent_fields.h"

namespace tubesight::core::verification {

/// Says whether clicks into a picture gone by hold in the present one: only if the tool has stood
/// still ever since.
///
/// While the box tracks, the track tells; while it waits or is lost, the pictures do. Where the one
/// takes over from the other the rest begins anew, and so it does where fields are missing for as
/// long as the tool needs to the next tube: a start is no field that the track has followed. One
/// thread; no heap.
template <Scalar S>
class StartJudge {
 public:
  /// `model` outlives the judge.
  explicit StartJudge(const tracking::TrackingModel<S>& model) : model_(&model) {}

  /// Call once `model` is made, before the first field.
  void configure();

  /// Looks at a field before it is tracked. `tracking`: the box tracked in the field before.
  void look(const Field& field, bool tracking);

  /// Why clicks may not be taken in the field looked at last; kNone: they may.
  [[nodiscard]] StartRefusal judge(const Start& start) const;

  /// Takes what the tracker made of the field looked at last.
  void follow(const RecentField<S>& field);

  /// The members of the state; see core/base/state_stream.h. Model and longest gap are the
  /// settings'.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [model, picture, rest_pose, rest_since, tracked_rest, by_track, in_time, longest_gap,
           last_time, last_sequence, present] = self;
    constexpr std::int64_t kMostCounted = std::int64_t{1} << 62;  // differences fit
    stream(picture, rest_pose);
    stream.number(rest_since, -1, kMostCounted);
    stream(tracked_rest, by_track, in_time, last_time);
    stream.number(last_sequence, -kMostCounted, kMostCounted);
    stream.number(present, -1, kMostCounted);
  }

 private:
  [[nodiscard]] bool has_moved(const tracking::SheetPose<S>& pose) const;

  const tracking::TrackingModel<S>* model_;
  tracking::StillPicture picture_;
  tracking::SheetPose<S> rest_pose_{};  ///< how the sheet stood when the tracked rest began
  std::int64_t rest_since_ = 0;         ///< field of that
  bool tracked_rest_ = false;
  bool by_track_ = false;  ///< the track tells
  bool in_time_ = false;   ///< the present field follows the one before it closely enough for that
  FieldTime longest_gap_{0};
  FieldTime last_time_{0};  ///< of the last field that came
  std::int64_t last_sequence_ = 0;
  std::int64_t present_ = -1;
};

}  // namespace tubesight::core::verification
