#include <algorithm>

#include "board/bench/campaign/random_parts.h"
#include "board/bench/campaign/random_stream.h"

namespace tubesight::board::campaign {
namespace {

using drivers::Fault;
using drivers::FaultKind;
using drivers::Scenario;

double first_rest_s(const Scenario& scenario) {
  const bool rests =
      !scenario.path.empty() && scenario.path.front().kind == core::kinematics::SegmentKind::kRest;
  return rests ? scenario.path.front().rest_s : 0.0;
}

// Bit for bit, or under noise. Noise of three quarters of the camera's own at most: under as much
// as that nothing tells a store from a camera but its first picture, and a rest of eight fields
// must have shown how much it is.
Fault draw_held(RandomSource& random, const Scenario& scenario) {
  constexpr double kLearnt = 9.0;
  const double least_s = field_s(scenario) * kLearnt;
  Fault fault;
  fault.kind = FaultKind::kHeld;
  fault.at_s = random.between(least_s, std::max(least_s, 0.85 * scenario.video.length_s));
  const bool whole = random.chance(0.5);
  const double part = random.between(0.35, 0.95);
  fault.share = whole ? 1.0 : part;
  const double noise = random.between(0.1, 0.75) * scenario.scene.sensor.read_noise;
  fault.amplitude = random.chance(0.6) && first_rest_s(scenario) > least_s ? noise : 0.0;
  return fault;
}

}  // namespace

void draw_source_faults(std::uint64_t seed, std::int64_t move, const Stratum& stratum,
                        Scenario& scenario) {
  RandomSource held = random_stream(seed, move, "held");
  RandomSource jitter = random_stream(seed, move, "jitter");
  RandomSource compressed = random_stream(seed, move, "compressed");
  if (stratum.fault == FaultGroup::kStream && held.chance(0.2)) {
    scenario.faults = {draw_held(held, scenario)};
  } else if (stratum.fault == FaultGroup::kStream && jitter.chance(0.2)) {
    Fault fault;
    fault.kind = FaultKind::kJitter;
    fault.waver_ms = jitter.between(0.5, 6.0);
    scenario.faults = {fault};
  } else if (stratum.fault == FaultGroup::kPicture && compressed.chance(0.2)) {
    Fault fault;
    fault.kind = FaultKind::kCompressed;
    fault.amplitude = compressed.between(2.0, 8.0);
    scenario.faults = {fault};
  }
}

}  // namespace tubesight::board::campaign
