#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/base/sighting.h"
#include "core/lighting/lamp_policy.h"
#include "core/lighting/lighting.h"
#include "core/tracking/margin_policy.h"
#include "core/tracking/tracker.h"
#include "core/verification/claim_judge.h"
#include "core/verification/pose_requests.h"
#include "core/verification/recent_fields.h"
#include "core/verification/start_judge.h"

namespace tubesight::core::session {

/// What one step is given.
struct Input {
  Field field;
  EventList events;          ///< since the last field, in time order
  bool lamp_dimmed = false;  ///< somebody sets the lamp to the level wanted
};

/// What one step leaves; reused from field to field.
struct Output {
  Sighting sighting;
  tracking::TubeSightingList tubes;                 ///< measured tube-ends and recognised plugs
  ReplyList replies;                                ///< in the order of their making
  std::int32_t lamp_permille = kFullLamp_permille;  ///< level wanted
  bool lamp_ruled = false;      ///< the session means that level: somebody took the lamp for it
  bool lamp_automatic = false;  ///< that level follows the picture: nobody has commanded one
  lighting::LampCondition lamp = lighting::LampCondition::kUnknown;  ///< as the picture shows it
  PoseOrder order;  ///< a pose to compute, from this field's picture on
};

/// The vision box without its ports: fields and events in, answers out.
///
/// step() never waits, never allocates, never asks a clock, and given the same inputs leaves the
/// same bytes on every machine in fixed point. One thread calls it. About 400 KB with the sheet's
/// map, of which tracking_state_bytes() are the tracking state. `Margin` is the tracker's policy.
template <Scalar S, typename Margin = tracking::MarginChecked>
class Session {
 public:
  Session() : tracker_(model_, map_), starts_(model_) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Takes the settings over. kOutOfRange, kIllConditioned, kInvalidArgument as
  /// make_tracking_model() and SheetMap::assign(). Call once, before step().
  [[nodiscard]] Result<void> configure(const SessionSettings& settings);

  /// Lets the session rule the lamp by this policy, and look for its light in the picture, from the
  /// beginning. Call after configure(), before the first step; without it the level is the robot's
  /// alone and no liveness is known.
  void take_lamp(const lighting::LampPolicy& policy) { lighting_.take(policy); }

  /// Processes one field with the events before it. Start events take effect in this field.
  ///
  /// A missing field (FieldStatus::kMissing) is a step as well: the track ages and coasts as with a
  /// damaged one, and claims of that instant are answered "unknown".
  ///
  /// Claims are judged at their own instant (verification::ClaimJudge) and may be answered some
  /// steps later; all other events are answered in the step that they came with. Picks and starts
  /// are judged in the field that was seen (judge_pick(), StartJudge).
  ///
  /// A pose request that is taken leaves an order in the output; whoever computes poses hands the
  /// result to a later step as an event, so that step() never waits and a recording with its events
  /// replays exactly.
  void step(const Input& input, Output& output);

  /// What save() needs at most.
  [[nodiscard]] static constexpr std::size_t state_bytes();

  /// Writes down what the next steps depend on besides their inputs and the settings: a session of
  /// the same settings that restores it goes on as this one would, to the byte. Gives the number of
  /// bytes written, the same on every machine; some 50 KB once the recent fields are filled, in
  /// some 50 us. Between two steps; no heap.
  ///
  /// The block says its length, its version, the arithmetic, the shape of what it holds, a digest
  /// of the settings, and a check sum. Errors: kBufferTooSmall.
  [[nodiscard]] Result<std::size_t> save(std::span<std::byte> into) const;

  /// Goes on from where another session was saved. Call after configure(), before the first step.
  ///
  /// Bytes are believed by nobody. Errors, after the last of which the session must be configured
  /// anew as another object: kDataLoss no whole block, or a damaged one; kUnsupported one of
  /// another version of this program or another arithmetic; kInvalidArgument one of other settings;
  /// kOutOfRange it holds what no session can have come to.
  [[nodiscard]] Result<void> restore(std::span<const std::byte> from);

  /// The lamp's closed loop.
  [[nodiscard]] const lighting::Lighting& lighting() const { return lighting_; }

  /// The tracker, for estimates and places of tubes in the last field's picture.
  [[nodiscard]] const tracking::Tracker<S, Margin>& tracker() const { return tracker_; }

  [[nodiscard]] static constexpr std::int32_t tracking_state_bytes() {
    return static_cast<std::int32_t>(sizeof(tracking::Tracker<S, Margin>) +
                                     sizeof(tracking::TrackingModel<S>));
  }

 private:
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream);
  [[nodiscard]] bool take_starts(const Field& field, const EventList& events);
  void follow_lamp(const Input& input, Output& output);
  void remember(Sighting& sighting);
  void answer(const Event& event, const Input& input, std::int32_t& start, Output& output);

  tracking::TrackingModel<S> model_{};
  tubesheet::SheetMap map_{};
  tracking::Tracker<S, Margin> tracker_;
  TrackState state_ = TrackState::kWaiting;
  std::int64_t judged_fields_ = 0;
  FieldTime last_judged_{0};
  std::optional<std::int32_t> lamp_wanted_;  ///< what was commanded last
  lighting::Lighting lighting_;

  verification::RecentFields<S> recent_;
  verification::ClaimJudge<S> claims_;
  verification::StartJudge<S> starts_;
  verification::PoseRequests poses_;
  StaticVector<StartRefusal, kMaxEventsPerField> start_refusals_;  ///< of this field's starts
  std::uint64_t settings_digest_ = 0;
};

template <Scalar S, typename Margin>
constexpr std::size_t Session<S, Margin>::state_bytes() {
  // A value takes no more bytes there than here; 256 for head, check sum and what stands alone.
  return sizeof(tracker_) + sizeof(recent_) + sizeof(claims_) + sizeof(starts_) + sizeof(poses_) +
         sizeof(lighting_) + 256;
}

}  // namespace tubesight::core::session
