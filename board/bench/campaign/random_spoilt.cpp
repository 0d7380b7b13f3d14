#include <algorithm>
#include <array>

#include "board/bench/campaign/random_parts.h"
#include "board/bench/campaign/random_stream.h"

namespace tubesight::board::campaign {
namespace {

using drivers::Fault;
using drivers::FaultKind;

/// What a person still reads.
struct Range {
  FaultKind kind;
  double least;
  double most;
};
constexpr std::array<Range, 6> kShares{{{FaultKind::kBlots, 0.005, 0.05},
                                        {FaultKind::kReflections, 0.005, 0.05},
                                        {FaultKind::kGhost, 0.05, 0.3},
                                        {FaultKind::kBlackLevel, 0.5, 1.0},
                                        {FaultKind::kCovered, 0.05, 0.35},
                                        {FaultKind::kSaltPepper, 0.001, 0.05}}};

}  // namespace

void draw_spoilt_picture(std::uint64_t seed, std::int64_t move, const Stratum& stratum,
                         drivers::Scenario& scenario) {
  RandomSource leds = random_stream(seed, move, "LEDs");
  if (stratum.fault == FaultGroup::kLamp && leds.chance(0.1)) {
    scenario.faults.clear();
    scenario.light.lamp_permille = 0;
    scenario.light.ring = leds.between(0.3, 1.0);
    return;
  }
  RandomSource random = random_stream(seed, move, "spoilt picture");
  if (stratum.fault != FaultGroup::kPicture || !random.chance(0.25)) {
    return;
  }
  const Range& drawn = kShares[static_cast<std::size_t>(random.whole(0, 5))];
  Fault fault;
  fault.kind = drawn.kind;
  fault.share = random.between(drawn.least, drawn.most);
  const double black = random.between(0.0, 64.0);
  const double cover = random.between(12.0, 255.0);
  const bool left = random.chance(0.5);
  if (drawn.kind == FaultKind::kBlackLevel) {
    fault.level = black;
  } else if (drawn.kind == FaultKind::kCovered) {
    fault.level = cover;
    fault.told = left;
    fault.share *= left ? 2.0 : 1.0;
  }
  // Half of them from the first field on: the start sees it, too.
  const double at_s = random.between(0.0, scenario.video.length_s * 0.85);
  const double for_s = random.between(0.05, 1.0);
  fault.at_s = random.chance(0.5) ? 0.0 : at_s;
  fault.for_s = std::min(for_s, scenario.video.length_s - fault.at_s);
  scenario.faults = {fault};
}

}  // namespace tubesight::board::campaign
