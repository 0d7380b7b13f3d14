// From settings to the limits of claims; apart from the judge because it computes in double.

#include "core/verification/claim_judge.h"

namespace tubesight::core::verification {

ClaimLimits make_claim_limits(const VerificationSettings& verification,
                              const MotionSettings& motion, double shortest_step_mm) {
  constexpr double kNanoseconds = 1e9;
  constexpr double kMicrometres = 1e3;
  const auto time = [](double seconds) {
    return FieldTime(static_cast<std::int64_t>(seconds * kNanoseconds + 0.5));
  };
  const auto micrometres = [](double mm) { return static_cast<std::int64_t>(mm * kMicrometres); };
  return {time(verification.claim_within_s), time(verification.claim_oldest_s),
          micrometres(shortest_step_mm), micrometres(motion.max_speed_mm_s),
          micrometres(motion.max_acceleration_mm_s2)};
}

}  // namespace tubesight::core::verification
