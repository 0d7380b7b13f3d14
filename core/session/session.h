#pragma once

#include <cstdint>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/base/sighting.h"
#include "core/tracking/tracker.h"

namespace tubesight::core::session {

/// What one step is given.
struct Input {
  Field field;
  EventList events;  ///< since the last field, in time order
};

/// What one step leaves; reused from field to field.
struct Output {
  Sighting sighting;
  tracking::TubeSightingList tubes;                 ///< measured tube-ends and recognised plugs
  ReplyList replies;                                ///< in the order of their making
  std::int32_t lamp_permille = kFullLamp_permille;  ///< level wanted
  PoseOrder order;  ///< a pose to compute, from this field's picture on
};

/// Fields that a pose request waits for its result; then another one is taken. Ten seconds of 60
/// fields: averaging and fitting take well below one.
inline constexpr std::int32_t kPoseRequestLasts = 600;

/// The vision box without its ports: fields and events in, answers out.
///
/// step() never waits, never allocates, never asks a clock, and given the same inputs leaves the
/// same bytes on every machine in fixed point. One thread calls it. About 300 KB with the sheet's
/// map, of which tracking_state_bytes() are the tracking state.
template <Scalar S>
class Session {
 public:
  Session() : tracker_(model_, map_) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Takes the settings over. kOutOfRange, kIllConditioned, kInvalidArgument as
  /// make_tracking_model() and SheetMap::assign(). Call once, before step().
  [[nodiscard]] Result<void> configure(const SessionSettings& settings);

  /// Processes one field with the events before it. Start events take effect in this field.
  ///
  /// A pose request that is taken leaves an order in the output; whoever computes poses hands the
  /// result to a later step as an event, so that step() never waits and a recording with its events
  /// replays exactly.
  void step(const Input& input, Output& output);

  /// Switches the tracker's margin check off: the self-proof of the campaign, which must then find
  /// wrong tubes. Call after configure(); nothing else may.
  void disable_margin_check_for_self_proof() { model_.margin_check = false; }

  /// The tracker, for estimates and places of tubes in the last field's picture.
  [[nodiscard]] const tracking::Tracker<S>& tracker() const { return tracker_; }

  [[nodiscard]] static constexpr std::int32_t tracking_state_bytes() {
    return static_cast<std::int32_t>(sizeof(tracking::Tracker<S>) +
                                     sizeof(tracking::TrackingModel<S>));
  }

 private:
  tracking::TrackingModel<S> model_{};
  tubesheet::SheetMap map_{};
  [[nodiscard]] PoseRequestReply answer_pose_request(const Event& event, Output& output);

  tracking::Tracker<S> tracker_;
  std::int32_t pose_awaited_ = 0;  ///< fields that the pending pose request has left
};

}  // namespace tubesight::core::session
