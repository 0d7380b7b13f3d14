#pragma once

#include <cstdint>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/result.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/base/sighting.h"
#include "core/tracking/tracker.h"

namespace tubesight::core::session {

/// What one step is given.
struct Input {
  Field field;
  std::int32_t lamp_permille = 1000;  ///< level in force while the field was exposed
  EventList events;                   ///< since the last field, in time order
};

/// What the box says to an event.
struct Reply {
  /// How the event was answered.
  enum class Verdict : std::uint8_t {
    kConfirmed,     ///< claim: the box vouches for that tube; pick: `tube` stands there
    kContradicted,  ///< claim: the box vouches for `tube` instead
    kUnknown,       ///< the box cannot tell
    kTaken,         ///< start: tracking began
    kRefused,       ///< start: see `refusal`
    kNotServed,     ///< this build has nobody to answer that kind of event
  };
  EventKind kind = EventKind::kClaim;
  Verdict verdict = Verdict::kUnknown;
  TubeAddress tube{};
  tracking::StartRefusal refusal = tracking::StartRefusal::kNone;
};

using ReplyList = StaticVector<Reply, kMaxEventsPerField>;

/// What one step leaves; reused from field to field.
struct Output {
  Sighting sighting;
  tracking::TubeSightingList tubes;   ///< measured tube-ends and recognised plugs
  ReplyList replies;                  ///< one for each event, in order
  std::int32_t lamp_permille = 1000;  ///< level wanted
};

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
  void step(const Input& input, Output& output);

  /// The tracker, for estimates and places of tubes in the last field's picture.
  [[nodiscard]] const tracking::Tracker<S>& tracker() const { return tracker_; }

  [[nodiscard]] static constexpr std::int32_t tracking_state_bytes() {
    return static_cast<std::int32_t>(sizeof(tracking::Tracker<S>) +
                                     sizeof(tracking::TrackingModel<S>));
  }

 private:
  tracking::TrackingModel<S> model_{};
  tubesheet::SheetMap map_{};
  tracking::Tracker<S> tracker_;
};

}  // namespace tubesight::core::session
