#include <algorithm>
#include <array>

#include "board/bench/campaign/random_parts.h"
#include "core/tubesheet/sheet_places.h"

namespace tubesight::board::campaign {
namespace {

using drivers::Fault;
using drivers::FaultKind;
using drivers::Scenario;

/// Draws single faults of a move.
class FaultDrawing {
 public:
  FaultDrawing(RandomSource& random, Scenario& scenario)
      : random_(random), scenario_(scenario), field_s_(field_s(scenario)) {}

  void draw(FaultGroup group) {
    Fault fault;
    fault.at_s = random_.between(4.0 * field_s_, scenario_.video.length_s * 0.85);
    switch (group) {
      case FaultGroup::kNone: return;
      case FaultGroup::kStream: draw_stream(fault); break;
      case FaultGroup::kPicture: draw_picture(fault); break;
      case FaultGroup::kLamp: draw_lamp(fault); break;
      case FaultGroup::kMechanics: draw_mechanics(fault); break;
      case FaultGroup::kJump: draw_jump(fault); break;
    }
    const bool ends = fault.for_s > 0.0;
    const double left_s = scenario_.video.length_s - fault.at_s;
    fault.for_s = ends ? std::min(fault.for_s, left_s) : 0.0;
    scenario_.faults.push_back(fault);
  }

 private:
  // Mostly a few fields, now and then up to half a second.
  double some_fields() {
    const std::int32_t few = random_.whole(1, 6);
    const std::int32_t many = random_.whole(6, 30);
    return field_s_ * (random_.chance(0.7) ? few : many);
  }

  void draw_stream(Fault& fault) {
    constexpr std::array kKinds = {FaultKind::kDropped, FaultKind::kRepeated, FaultKind::kTorn,
                                   FaultKind::kSwapped, FaultKind::kCut};
    fault.kind = kKinds[static_cast<std::size_t>(random_.whole(0, 4))];
    fault.for_s = some_fields();
    fault.share = random_.between(0.05, 0.95);
    fault.told = random_.chance(0.5);
  }

  void draw_picture(Fault& fault) {
    constexpr std::array kKinds = {FaultKind::kBlack, FaultKind::kSaturated, FaultKind::kSignalLoss,
                                   FaultKind::kEmi, FaultKind::kSaltPepper};
    fault.kind = kKinds[static_cast<std::size_t>(random_.whole(0, 4))];
    fault.for_s = some_fields();
    fault.told = random_.chance(0.5);
    fault.level = random_.between(0.0, 16.0);
    fault.amplitude = random_.between(10.0, 80.0);
    fault.share =
        fault.kind == FaultKind::kEmi ? random_.between(0.02, 0.5) : random_.between(0.001, 0.05);
  }

  void draw_lamp(Fault& fault) {
    constexpr std::array kKinds = {FaultKind::kLampOut, FaultKind::kLampsDead,
                                   FaultKind::kLampDrift};
    fault.kind = kKinds[static_cast<std::size_t>(random_.whole(0, 2))];
    fault.for_s = random_.chance(0.8) ? some_fields() : 0.0;
    fault.level = random_.between(0.0, 0.6);
    if (fault.kind == FaultKind::kLampDrift) {
      fault.for_s = random_.between(0.2, 1.0);
    }
    const std::int32_t dead = random_.whole(1, 6);
    for (std::int32_t i = 0; i < dead; ++i) {
      fault.lamps = static_cast<std::uint16_t>(fault.lamps | (1U << random_.whole(0, 11)));
    }
  }

  void draw_mechanics(Fault& fault) {
    if (random_.chance(0.5)) {
      fault.kind = FaultKind::kKnock;
      fault.angle_deg = random_.between(0.05, 0.8);
      fault.axis = {random_.between(-1.0, 1.0), random_.between(-1.0, 1.0),
                    random_.between(0.01, 1.0)};
      return;
    }
    fault.kind = FaultKind::kVibration;
    fault.for_s = random_.between(0.1, 0.6);
    fault.frequency_hz = random_.between(5.0, 60.0);
    for (std::size_t i = 0; i < 3; ++i) {
      fault.shake_mm[i] = random_.between(0.0, 0.4);
      fault.shake_deg[i] = random_.between(0.0, 0.15);
    }
  }

  // Whole lattice steps, as seen by the addresses that exist.
  void draw_jump(Fault& fault) {
    fault.kind = FaultKind::kJump;
    bool exists = false;
    while (!exists) {
      fault.rows = random_.whole(-2, 2);
      fault.columns = random_.whole(-2, 2);
      exists = (fault.rows != 0 || fault.columns != 0) &&
               core::tubesheet::check_move(scenario_.scene.sheet, {fault.rows, fault.columns}) ==
                   core::tubesheet::MoveFault::kNone;
    }
  }

  RandomSource& random_;
  Scenario& scenario_;
  double field_s_;
};

}  // namespace

void draw_faults(const Stratum& stratum, RandomSource& random, Scenario& scenario) {
  scenario.faults.clear();
  const double most = scenario.told.motion.max_speed_mm_s;
  const bool jumps_already =
      std::any_of(scenario.path.begin(), scenario.path.end(), [most](const auto& segment) {
        return segment.kind == core::kinematics::SegmentKind::kMove && segment.limits.speed > most;
      });
  if (stratum.fault == FaultGroup::kNone || jumps_already) {
    return;
  }
  FaultDrawing drawing(random, scenario);
  drawing.draw(stratum.fault);
  if (stratum.fault != FaultGroup::kJump && random.chance(0.25)) {
    drawing.draw(stratum.fault);
  }
}

}  // namespace tubesight::board::campaign
