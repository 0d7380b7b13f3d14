#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/base/sighting.h"
#include "core/tracking/field_cadence.h"

namespace tubesight::core::tracking {

/// Makes of the stamps and numbers of fields what a track must know of time: whether this field
/// can follow the last one, whether fields are missing before it, and how much time has passed
/// since the last field that was believed.
///
/// What is usual is learnt from the fields themselves, as neither the camera's rate nor by what its
/// counter grows is set: the shortest time from field to field, and what a sequence number lasts.
/// Where stamps waver and numbers do not (a host that stamps what it gets when it gets to it), the
/// numbers tell the time, by a cadence that is fitted to both. Integers alone.
class FieldClock {
 public:
  /// What has passed before a field.
  struct Passed {
    bool missing = false;  ///< fields are missing before it, or it is missing itself
    FieldTime
        since_good{};  ///< since the last good field, by stamps or by lost numbers: the longer
  };

  /// A new start: what is usual has to be learnt anew.
  void begin();

  /// Why a field cannot follow the last one: kTime, kSequence, or kNone.
  [[nodiscard]] Reason refuses(const Field& field) const;

  /// What has passed before a field that refuses() let through. Call once a field while tracking.
  [[nodiscard]] Passed pass(const Field& field);

  /// Notes a field that was believed; the start is one.
  void believe(const Field& field);

  /// Notes any field, when all is done with it; call in every step. A missing field is none: one
  /// that comes late after all may be older than its giving up.
  void see(const Field& field);

  /// Since the last good field, by the stamp alone.
  [[nodiscard]] FieldTime stamped_since_good(const Field& field) const {
    return field.mid_exposure - good_time_;
  }

  /// The shortest time from field to field; 0: not known.
  [[nodiscard]] std::int64_t usual_span_ns() const { return usual_span_ns_; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [good_time, good_sequence, seen_time, seen_sequence, usual_numbers, per_sequence,
           usual_span, cadence, stamp, good_wavers, even] = self;
    constexpr std::int64_t kMostCounted = (std::int64_t{1} << 62) - 1;  // differences fit
    stream(good_time);
    stream.number(good_sequence, -kMostCounted, kMostCounted);
    stream(seen_time);
    stream.number(seen_sequence, -kMostCounted, kMostCounted);
    stream.number(usual_numbers, 0, kMostCounted);
    stream.number(per_sequence, -kMostCounted, kMostCounted);
    stream.number(usual_span, -kMostCounted, kMostCounted);
    stream(cadence);
    stream.choice(stamp, FieldCadence::Stamp::kWavers);
    stream(good_wavers, even);
  }

 private:
  [[nodiscard]] std::int64_t numbers_since_seen(const Field& field) const {
    return field.sequence - seen_sequence_;
  }
  [[nodiscard]] std::int64_t passed_ns(const Field& field) const;
  [[nodiscard]] bool misses_fields(const Field& field);
  [[nodiscard]] FieldTime since_good(const Field& field);

  FieldTime good_time_{0};          ///< of the last good field
  std::int64_t good_sequence_ = 0;  ///< of the last good field
  FieldTime seen_time_{0};          ///< of the last field, good or not
  std::int64_t seen_sequence_ = 0;
  std::int64_t usual_numbers_ = 0;  ///< by which sequence numbers grow without a gap; 0: not known
  std::int64_t per_sequence_ns_ = 0;  ///< shortest time that a sequence number took; 0: not known
  std::int64_t usual_span_ns_ = 0;    ///< shortest time from field to field; 0: not known
  FieldCadence cadence_{};
  FieldCadence::Stamp stamp_{};  ///< of the field looked at last
  bool good_wavers_ = false;     ///< that of the last good field does
  bool even_ = false;            ///< all fields since the last good one keep the cadence
};

}  // namespace tubesight::core::tracking
