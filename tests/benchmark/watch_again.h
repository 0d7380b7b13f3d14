#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/field.h"
#include "core/lighting/brightness_trail.h"

namespace tubesight::benchmark {

/// A lamp of the first order, and light that is not its own: shares of the lamp's full light.
struct LampModel {
  double lag_s = 0.0;
  double ring = 0.0;
};

/// How the light of tube-ends changed that no lamp has to do with: noise, and the tool's motion.
struct OtherChange {
  bool known = false;
  double relative = 0.0;
  std::int64_t scatter_q32 = 0;
};

/// Takes what the lamp did out of the changes of fields that were drawn.
class ChangeRecorder {
 public:
  explicit ChangeRecorder(const LampModel& lamp) : lamp_(lamp) {}

  /// `change`: as the box's own trail told it.
  void take(const core::Field& field, const std::optional<core::lighting::LightChange>& change);
  [[nodiscard]] const std::vector<OtherChange>& changes() const { return changes_; }

 private:
  LampModel lamp_;
  double shine_ = -1.0;
  std::array<double, 2> before_ = {-1.0, -1.0};
  std::vector<OtherChange> changes_;
};

/// What runs of two minutes of a sound lamp came to.
struct SoundHours {
  std::int64_t fields = 0;
  std::int64_t proved = 0;
  std::int64_t doubted = 0;    ///< fields in which nothing would have been vouched for
  std::int64_t alarms = 0;     ///< times that the picture was said not to follow
  double first_proof_s = 0.0;  ///< the slowest
  std::int32_t least_score_q4 = 0;
};

/// The box's watch and pattern before a sound lamp at 600 permille, with the changes of `changes`
/// in another order each time: hours in seconds, as nothing is drawn.
[[nodiscard]] SoundHours watch_sound(const std::vector<OtherChange>& changes, const LampModel& lamp,
                                     double hours, std::uint64_t seed);

/// How soon pictures that know nothing of this lamp were told, from the fault on.
struct FaultRuns {
  std::int64_t runs = 0;
  std::int64_t told = 0;  ///< within 20 s
  std::int64_t within_2s = 0;
  std::int64_t within_10s = 0;
  double sum_s = 0.0;  ///< of those told
  double most_s = 0.0;
};

/// After 14 s of a sound one, another lamp like it with an order of its own, or, `frozen`, none.
[[nodiscard]] FaultRuns watch_faults(const std::vector<OtherChange>& changes, const LampModel& lamp,
                                     bool frozen, std::int64_t runs, std::uint64_t seed);

}  // namespace tubesight::benchmark
