#include "tests/benchmark/watch_again.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/lighting/lamp_pattern.h"
#include "core/lighting/pattern_watch.h"
#include "drivers/simulated/dice.h"

namespace tubesight::benchmark {
namespace {

using core::Liveness;
using core::lighting::LightChange;
using core::lighting::PatternWatch;
using drivers::Dice;

constexpr double kPeriod_s = 1.0 / 60.0;
constexpr std::int32_t kLevel_permille = 600;
/// Changes that follow one another, until the order is cut: some seconds.
constexpr std::int64_t kFieldsOfAPiece = 300;

std::size_t lines_of(core::Parity parity) { return parity == core::Parity::kOdd ? 0 : 1; }

double relative(double now, double before) { return 2.0 * (now - before) / (now + before); }

double following_share(const LampModel& lamp) { return kPeriod_s / (kPeriod_s + lamp.lag_s); }

/// A lamp, what is seen of it, and the box's watch, field by field.
class WatchedLamp {
 public:
  WatchedLamp(const std::vector<OtherChange>& changes, const LampModel& lamp, std::uint64_t seed)
      : changes_(changes), lamp_(lamp), dice_(seed) {
    pattern_.begin(static_cast<std::uint32_t>(seed * 7919 + 5));
    watch_.begin();
    place_ = somewhere();
  }

  enum class Picture : std::uint8_t { kOurs, kFrozen, kAnothers };

  void step(Picture picture) {
    now_ += std::chrono::nanoseconds(16'666'667);
    shine_ += (level_permille_ - shine_) * following_share(lamp_);
    const double light = lamp_.ring + light_of(picture);
    core::Field field;
    field.mid_exposure = now_;
    field.parity = number_ % 2 == 0 ? core::Parity::kEven : core::Parity::kOdd;
    field.lamp_permille = level_permille_;
    double& before = before_[lines_of(field.parity)];
    const OtherChange& other = changes_[place_];
    std::optional<LightChange> change;
    if (before > 0.0 && other.known) {
      const double seen = relative(light, before) + other.relative;
      change =
          LightChange{static_cast<std::int32_t>(std::lround(seen * 65'536.0)), other.scatter_q32};
    }
    before = light;
    ++number_;
    place_ = number_ % kFieldsOfAPiece == 0 ? somewhere() : (place_ + 1) % changes_.size();
    watch_.follow(field, change);
    swing_permille_ = watch_.needs_wide_swing() ? core::lighting::kWideSwing_permille
                                                : core::lighting::kSwing_permille;
    level_permille_ = core::lighting::swung_permille(kLevel_permille, pattern_.sign_after(now_),
                                                     swing_permille_, 1000);
  }

  [[nodiscard]] const PatternWatch& watch() const { return watch_; }

 private:
  [[nodiscard]] std::size_t somewhere() {
    return static_cast<std::size_t>(dice_.between(0.0, 0.999) *
                                    static_cast<double>(changes_.size()));
  }

  double light_of(Picture picture) {
    if (picture == Picture::kOurs) {
      last_ = shine_ / 1000.0;
      return last_;
    }
    if (number_ % 3 == 1) {
      anothers_sign_ = dice_.share() < 0.5 ? -1.0 : 1.0;
    }
    anothers_swing_ +=
        (anothers_sign_ * swing_permille_ / 1000.0 - anothers_swing_) * following_share(lamp_);
    return picture == Picture::kFrozen ? last_ : last_ * (1.0 + anothers_swing_);
  }

  const std::vector<OtherChange>& changes_;
  LampModel lamp_;
  Dice dice_;
  PatternWatch watch_;
  core::lighting::LampPattern pattern_;
  core::FieldTime now_{std::chrono::seconds(5)};
  std::int32_t level_permille_ = kLevel_permille;
  std::int32_t swing_permille_ = 0;
  double shine_ = kLevel_permille;
  double last_ = 0.0;  ///< of ours, when the fault came
  double anothers_sign_ = 1.0;
  double anothers_swing_ = 0.0;
  std::array<double, 2> before_ = {-1.0, -1.0};
  std::int64_t number_ = 0;
  std::size_t place_ = 0;
};

}  // namespace

void ChangeRecorder::take(const core::Field& field, const std::optional<LightChange>& change) {
  shine_ = shine_ < 0.0 ? field.lamp_permille
                        : shine_ + (field.lamp_permille - shine_) * following_share(lamp_);
  const double light = shine_ / 1000.0 + lamp_.ring;
  double& before = before_[lines_of(field.parity)];
  OtherChange other;
  if (change && before > 0.0) {
    other = {true, change->mean_q16 / 65'536.0 - relative(light, before), change->scatter_q32};
  }
  before = light;
  changes_.push_back(other);
}

SoundHours watch_sound(const std::vector<OtherChange>& changes, const LampModel& lamp, double hours,
                       std::uint64_t seed) {
  constexpr std::int64_t kFields = 120 * 60;
  SoundHours all;
  for (std::int64_t run = 0; run < std::llround(hours * 30.0); ++run) {
    WatchedLamp watched(changes, lamp, seed + static_cast<std::uint64_t>(run));
    double first_s = 120.0;
    bool failed = false;
    for (std::int64_t field = 0; field < kFields; ++field) {
      watched.step(WatchedLamp::Picture::kOurs);
      const Liveness liveness = watched.watch().liveness();
      ++all.fields;
      all.proved += liveness == Liveness::kProved ? 1 : 0;
      all.doubted += watched.watch().doubts() ? 1 : 0;
      all.alarms += liveness == Liveness::kFailed && !failed ? 1 : 0;
      failed = liveness == Liveness::kFailed;
      if (liveness == Liveness::kProved) {
        first_s = std::min(first_s, static_cast<double>(field) * kPeriod_s);
      }
      all.least_score_q4 = std::min(all.least_score_q4, watched.watch().last_score_q4());
    }
    all.first_proof_s = std::max(all.first_proof_s, first_s);
  }
  return all;
}

FaultRuns watch_faults(const std::vector<OtherChange>& changes, const LampModel& lamp, bool frozen,
                       std::int64_t runs, std::uint64_t seed) {
  FaultRuns all;
  for (std::int64_t run = 0; run < runs; ++run) {
    WatchedLamp watched(changes, lamp, seed + static_cast<std::uint64_t>(run));
    for (int field = 0; field < 14 * 60; ++field) {
      watched.step(WatchedLamp::Picture::kOurs);
    }
    ++all.runs;
    for (int field = 1; field <= 20 * 60; ++field) {
      watched.step(frozen ? WatchedLamp::Picture::kFrozen : WatchedLamp::Picture::kAnothers);
      if (watched.watch().liveness() == Liveness::kFailed) {
        const double took_s = field * kPeriod_s;
        ++all.told;
        all.within_2s += took_s <= 2.0 ? 1 : 0;
        all.within_10s += took_s <= 10.0 ? 1 : 0;
        all.sum_s += took_s;
        all.most_s = std::max(all.most_s, took_s);
        break;
      }
    }
  }
  return all;
}

}  // namespace tubesight::benchmark
