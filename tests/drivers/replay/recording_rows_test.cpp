#include "drivers/files/recording_rows.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_meta.h"
#include "tests/support/events.h"

namespace tubesight::drivers {
namespace {

TEST(EventRows, AreReadBackByReplay) {
  std::string text = std::string(kEventsHeader) + "\n";
  core::Event event;
  core::Start start;
  for (const core::StartPoint& point :
       {core::StartPoint{{40, 60}, {313.0, 196.25}}, core::StartPoint{{41, 60}, {321.0, 251.0}},
        core::StartPoint{{40, 61}, {387.0, 186.0}}}) {
    ASSERT_TRUE(start.tubes.try_push_back(point));
  }
  event.content = start;
  append_event_row(text, 0, event);
  event.content = core::Claim{{-3, 61}};
  append_event_row(text, 12, event);
  event.content = core::LampCommand{650};
  append_event_row(text, 13, event);
  event.content = core::Pick{{100.5, 20.0}, {}};
  append_event_row(text, 14, event);
  event.content = core::PoseRequest{};
  append_event_row(text, 15, event);
  event.content = core::Acknowledge{};
  append_event_row(text, 15, event);
  core::PoseResult pose;
  pose.reason = core::PoseReason::kMoving;
  event.content = pose;
  append_event_row(text, 16, event);
  pose.reason = core::PoseReason::kNone;
  pose.position_nm = {1'524'000'001, -5, 60'000'000};
  pose.angles_ndeg = {1, 2, -3};
  pose.tubes = 17;
  event.content = pose;
  append_event_row(text, 17, event);

  ReplayEvents events;
  Messages messages;
  ASSERT_TRUE(events.parse(text, "e", messages)) << messages.front();

  EXPECT_EQ(events.size(), 8U);
  core::EventList list;
  events.take_before(0, list);
  ASSERT_EQ(list.size(), 1);
  EXPECT_EQ(tests::content_of<core::Start>(list[0]).tubes[0].at_px[1], 196.25);
  events.take_before(14, list);
  ASSERT_EQ(list.size(), 3);
  EXPECT_EQ(tests::content_of<core::Claim>(list[0]).tube, (core::TubeAddress{-3, 61}));
  EXPECT_EQ(tests::content_of<core::LampCommand>(list[1]).permille, 650);
  EXPECT_EQ(tests::content_of<core::Pick>(list[2]).at_px[0], 100.5);
  events.take_before(17, list);
  ASSERT_EQ(list.size(), 4);
  EXPECT_EQ(tests::content_of<core::PoseResult>(list[2]).reason, core::PoseReason::kMoving);
  const auto back = tests::content_of<core::PoseResult>(list[3]);
  EXPECT_EQ(back.position_nm[0], 1'524'000'001);
  EXPECT_EQ(back.angles_ndeg[2], -3);
  EXPECT_EQ(back.tubes, 17);
}

TEST(EventRows, KeepWhatTheRobotTellsOfItself) {
  core::RobotPose place;
  place.position_nm = {1'234'567'800, -100, 0};
  core::RobotPose turned = place;
  turned.turned = true;
  turned.angles_ndeg = {-359'999'990'000, 70'000, 0};
  core::RobotPose jointed = turned;
  jointed.joints = 2;
  jointed.joints_ndeg = {1'000'000'000, -72'000'000'001};
  core::RobotPose joints_alone = place;
  joints_alone.joints = 8;
  joints_alone.joints_ndeg[7] = 5;
  const std::vector<core::RobotPose> all = {place, turned, jointed, joints_alone};
  std::string text = std::string(kEventsHeader) + "\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    core::Event event;
    event.content = core::PoseRequest{all[i]};
    append_event_row(text, static_cast<std::int64_t>(i), event);
  }
  EXPECT_NE(text.find("0,,pose,\"1234.567800,-0.000100,0.000000\",0,,\n"), std::string::npos)
      << text;

  ReplayEvents events;
  Messages messages;
  ASSERT_TRUE(events.parse(text, "e", messages)) << messages.front();

  core::EventList list;
  events.take_before(9, list);
  ASSERT_EQ(list.size(), 4);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto told =
        tests::content_of<core::PoseRequest>(list[static_cast<std::int32_t>(i)]).robot;
    ASSERT_TRUE(told);
    EXPECT_EQ(told->position_nm, all[i].position_nm);
    EXPECT_EQ(told->turned, all[i].turned);
    EXPECT_EQ(told->angles_ndeg, all[i].angles_ndeg);
    EXPECT_EQ(told->joints, all[i].joints);
    EXPECT_EQ(told->joints_ndeg, all[i].joints_ndeg);
  }
}

TEST(EventRows, KeepIdInstantAndWhatTheClickerSaw) {
  core::Event start;
  start.id = 42;
  start.origin = core::EventOrigin::kOperator;
  start.at = core::FieldTime(1'234'567'891);
  core::Start content;
  for (const core::StartPoint& point :
       {core::StartPoint{{40, 60}, {313.0, 196.25}}, core::StartPoint{{41, 60}, {321.0, 251.0}},
        core::StartPoint{{40, 61}, {387.0, 186.0}}}) {
    ASSERT_TRUE(content.tubes.try_push_back(point));
  }
  content.seen_field = 71;
  content.confirmed = true;
  start.content = content;
  core::Event pick;
  pick.content = core::Pick{{1.0, 2.0}, 0};
  core::Event claim;
  claim.id = -7;
  claim.at = core::FieldTime(0);
  claim.content = core::Claim{{1, 2}};
  std::string text = std::string(kEventsHeader) + "\n";
  append_event_row(text, 74, start);
  append_event_row(text, 74, pick);
  append_event_row(text, 75, claim);

  ReplayEvents events;
  Messages messages;
  ASSERT_TRUE(events.parse(text, "e", messages)) << messages.front();
  core::EventList list;
  events.take_before(75, list);

  ASSERT_EQ(list.size(), 3);
  EXPECT_EQ(list[0].id, 42);
  EXPECT_EQ(list[0].origin, core::EventOrigin::kOperator);
  EXPECT_EQ(list[0].at, core::FieldTime(1'234'567'891));
  EXPECT_EQ(tests::content_of<core::Start>(list[0]).seen_field, 71);
  EXPECT_TRUE(tests::content_of<core::Start>(list[0]).confirmed);
  EXPECT_EQ(list[1].id, 0);
  EXPECT_FALSE(list[1].at.has_value());
  EXPECT_EQ(tests::content_of<core::Pick>(list[1]).seen_field, 0);
  EXPECT_EQ(list[2].id, -7);
  EXPECT_EQ(list[2].at, core::FieldTime(0));
}

TEST(EventRows, ALampCommandIsALevelOrTheBoxsOwn) {
  std::string text = std::string(kEventsHeader) + "\n";
  core::Event event;
  event.content = core::LampCommand{430};
  append_event_row(text, 3, event);
  event.content = core::LampCommand{0, true};
  append_event_row(text, 3, event);

  ReplayEvents events;
  Messages messages;
  ASSERT_TRUE(events.parse(text, "e", messages)) << messages.front();
  core::EventList list;
  events.take_before(3, list);
  ASSERT_EQ(list.size(), 2);
  EXPECT_EQ(tests::content_of<core::LampCommand>(list[0]).permille, 430);
  EXPECT_FALSE(tests::content_of<core::LampCommand>(list[0]).automatic);
  EXPECT_TRUE(tests::content_of<core::LampCommand>(list[1]).automatic);
}

TEST(MetaRows, AreReadBackByReplay) {
  std::string text = std::string(kMetaHeader) + "\n";
  core::Field field;
  field.sequence = 1187;
  field.mid_exposure = core::FieldTime(39'566'666'667);
  field.lamp_permille = 500;
  append_meta_row(text, field);
  field.status = core::FieldStatus::kDamaged;
  field.number = 1;
  ++field.sequence;
  field.mid_exposure += core::FieldTime(1);
  append_meta_row(text, field);
  field.status = core::FieldStatus::kMissing;
  field.number = 2;
  field.mid_exposure += core::FieldTime(1);
  append_meta_row(text, field);

  ReplayMeta meta;
  Messages messages;
  ASSERT_TRUE(meta.parse(text, "m", messages)) << messages.front();

  ASSERT_EQ(meta.rows().size(), 3U);
  EXPECT_EQ(meta.rows()[0].sequence, 1187);
  EXPECT_EQ(meta.rows()[0].time.count(), 39'566'666'667);
  EXPECT_EQ(meta.rows()[0].lamp_permille, 500);
  EXPECT_EQ(meta.rows()[1].status, core::FieldStatus::kDamaged);
  EXPECT_EQ(meta.rows()[1].time.count(), 39'566'666'668);
  EXPECT_EQ(meta.rows()[2].status, core::FieldStatus::kMissing);
}

}  // namespace
}  // namespace tubesight::drivers
