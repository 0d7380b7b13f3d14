#pragma once

#include <array>
#include <cstdint>

#include "core/base/field.h"
#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/tracking/sheet_pose.h"

namespace tubesight::core::verification {

/// What the box saw in one of the last fields.
template <Scalar S>
struct RecentField {
  Sighting sighting;
  tracking::SheetPose<S> pose{};  ///< valid while tracking or degraded

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [seen, sheet] = self;
    stream(seen, sheet);
  }
};

/// The sightings of the last fields, so that a claim, a pick or a start that speaks of a field gone
/// by is judged in that field [Fallon 6.4 judges in the present one].
///
/// Two seconds at 120 fields a second, missing ones counted. One thread; no heap; some 60 KB.
template <Scalar S>
class RecentFields {
 public:
  static constexpr std::int32_t kCapacity = 256;

  /// Nothing is known of what was before.
  void clear() {
    if (count_ > 0) {
      forgot_ = true;
      forgotten_ = newest_;
    }
    count_ = 0;
  }

  /// Takes the place of the oldest when there are kCapacity. Where the time of fields does not go
  /// on, those before are of another clock, and forgotten.
  void push(const RecentField<S>& field) {
    if (field.sighting.status != FieldStatus::kMissing) {
      if (came_ && field.sighting.time <= last_came_) {
        count_ = 0;
        forgot_ = false;
      }
      came_ = true;
      last_came_ = field.sighting.time;
    }
    fields_[slot(count_)] = field;
    ++count_;
    newest_ = count_ == 1 ? field.sighting.time : max_of(newest_, field.sighting.time);
  }

  [[nodiscard]] bool empty() const { return count_ == 0; }
  /// The field that was pushed last; needs one.
  [[nodiscard]] const RecentField<S>& last() const { return fields_[slot(count_ - 1)]; }
  /// The latest instant of all: a field that was given up may be older than one that came late.
  [[nodiscard]] FieldTime newest() const { return newest_; }

  /// The field nearest to an instant, of two the one pushed first; null when there is none.
  [[nodiscard]] const RecentField<S>* nearest(FieldTime instant) const {
    const RecentField<S>* best = nullptr;
    for (std::int64_t i = first(); i < count_; ++i) {
      const RecentField<S>& field = fields_[slot(i)];
      if (best == nullptr ||
          distance(field.sighting.time, instant) < distance(best->sighting.time, instant)) {
        best = &field;
      }
    }
    return best;
  }

  /// Whether a field that clear() forgot was nearer to an instant than all that are kept, or as
  /// near.
  [[nodiscard]] bool forgot_nearer(FieldTime instant) const {
    const RecentField<S>* const kept = nearest(instant);
    return forgot_ && (kept == nullptr ||
                       distance(forgotten_, instant) <= distance(kept->sighting.time, instant));
  }

  /// The field with this number; null when it is none of those kept.
  [[nodiscard]] const RecentField<S>* find(std::int64_t number) const {
    for (std::int64_t i = count_ - 1; i >= first(); --i) {
      if (fields_[slot(i)].sighting.field == number) {
        return &fields_[slot(i)];
      }
    }
    return nullptr;
  }

  [[nodiscard]] static constexpr FieldTime distance(FieldTime a, FieldTime b) {
    return a > b ? a - b : b - a;
  }

  /// The members of the state; see core/base/state_stream.h. Of the ring what is filled.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [fields, count, newest_time, came, last_time, forgot, forgotten_time] = self;
    stream.number(count, 0, std::int64_t{1} << 62);
    stream(newest_time, came, last_time, forgot, forgotten_time);
    if constexpr (Stream::kShape) {
      stream(fields[0]);
    } else {
      for (std::int64_t i = self.first(); i < count; ++i) {
        stream(fields[slot(i)]);
      }
    }
  }

 private:
  [[nodiscard]] static constexpr FieldTime max_of(FieldTime a, FieldTime b) {
    return a > b ? a : b;
  }
  [[nodiscard]] static std::size_t slot(std::int64_t index) {
    return static_cast<std::size_t>(index % kCapacity);
  }
  [[nodiscard]] std::int64_t first() const { return count_ > kCapacity ? count_ - kCapacity : 0; }

  std::array<RecentField<S>, static_cast<std::size_t>(kCapacity)> fields_{};
  std::int64_t count_ = 0;
  FieldTime newest_{0};
  bool came_ = false;
  FieldTime last_came_{0};  ///< of the last field that was not missing
  bool forgot_ = false;
  FieldTime forgotten_{0};  ///< the latest instant that clear() forgot
};

}  // namespace tubesight::core::verification
