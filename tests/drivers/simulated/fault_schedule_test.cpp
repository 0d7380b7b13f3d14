#include "drivers/simulated/fault_schedule.h"

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

/// The slots of a camera of 30 interlaced frames a second.
FieldSlot slot(int number) {
  const int first = number - number % 2;
  return {number / 60.0, first / 60.0, 1.0 / 60.0, (number - 1) / 60.0, (first - 2) / 60.0};
}

Fault fault(FaultKind kind, double at_s, double for_s) {
  Fault made;
  made.kind = kind;
  made.at_s = at_s;
  made.for_s = for_s;
  made.axis = {0.0, 1.0, 0.0};
  return made;
}

/// Numbers of the first 120 slots at which the fault is at work.
std::vector<int> hit(const Fault& one) {
  std::vector<int> numbers;
  for (int number = 0; number < 120; ++number) {
    if (faults_of({&one, 1}, slot(number)).has(one.kind)) {
      numbers.push_back(number);
    }
  }
  return numbers;
}

TEST(FaultsOf, HitFieldsFromTheStartToBeforeTheEnd) {
  // 0.1 s is slot 6, 0.15 s slot 9.
  EXPECT_EQ(hit(fault(FaultKind::kBlack, 0.1, 0.05)), (std::vector<int>{6, 7, 8}));
}

TEST(FaultsOf, WithoutALengthHitOneField) {
  EXPECT_EQ(hit(fault(FaultKind::kDropped, 0.1, 0.0)), (std::vector<int>{6}));
  EXPECT_EQ(hit(fault(FaultKind::kTorn, 0.101, 0.0)), (std::vector<int>{7}));
}

TEST(FaultsOf, LeaveOutAPartOfThePathFromThenOn) {
  const std::vector<Fault> skips{fault(FaultKind::kSkip, 0.1, 0.25),
                                 fault(FaultKind::kSkip, 0.2, 0.5)};
  EXPECT_EQ(faults_of(skips, slot(5)).skipped_s, 0.0);
  EXPECT_EQ(faults_of(skips, slot(6)).skipped_s, 0.25);
  EXPECT_EQ(faults_of(skips, slot(100)).skipped_s, 0.75);
  EXPECT_FALSE(faults_of(skips, slot(6)).lost) << "the camera delivers";
}

TEST(FaultsOf, PutTheToolOff) {
  Fault step = fault(FaultKind::kPoseStep, 0.1, 0.0);
  step.shake_mm = {0.0, 0.0, 3.5};
  step.shake_deg = {0.0, 0.0, 90.0};
  EXPECT_EQ(faults_of({&step, 1}, slot(5)).off.translation_mm(), Eigen::Vector3d::Zero());
  const auto off = faults_of({&step, 1}, slot(100)).off;
  EXPECT_EQ(off.translation_mm(), Eigen::Vector3d(0.0, 0.0, 3.5));
  EXPECT_NEAR((off.rotation() * Eigen::Vector3d::UnitX()).y(), 1.0, 1e-12) << "about z";
  step.for_s = 0.05;
  EXPECT_EQ(hit(step), (std::vector<int>{6, 7, 8}));
}

TEST(FaultsOf, SwapAndCutWholeFrames) {
  EXPECT_EQ(hit(fault(FaultKind::kSwapped, 0.1, 0.0)), (std::vector<int>{6, 7}));
  EXPECT_EQ(hit(fault(FaultKind::kCut, 0.09, 0.05)), (std::vector<int>{6, 7, 8, 9}));
}

TEST(FaultsOf, WithoutALengthHitTheFirstFrameFromThereOn) {
  for (const FaultKind kind : {FaultKind::kSwapped, FaultKind::kCut}) {
    // Frames begin at 0, 0.0333, 0.0667, 0.1 and 0.1333 s, which is slot 8.
    EXPECT_EQ(hit(fault(kind, 0.0, 0.0)), (std::vector<int>{0, 1})) << name_of(kind);
    EXPECT_EQ(hit(fault(kind, 0.099, 0.0)), (std::vector<int>{6, 7})) << name_of(kind);
    EXPECT_EQ(hit(fault(kind, 0.1, 0.0)), (std::vector<int>{6, 7})) << name_of(kind);
    EXPECT_EQ(hit(fault(kind, 0.101, 0.0)), (std::vector<int>{8, 9})) << name_of(kind);
    EXPECT_EQ(hit(fault(kind, 0.117, 0.0)), (std::vector<int>{8, 9})) << name_of(kind);
    EXPECT_EQ(hit(fault(kind, 0.1333, 0.0)), (std::vector<int>{8, 9})) << name_of(kind);
  }
}

TEST(FaultsOf, WithoutALengthWhatIsBrokenStaysBroken) {
  for (const FaultKind kind : {FaultKind::kKnock, FaultKind::kLampOut, FaultKind::kLampsDead,
                               FaultKind::kJump, FaultKind::kLampDrift}) {
    const auto numbers = hit(fault(kind, 1.0, 0.0));
    ASSERT_FALSE(numbers.empty()) << name_of(kind);
    EXPECT_EQ(numbers.front(), 60) << name_of(kind);
    EXPECT_EQ(numbers.size(), 60U) << name_of(kind);
  }
}

TEST(FaultsOf, TellsLossAndWhetherTheSequenceShowsIt) {
  Fault cut = fault(FaultKind::kCut, 0.0, 1.0);
  const FieldFaults counted = faults_of({&cut, 1}, slot(4));
  cut.told = false;
  const FieldFaults silent = faults_of({&cut, 1}, slot(4));

  EXPECT_TRUE(counted.lost);
  EXPECT_FALSE(counted.unnumbered);
  EXPECT_TRUE(silent.lost);
  EXPECT_TRUE(silent.unnumbered);
}

TEST(FaultsOf, DriftsTheLampToItsLevelAndKeepsItThere) {
  Fault drift = fault(FaultKind::kLampDrift, 1.0, 2.0);
  drift.level = 0.2;

  EXPECT_DOUBLE_EQ(faults_of({&drift, 1}, slot(30)).lamp, 1.0);
  EXPECT_DOUBLE_EQ(faults_of({&drift, 1}, slot(60)).lamp, 1.0);
  EXPECT_NEAR(faults_of({&drift, 1}, slot(120)).lamp, 0.6, 1e-12);
  EXPECT_NEAR(faults_of({&drift, 1}, slot(600)).lamp, 0.2, 1e-12);
}

TEST(FaultsOf, AddsUpSeveralOfAKind) {
  std::vector<Fault> faults = {
      fault(FaultKind::kLampOut, 0.0, 0.0),   fault(FaultKind::kLampOut, 0.0, 0.0),
      fault(FaultKind::kLampsDead, 0.0, 0.0), fault(FaultKind::kLampsDead, 0.0, 0.0),
      fault(FaultKind::kJump, 0.0, 0.0),      fault(FaultKind::kJump, 0.5, 0.0)};
  faults[0].level = 0.5;
  faults[1].level = 0.4;
  faults[2].lamps = 0b1;
  faults[3].lamps = 0b100;
  faults[4].rows = 1;
  faults[5].rows = 1;
  faults[5].columns = -2;

  const FieldFaults early = faults_of(faults, slot(0));
  const FieldFaults late = faults_of(faults, slot(60));

  EXPECT_NEAR(early.lamp, 0.2, 1e-12);
  EXPECT_EQ(early.dead_lamps, 0b101);
  EXPECT_EQ(early.jump, (std::array<std::int32_t, 2>{1, 0}));
  EXPECT_EQ(late.jump, (std::array<std::int32_t, 2>{2, -2}));
}

TEST(FaultsOf, TurnsTheCameraAboutTheAxis) {
  Fault knock = fault(FaultKind::kKnock, 0.0, 0.0);
  knock.angle_deg = 30.0;

  const FieldFaults faults = faults_of({&knock, 1}, slot(0));

  // About y (down), z (ahead) turns to x: (sin 30, 0, cos 30).
  const Eigen::Vector3d turned = faults.knock * Eigen::Vector3d(0.0, 0.0, 1.0);
  EXPECT_NEAR(turned.x(), 0.5, 1e-12);
  EXPECT_NEAR(turned.y(), 0.0, 1e-12);
  EXPECT_NEAR(turned.z(), 0.8660254037844386, 1e-12);
}

TEST(ShakeAt, StaysWithinTheAmplitudeAndEndsAtRest) {
  Fault vibration = fault(FaultKind::kVibration, 1.0, 0.5);
  vibration.shake_mm = {0.4, 0.2, 0.0};
  vibration.shake_deg = {0.0, 0.0, 0.1};
  vibration.frequency_hz = 25.0;
  double most_x = 0.0;
  double most_y = 0.0;
  for (int i = 0; i <= 1000; ++i) {
    const double time_s = 0.9 + i * 0.0007;
    const auto shaken = shake_at({&vibration, 1}, time_s);
    if (time_s <= 1.0 || time_s >= 1.5) {
      EXPECT_EQ(shaken.translation_mm(), Eigen::Vector3d::Zero()) << time_s;
      EXPECT_EQ(shaken.rotation(), Eigen::Matrix3d::Identity()) << time_s;
    }
    most_x = std::max(most_x, std::abs(shaken.translation_mm().x()));
    most_y = std::max(most_y, std::abs(shaken.translation_mm().y()));
    EXPECT_EQ(shaken.translation_mm().z(), 0.0);
  }

  EXPECT_NEAR(most_x, 0.4, 0.01);
  EXPECT_NEAR(most_y, 0.2, 0.01);
}

TEST(FaultWords, AreOneForEachKind) {
  EXPECT_EQ(name_of(FaultKind::kDropped), "dropped");
  EXPECT_EQ(name_of(FaultKind::kSignalLoss), "signal-loss");
  EXPECT_EQ(name_of(FaultKind::kCut), "cut");
  EXPECT_EQ(name_of(FaultKind::kSaltPepper), "salt-pepper");
  EXPECT_EQ(name_of(FaultKind::kFrozen), "frozen");
  EXPECT_EQ(name_of(FaultKind::kOtherCamera), "other-camera");
  EXPECT_EQ(name_of(FaultKind::kSkip), "skip");
  EXPECT_EQ(name_of(FaultKind::kPoseStep), "pose-step");
  EXPECT_EQ(name_of(FaultKind::kHeld), "held");
  EXPECT_EQ(name_of(FaultKind::kCompressed), "compressed");
  EXPECT_EQ(name_of(FaultKind::kJitter), "jitter");
  EXPECT_EQ(name_of(FaultKind::kBlots), "blots");
  EXPECT_EQ(name_of(FaultKind::kReflections), "reflections");
  EXPECT_EQ(name_of(FaultKind::kGhost), "ghost");
  EXPECT_EQ(name_of(FaultKind::kBlackLevel), "black-level");
  EXPECT_EQ(name_of(FaultKind::kCovered), "covered");
}

}  // namespace
}  // namespace tubesight::drivers
