#include "drivers/modbus/dialogue.h"

#include <array>

#include <gtest/gtest.h>

#include "tests/drivers/modbus/link_bench.h"
#include "tests/support/events.h"

namespace tubesight::drivers {
namespace {

using tests::content_of;
using tests::kBegin;
using tests::LinkBench;
using namespace std::chrono_literals;
using enum Register;

TEST(DialogueCommand, StartIsTakenOnceAndItsResultStaysUntilTheBitIsCleared) {
  LinkBench bench;
  const std::array rows{kStart1Row, kStart2Row, kStart3Row};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto value = [&](std::size_t step) {
      return static_cast<Register>(static_cast<std::size_t>(rows[i]) + step);
    };
    ASSERT_EQ(bench.set(value(0), 40 + static_cast<int>(i)), Refusal::kNone);
    ASSERT_EQ(bench.set(value(1), -60), Refusal::kNone);
    ASSERT_EQ(bench.set(value(2), 313'500), Refusal::kNone);
    ASSERT_EQ(bench.set(value(3), 196'250), Refusal::kNone);
  }
  ASSERT_EQ(bench.set(kCommandId, 9), Refusal::kNone);
  ASSERT_EQ(bench.set(kSeenField, 86), Refusal::kNone);
  ASSERT_EQ(bench.set(kStartConfirm, 1), Refusal::kNone);
  ASSERT_EQ(bench.events.size(), 0u);

  ASSERT_EQ(bench.set(kCommand, 1), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 1), Refusal::kNone);

  ASSERT_EQ(bench.events.size(), 1u) << "once";
  const core::Event event = bench.take_event();
  const auto start = content_of<core::Start>(event);
  ASSERT_EQ(start.tubes.size(), 3);
  EXPECT_EQ(start.tubes[2].address, (core::TubeAddress{42, -60}));
  EXPECT_EQ(start.tubes[2].at_px, (std::array<double, 2>{313.5, 196.25}));
  EXPECT_EQ(start.seen_field, 86);
  EXPECT_TRUE(start.confirmed);
  EXPECT_EQ(event.at, kBegin);
  EXPECT_EQ(bench.get(kBusy), 1);
  EXPECT_EQ(bench.get(kAcknowledge), 0);

  bench.reply(event.id, core::StartReply{core::StartRefusal::kMoved});
  EXPECT_EQ(bench.get(kBusy), 0);
  EXPECT_EQ(bench.get(kAcknowledge), 1);
  EXPECT_EQ(bench.get(kStartResult), 2);
  EXPECT_EQ(bench.get(kStartReason), static_cast<int>(core::StartRefusal::kMoved));
  EXPECT_EQ(bench.get(kStartId), 9);

  ASSERT_EQ(bench.set(kCommand, 0), Refusal::kNone);
  EXPECT_EQ(bench.get(kAcknowledge), 0);
  EXPECT_EQ(bench.get(kStartResult), 0);
  EXPECT_EQ(bench.get(kStartId), kUnknown);
}

TEST(DialogueCommand, AStartWithAnotherWindowIsRefusedAtOnce) {
  LinkBench bench;
  EXPECT_EQ(bench.get(kWindowRight), 595);
  EXPECT_EQ(bench.get(kOptimumV), 190'000);
  ASSERT_EQ(bench.set(kWindowRight, 500), Refusal::kNone);

  ASSERT_EQ(bench.set(kCommand, 1), Refusal::kNone);

  EXPECT_EQ(bench.events.size(), 0u);
  EXPECT_EQ(bench.get(kAcknowledge), 1);
  EXPECT_EQ(bench.get(kStartResult), 2);
  EXPECT_EQ(bench.get(kStartReason), 101);
}

/// Names the window of the settings or another, and insists.
void insist_on_start(LinkBench& bench, std::int32_t window_right) {
  ASSERT_EQ(bench.set(kWindowRight, window_right), Refusal::kNone);
  ASSERT_EQ(bench.set(kStartConfirm, 1), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 1), Refusal::kNone);
  EXPECT_EQ(bench.get(kStartConfirm), 0);
}

TEST(DialogueCommand, InsistingCountsForOneStart) {
  for (const auto outcome : {core::StartRefusal::kNone, core::StartRefusal::kMoved}) {
    LinkBench bench;
    insist_on_start(bench, 595);
    const core::Event first = bench.take_event();
    EXPECT_TRUE(content_of<core::Start>(first).confirmed);
    bench.reply(first.id, core::StartReply{outcome});
    EXPECT_EQ(bench.get(kStartConfirm), 0);

    ASSERT_EQ(bench.set(kCommand, 0), Refusal::kNone);
    ASSERT_EQ(bench.set(kCommand, 1), Refusal::kNone);

    EXPECT_FALSE(content_of<core::Start>(bench.take_event()).confirmed) << "another start";
  }
}

TEST(DialogueCommand, InsistingOnAStartWithAnotherWindowIsForgottenWithIt) {
  LinkBench bench;
  insist_on_start(bench, 500);
  EXPECT_EQ(bench.events.size(), 0u) << "refused";

  ASSERT_EQ(bench.set(kCommand, 0), Refusal::kNone);
  ASSERT_EQ(bench.set(kWindowRight, 595), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 1), Refusal::kNone);

  EXPECT_FALSE(content_of<core::Start>(bench.take_event()).confirmed);
}

TEST(DialogueCommand, ALateResultOfAWithdrawnCommandIsNotTaken) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);
  const core::Event withdrawn = bench.take_event();
  ASSERT_EQ(bench.set(kCommand, 0), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);

  bench.reply(withdrawn.id, core::PoseReply{});

  EXPECT_EQ(bench.get(kBusy), 8);
  EXPECT_EQ(bench.get(kPoseResult), 0) << "none is there";
}

TEST(DialogueCommand, PickNamesTheTubeAtAPlace) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kPickU, 320'500), Refusal::kNone);
  ASSERT_EQ(bench.set(kPickV, 11'250), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 2), Refusal::kNone);
  const core::Event event = bench.take_event();
  EXPECT_EQ(content_of<core::Pick>(event).at_px, (std::array<double, 2>{320.5, 11.25}));
  EXPECT_FALSE(content_of<core::Pick>(event).seen_field);

  bench.reply(event.id, core::PickReply{core::PickDoubt::kNone, {3, -4}});

  EXPECT_EQ(bench.get(kPickResult), 1);
  EXPECT_EQ(bench.get(kPickRow), 3);
  EXPECT_EQ(bench.get(kPickColumn), -4);
  EXPECT_EQ(bench.get(kPickAtU), 320'500);

  ASSERT_EQ(bench.set(kCommand, 0), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 2), Refusal::kNone);
  bench.reply(bench.take_event().id, core::PickReply{core::PickDoubt::kNoTube, {}});
  EXPECT_EQ(bench.get(kPickResult), 2);
  EXPECT_EQ(bench.get(kPickReason), static_cast<int>(core::PickDoubt::kNoTube));
  EXPECT_EQ(bench.get(kPickRow), kUnknown);
}

TEST(DialogueCommand, LampIsTakenOrNotServed) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kLampLevel, 640), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 4), Refusal::kNone);
  const core::Event event = bench.take_event();
  EXPECT_EQ(content_of<core::LampCommand>(event).permille, 640);
  bench.reply(event.id, core::LampReply{640});
  EXPECT_EQ(bench.get(kLampResult), 1);
  EXPECT_EQ(bench.get(kLampTaken), 640);

  ASSERT_EQ(bench.set(kCommand, 0), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 4), Refusal::kNone);
  bench.reply(bench.take_event().id, core::NotServedReply{});
  EXPECT_EQ(bench.get(kLampResult), 2);
  EXPECT_EQ(bench.get(kLampTaken), kUnknownWord);
}

TEST(DialogueCommand, LampGoesBackToTheBoxsOwnLevel) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kLampMode, 2), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 4), Refusal::kNone);
  const core::Event event = bench.take_event();
  EXPECT_TRUE(content_of<core::LampCommand>(event).automatic);
  bench.reply(event.id, core::LampReply{710, true});
  EXPECT_EQ(bench.get(kLampResult), 1);
  EXPECT_EQ(bench.get(kLampTaken), 710);

  ASSERT_EQ(bench.set(kLampMode, 1), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 0), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 4), Refusal::kNone);
  EXPECT_FALSE(content_of<core::LampCommand>(bench.take_event()).automatic);
}

TEST(DialogueCommand, PoseComesAfterItsRequestIsTakenWithACorrection) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);
  const core::Event event = bench.take_event();
  EXPECT_TRUE(tests::is<core::PoseRequest>(event));
  bench.reply(event.id, core::PoseRequestReply{});
  EXPECT_EQ(bench.get(kBusy), 8);

  core::PoseReply pose;
  pose.verdict = core::PoseVerdict::kConfirmed;
  pose.tube = {12, -7};
  pose.pose.reason = core::PoseReason::kNone;
  pose.pose.position_nm = {1'000'000, -2'000'050, -50'000'000};
  pose.pose.angles_ndeg = {90'000'000'000, 0, 0};
  pose.pose.angle_sigma_ndeg = {10'000, 20'000, 30'000};
  pose.pose.tubes = 12;
  bench.reply(event.id, pose);

  EXPECT_EQ(bench.get(kPoseResult), 1);
  EXPECT_EQ(bench.get(kPoseValid), 7);
  EXPECT_EQ(bench.get(kPoseX), 10'000);
  EXPECT_EQ(bench.get(kPoseY), -20'001);
  EXPECT_EQ(bench.get(kPoseAlpha), 9'000'000);
  EXPECT_EQ(bench.get(kPoseSigmaGamma), 3);
  EXPECT_EQ(bench.get(kPoseTubes), 12);
  EXPECT_EQ(bench.get(kPoseTubeRow), 12);
  // The axis is 0.3, -0.4 mm off in the sheet. With the tool's x along the sheet's y and its y
  // against the sheet's x, the move of -0.3, 0.4 is 0.4, 0.3 in the tool.
  EXPECT_EQ(bench.get(kCorrectionX), 4000);
  EXPECT_EQ(bench.get(kCorrectionY), 3000);
  EXPECT_EQ(bench.get(kCorrectionZ), 0);
}

TEST(DialogueCommand, ARobotTellsItsOwnPoseWithOneRequest) {
  LinkBench bench;
  for (const auto& [name, value] : {std::pair{kRobotX, 12'345'678},
                                    {kRobotY, -1},
                                    {kRobotZ, 0},
                                    {kRobotAlpha, -35'999'999},
                                    {kRobotBeta, 7},
                                    {kRobotGamma, 0},
                                    {kRobotJoint1, 100'000},
                                    {kRobotJoint2, -7'200'000}}) {
    ASSERT_EQ(bench.set(name, value), Refusal::kNone);
  }
  ASSERT_EQ(bench.set(kRobotJoints, 2), Refusal::kNone);
  ASSERT_EQ(bench.set(kRobotTold, 2), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);

  const auto told = content_of<core::PoseRequest>(bench.take_event()).robot;

  ASSERT_TRUE(told);
  EXPECT_EQ(told->position_nm, (std::array<std::int64_t, 3>{1'234'567'800, -100, 0}));
  EXPECT_TRUE(told->turned);
  EXPECT_EQ(told->angles_ndeg, (std::array<std::int64_t, 3>{-359'999'990'000, 70'000, 0}));
  EXPECT_EQ(told->joints, 2);
  EXPECT_EQ(told->joints_ndeg[0], 1'000'000'000);
  EXPECT_EQ(told->joints_ndeg[1], -72'000'000'000);
  EXPECT_EQ(told->joints_ndeg[2], 0);
  // The next request is made at another place.
  EXPECT_EQ(bench.get(kRobotTold), 0);
  EXPECT_EQ(bench.get(kRobotJoints), 0);
  ASSERT_EQ(bench.set(kCommand, 0), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);
  EXPECT_FALSE(content_of<core::PoseRequest>(bench.take_event()).robot);
}

TEST(DialogueCommand, ARobotMayTellItsPlaceAlone) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kRobotX, 50'000), Refusal::kNone);
  ASSERT_EQ(bench.set(kRobotAlpha, 90'000'000), Refusal::kNone) << "left over, and not told";
  ASSERT_EQ(bench.set(kRobotTold, 1), Refusal::kNone);
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);

  const auto told = content_of<core::PoseRequest>(bench.take_event()).robot;

  ASSERT_TRUE(told);
  EXPECT_EQ(told->position_nm[0], 5'000'000);
  EXPECT_FALSE(told->turned);
  EXPECT_EQ(told->angles_ndeg[0], 0);
}

TEST(DialogueCommand, ARobotsPoseOutOfItsLimitsIsRefused) {
  for (const auto& [name, most] : {std::pair{kRobotX, 1'000'000'000},
                                   {kRobotZ, 1'000'000'000},
                                   {kRobotGamma, 36'000'000},
                                   {kRobotJoint8, 72'000'000}}) {
    for (const std::int32_t sign : {-1, 1}) {
      LinkBench bench;
      ASSERT_EQ(bench.set(name, sign * most), Refusal::kNone);
      ASSERT_EQ(bench.set(kRobotJoints, 8), Refusal::kNone);
      EXPECT_EQ(bench.set(kRobotTold, 2), Refusal::kNone);
      EXPECT_EQ(bench.set(name, sign * (most + 1)), Refusal::kIllegalValue);
      EXPECT_EQ(bench.get(name), sign * most) << "as it was";
    }
  }
  LinkBench bench;
  EXPECT_EQ(bench.set(kRobotTold, 3), Refusal::kIllegalValue);
  EXPECT_EQ(bench.set(kRobotJoints, 9), Refusal::kIllegalValue);
}

TEST(DialogueCommand, LeanTurnsTheCorrectionAsWell) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);
  core::PoseReply pose;
  pose.verdict = core::PoseVerdict::kConfirmed;
  pose.tube = {12, -7};
  // Ry(90): the tool's z is the sheet's x, its x against the sheet's z.
  pose.pose.angles_ndeg = {0, 90'000'000'000, 0};

  bench.reply(bench.take_event().id, pose);

  EXPECT_EQ(bench.get(kCorrectionX), 0);
  EXPECT_EQ(bench.get(kCorrectionY), 4000);
  EXPECT_EQ(bench.get(kCorrectionZ), -3000);
}

TEST(DialogueCommand, ACorrectionNeedsAConfirmedPose) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);
  core::PoseReply pose;
  pose.verdict = core::PoseVerdict::kContradicted;
  pose.tube = {12, -7};
  bench.reply(bench.take_event().id, pose);
  EXPECT_EQ(bench.get(kPoseResult), 2);
  EXPECT_EQ(bench.get(kPoseValid), 3);
  EXPECT_EQ(bench.get(kCorrectionX), kUnknown);
}

TEST(DialogueCommand, ARefusedPoseSaysWhy) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kCommand, 8), Refusal::kNone);
  bench.reply(bench.take_event().id, core::PoseRequestReply{core::PoseReason::kMoving});
  EXPECT_EQ(bench.get(kPoseResult), 4);
  EXPECT_EQ(bench.get(kPoseReason), static_cast<int>(core::PoseReason::kMoving));
  EXPECT_EQ(bench.get(kPoseValid), 0);
  EXPECT_EQ(bench.get(kPoseX), kUnknown);
}

TEST(DialogueCommand, RefusesValuesOutOfTheirLimits) {
  LinkBench bench;

  EXPECT_EQ(bench.set(kCommand, 32), Refusal::kIllegalValue);
  EXPECT_EQ(bench.set(kLampLevel, 1001), Refusal::kIllegalValue);
  EXPECT_EQ(bench.set(kLampMode, 0), Refusal::kIllegalValue);
  EXPECT_EQ(bench.set(kLampMode, 3), Refusal::kIllegalValue);
  EXPECT_EQ(bench.set(kStartConfirm, 2), Refusal::kIllegalValue);
  ASSERT_EQ(bench.set(kPickU, -1), Refusal::kNone) << "halves of a value may look odd";
  EXPECT_EQ(bench.set(kCommand, 2), Refusal::kIllegalValue);
  ASSERT_EQ(bench.set(kStart2V, 32'767'001), Refusal::kNone);
  EXPECT_EQ(bench.set(kCommand, 1), Refusal::kIllegalValue);
  ASSERT_EQ(bench.set(kSeenField, -2), Refusal::kNone);
  EXPECT_EQ(bench.set(kCommand, 4), Refusal::kIllegalValue);
  EXPECT_EQ(bench.events.size(), 0u);
  EXPECT_EQ(bench.get(kCommand), 0);
}

/// Knows tube (3, -4) alone.
class OneZone final : public ZoneCorrections {
 public:
  bool at(core::TubeAddress tube, ZoneAnswer& answer) const override {
    answer = {{1'234'567, -250'000, 49}, 300'000, 500'000};
    return tube == core::TubeAddress{3, -4};
  }
};

TEST(DialogueZone, TellsTheCorrectionAtTheTubeAskedFor) {
  const OneZone zones;
  LinkBench bench;
  bench.state.identity.zones = &zones;
  ASSERT_EQ(bench.set(kZoneTubeRow, 3), Refusal::kNone);
  ASSERT_EQ(bench.set(kZoneTubeColumn, -4), Refusal::kNone);

  EXPECT_EQ(bench.get(kZoneValid), 1);
  EXPECT_EQ(bench.get(kZoneRow), 3);
  EXPECT_EQ(bench.get(kZoneColumn), -4);
  EXPECT_EQ(bench.get(kZoneX), 12'346);
  EXPECT_EQ(bench.get(kZoneY), -2500);
  EXPECT_EQ(bench.get(kZoneZ), 0);
  EXPECT_EQ(bench.get(kZoneSigmaAcross), 3000);
  EXPECT_EQ(bench.get(kZoneSigmaAlong), 5000);

  ASSERT_EQ(bench.set(kZoneTubeRow, 4), Refusal::kNone);
  EXPECT_EQ(bench.get(kZoneValid), 0) << "nothing is known of that";
  EXPECT_EQ(bench.get(kZoneRow), 4);
  EXPECT_EQ(bench.get(kZoneX), kUnknown);
  EXPECT_EQ(bench.get(kZoneSigmaAlong), kUnknown);
  EXPECT_EQ(bench.events.size(), 0u) << "the tracking is not asked";
}

TEST(DialogueZone, WithoutCorrectionsNothingIsKnown) {
  LinkBench bench;
  ASSERT_EQ(bench.set(kZoneTubeRow, 3), Refusal::kNone);
  EXPECT_EQ(bench.get(kZoneValid), 0);
  EXPECT_EQ(bench.get(kZoneX), kUnknown);
  EXPECT_EQ(bench.set(kZoneX, 1), Refusal::kIllegalAddress) << "not to be written";
}

TEST(Dialogue, OneRequestStaysWithinOneBlock) {
  EXPECT_EQ(Dialogue::check_readable(100, 52), Refusal::kNone);
  EXPECT_EQ(Dialogue::check_readable(100, 53), Refusal::kIllegalAddress);
  EXPECT_EQ(Dialogue::check_readable(99, 2), Refusal::kIllegalAddress);
  EXPECT_EQ(Dialogue::check_readable(665, 1), Refusal::kNone);
  EXPECT_EQ(Dialogue::check_readable(666, 1), Refusal::kIllegalAddress);
  EXPECT_EQ(Dialogue::check_readable(65535, 125), Refusal::kIllegalAddress);
  LinkBench bench;
  EXPECT_EQ(bench.set(kSequence, 1), Refusal::kIllegalAddress) << "not to be written";
}

}  // namespace
}  // namespace tubesight::drivers
