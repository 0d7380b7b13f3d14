#include "board/bench/simulate/event_rows.h"

#include <string>

#include <gtest/gtest.h>

#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_meta.h"

namespace tubesight::board {
namespace {

TEST(EventRows, AreReadBackByReplay) {
  std::string text = std::string(kEventsHeader) + "\n";
  core::Event event;
  event.kind = core::EventKind::kStart;
  for (const core::StartPoint& point :
       {core::StartPoint{{40, 60}, {313.0, 196.25}}, core::StartPoint{{41, 60}, {321.0, 251.0}},
        core::StartPoint{{40, 61}, {387.0, 186.0}}}) {
    ASSERT_TRUE(event.start.try_push_back(point));
  }
  append_event_row(text, 0, core::FieldTime(0), event);
  event = {};
  event.claim = {-3, 61};
  append_event_row(text, 12, core::FieldTime(200'000'000), event);
  event.kind = core::EventKind::kLampCommand;
  event.lamp_permille = 650;
  append_event_row(text, 13, core::FieldTime(216'666'667), event);
  event.kind = core::EventKind::kPick;
  event.pick_px = {100.5, 20.0};
  append_event_row(text, 14, core::FieldTime(233'333'333), event);
  event.kind = core::EventKind::kPoseRequest;
  append_event_row(text, 15, core::FieldTime(250'000'000), event);
  event.kind = core::EventKind::kAcknowledge;
  append_event_row(text, 15, core::FieldTime(250'000'000), event);
  event.kind = core::EventKind::kPoseResult;
  event.pose.reason = core::PoseReason::kMoving;
  append_event_row(text, 16, core::FieldTime(266'666'667), event);
  event.pose.reason = core::PoseReason::kNone;
  event.pose.position_nm = {1'524'000'001, -5, 60'000'000};
  event.pose.angles_ndeg = {1, 2, -3};
  event.pose.tubes = 17;
  append_event_row(text, 17, core::FieldTime(283'333'333), event);

  drivers::ReplayEvents events;
  drivers::Messages messages;
  ASSERT_TRUE(events.parse(text, "e", messages)) << messages.front();

  EXPECT_EQ(events.size(), 8U);
  core::EventList list;
  events.take_before(0, list);
  ASSERT_EQ(list.size(), 1);
  EXPECT_EQ(list[0].start[0].at_px[1], 196.25);
  events.take_before(14, list);
  ASSERT_EQ(list.size(), 3);
  EXPECT_EQ(list[0].claim, (core::TubeAddress{-3, 61}));
  EXPECT_EQ(list[1].lamp_permille, 650);
  EXPECT_EQ(list[2].pick_px[0], 100.5);
  events.take_before(17, list);
  ASSERT_EQ(list.size(), 4);
  EXPECT_EQ(list[2].pose.reason, core::PoseReason::kMoving);
  EXPECT_EQ(list[3].pose.position_nm[0], 1'524'000'001);
  EXPECT_EQ(list[3].pose.angles_ndeg[2], -3);
  EXPECT_EQ(list[3].pose.tubes, 17);
}

TEST(MetaRows, AreReadBackByReplay) {
  std::string text = std::string(kMetaHeader) + "\n";
  core::Field field;
  field.sequence = 1187;
  field.mid_exposure = core::FieldTime(39'566'666'667);
  append_meta_row(text, 0, field, 500);
  field.status = core::FieldStatus::kDamaged;
  append_meta_row(text, 1, field, 0);

  drivers::ReplayMeta meta;
  drivers::Messages messages;
  ASSERT_TRUE(meta.parse(text, "m", messages)) << messages.front();

  ASSERT_EQ(meta.rows().size(), 2U);
  EXPECT_EQ(meta.rows()[0].sequence, 1187);
  EXPECT_EQ(meta.rows()[0].time.count(), 39'566'666'667);
  EXPECT_EQ(meta.rows()[0].lamp_permille, 500);
  EXPECT_EQ(meta.rows()[1].status, core::FieldStatus::kDamaged);
}

}  // namespace
}  // namespace tubesight::board
