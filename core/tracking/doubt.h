#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/sighting.h"

namespace tubesight::core::tracking {

/// Counts the pictures that refuted the prediction.
///
/// One field torn, repeated or of noise is passed over; three in a row are a jump. What comes
/// behind one may be another false picture that happens to fit, so two in a row must agree before a
/// tube is named again, on three tube-ends each: two fit any pattern somewhere.
class Doubt {
 public:
  void clear() { *this = {}; }

  /// A good picture refuted the prediction, for this reason.
  void raise(Reason reason) {
    reason_ = reason;
    to_agree_ = kMustAgree;
    ++contradictions_;
  }
  /// A field was believed, on so many tube-ends.
  void agree(std::int32_t tube_ends) {
    contradictions_ = 0;
    if (tube_ends >= kFewest) {
      to_agree_ = std::max(to_agree_ - 1, 0);
    }
  }

  /// The last picture that was good refuted the prediction.
  [[nodiscard]] bool contradicted() const { return contradictions_ > 0; }
  /// It was one too many in a row: the track is wrong.
  [[nodiscard]] bool is_certainty() const { return contradictions_ > kMostContradictions; }
  /// No tube may be named yet.
  [[nodiscard]] bool lasts() const { return to_agree_ > 0; }
  /// Why; valid while it lasts.
  [[nodiscard]] Reason reason() const { return reason_; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [contradictions, to_agree, why] = self;
    stream.number(contradictions, 0, 1 << 30);
    stream.number(to_agree, 0, kMustAgree);
    stream.choice(why, kLastReason);
  }

 private:
  static constexpr std::int32_t kMostContradictions = 2;
  static constexpr std::int32_t kMustAgree = 2;
  static constexpr std::int32_t kFewest = 3;

  std::int32_t contradictions_ = 0;  ///< fields in a row that refuted the prediction
  std::int32_t to_agree_ = 0;        ///< fields that must agree before a tube is named again
  Reason reason_ = Reason::kNone;
};

}  // namespace tubesight::core::tracking
