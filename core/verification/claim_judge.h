#pragma once

#include <cstdint>
#include <optional>

#include "core/base/event.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/base/static_vector.h"
#include "core/tracking/tracking_model.h"
#include "core/verification/recent_fields.h"

namespace tubesight::core::verification {

/// What decides whether a field speaks for a claim's instant.
struct ClaimLimits {
  FieldTime within{0};         ///< longest way in time from the instant to the field judged by
  FieldTime oldest{0};         ///< age at which a claim is answered no more; as far ahead, too
  std::int64_t step_um = 0;    ///< shortest distance of two tubes
  std::int64_t max_um_s = 0;   ///< of [motion]
  std::int64_t max_um_s2 = 0;  ///< of [motion]
};

/// The limits of a session's settings. Double precision as make_tracking_model().
[[nodiscard]] ClaimLimits make_claim_limits(const VerificationSettings& verification,
                                            const MotionSettings& motion, double shortest_step_mm);

/// Judges claims at their own instant.
///
/// A claim speaks of where the tool was at its instant, which link and controller make some tens of
/// milliseconds older than the field that it meets: at 300 mm/s a tube-end goes by in 85 ms. So it
/// is judged by the field whose mid-exposure is nearest to its instant, and waits for the next
/// field where a nearer one may still come. Between that field and the instant the tool moved on by
/// its last speed and what [motion] lets it change: where that takes it beyond 0.4 of the shortest
/// step from the tube vouched for, the answer is "unknown", for another tube may be nearer then.
///
/// All in whole numbers; no heap.
template <Scalar S>
class ClaimJudge {
 public:
  void configure(const ClaimLimits& limits) { limits_ = limits; }

  /// Answers the claims that were waiting and can be judged now; call it once a field, after
  /// `recent` got that field. The replies are appended.
  void answer_waiting(const RecentFields<S>& recent, ReplyList& replies);

  /// Answers a claim that came with the last field of `recent`, or lets it wait.
  void take(const Event& event, const Claim& claim, const RecentFields<S>& recent,
            ReplyList& replies);

  /// What can be said to a claim made at `at`; empty while a nearer field may still come.
  [[nodiscard]] std::optional<ClaimReply> judge(const Claim& claim, FieldTime at,
                                                const RecentFields<S>& recent) const;

  /// The members of the state; see core/base/state_stream.h. The limits are the settings'.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [limits, waiting] = self;
    stream(waiting);
  }

 private:
  struct Waiting {
    std::int64_t id = 0;
    EventOrigin origin = EventOrigin::kRobot;
    FieldTime at{0};
    Claim claim;
    std::int32_t fields = 0;  ///< for how many it has waited

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [name, sender, instant, content, waited] = self;
      auto& [tube] = content;
      stream(name);
      stream.choice(sender, EventOrigin::kOperator);
      stream(instant, tube);
      stream.number(waited, 0, 1 << 30);
    }
  };

  [[nodiscard]] ClaimReply judge_by(const Claim& claim, FieldTime at,
                                    const Sighting& sighting) const;
  [[nodiscard]] bool may_have_left(const Sighting& sighting, FieldTime span) const;

  ClaimLimits limits_;
  StaticVector<Waiting, kMaxWaitingClaims> waiting_;
};

}  // namespace tubesight::core::verification
