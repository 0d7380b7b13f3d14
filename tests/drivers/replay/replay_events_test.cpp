#include "drivers/replay/replay_events.h"

#include <gtest/gtest.h>

#include "tests/support/events.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using tests::content_of;

const std::string kHeader = "field,time_s,kind,values\n";

TEST(ReplayEvents, ReadsWhatBecameOfAPoseRequestExactly) {
  ReplayEvents events;
  Messages messages;
  core::EventList list;

  ASSERT_TRUE(events.parse(
      kHeader + "7,,pose-result,\"65,7,-41,1041.601901,178.1,-40.000001,45.000250001,-0.00114,0,"
                "0.002,0.0021,0.000001,0.001,0.0011,0.0012,0.361713\"\n8,,pose-result,moving\n",
      "a.events.csv", messages));

  EXPECT_TRUE(events.has_pose_results());
  events.take_before(8, list);
  ASSERT_EQ(list.size(), 2);
  const auto pose = content_of<core::PoseResult>(list[0]);
  EXPECT_EQ(pose.reason, core::PoseReason::kNone);
  EXPECT_EQ(pose.tubes, 65);
  EXPECT_EQ(pose.nearest, (core::TubeAddress{7, -41}));
  EXPECT_EQ(pose.position_nm[0], 1'041'601'901);
  EXPECT_EQ(pose.position_nm[2], -40'000'001);
  EXPECT_EQ(pose.angles_ndeg[0], 45'000'250'001);
  EXPECT_EQ(pose.position_sigma_nm[2], 1);
  EXPECT_EQ(pose.angle_sigma_ndeg[2], 1'200'000);
  EXPECT_EQ(pose.offset_nm, 361'713);
  EXPECT_EQ(content_of<core::PoseResult>(list[1]).reason, core::PoseReason::kMoving);
}

TEST(ReplayEvents, RefusesAPoseThatIsNeitherNumbersNorAReason) {
  for (const char* values : {"", "fast", "65,7,41", "\"1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,x\""}) {
    ReplayEvents events;
    Messages messages;

    EXPECT_FALSE(
        events.parse(kHeader + "7,,pose-result," + values + "\n", "a.events.csv", messages));
    EXPECT_EQ(messages.size(), 1U) << values;
  }
}

TEST(ReplayEvents, ReadsEachKind) {
  ReplayEvents events;
  Messages messages;
  core::EventList list;

  ASSERT_TRUE(events.parse(kHeader + "0,0.0,start,\"40,60,313,196;41,60,321,251;40,61,387.5,186\"\n"
                                     "0,,claim,\"-4,60\"\n"
                                     "2,0.03,lamp,250\n2,0.03,pose,\n2,0.03,pick,\"320.25,190\"\n"
                                     "2,0.03,acknowledge\n",
                           "a.events.csv", messages));

  events.take_before(0, list);
  ASSERT_EQ(list.size(), 2);
  const auto start = content_of<core::Start>(list[0]);
  ASSERT_EQ(start.tubes.size(), 3);
  EXPECT_EQ(start.tubes[2].address, (core::TubeAddress{40, 61}));
  EXPECT_EQ(start.tubes[2].at_px[0], 387.5);
  EXPECT_EQ(start.tubes[2].at_px[1], 186.0);
  EXPECT_EQ(content_of<core::Claim>(list[1]).tube, (core::TubeAddress{-4, 60}));
  events.take_before(1, list);
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(events.left(), 4u);
  events.take_before(2, list);
  ASSERT_EQ(list.size(), 4);
  EXPECT_EQ(content_of<core::LampCommand>(list[0]).permille, 250);
  EXPECT_TRUE(tests::is<core::PoseRequest>(list[1]));
  EXPECT_EQ(content_of<core::Pick>(list[2]).at_px[0], 320.25);
  EXPECT_TRUE(tests::is<core::Acknowledge>(list[3]));
  EXPECT_EQ(events.left(), 0u);
}

TEST(ReplayEvents, TakesUnquotedCommasInTheLastColumn) {
  ReplayEvents events;
  Messages messages;
  core::EventList list;

  ASSERT_TRUE(events.parse(kHeader + "0,0,claim,40,60\n", "a.events.csv", messages));
  events.take_before(0, list);
  ASSERT_EQ(list.size(), 1);
  EXPECT_EQ(content_of<core::Claim>(list[0]).tube, (core::TubeAddress{40, 60}));

  // With a further column only quotation marks keep them apart.
  EXPECT_FALSE(events.parse("field,time_s,kind,values,who\n0,0,claim,40,60\n", "a", messages));
}

TEST(ReplayEvents, ReadsTheAppendedColumns) {
  ReplayEvents events;
  Messages messages;
  core::EventList list;

  ASSERT_TRUE(events.parse(
      "field,time_s,kind,values,id,seen_field,confirm\n"
      "5,0.1,start,\"1,2,3,4;1,3,5,6;2,2,7,8\",77,3,1\n5,,start,\"1,2,3,4;1,3,5,6;2,2,7,8\",,,0\n"
      "5,0.123456789,pick,\"1,2\",-1,5,\n5,,pose,,,,\n",
      "e", messages))
      << messages.front();
  events.take_before(5, list);

  ASSERT_EQ(list.size(), 4);
  EXPECT_EQ(list[0].id, 77);
  EXPECT_EQ(list[0].at, core::FieldTime(100'000'000));
  EXPECT_EQ(tests::content_of<core::Start>(list[0]).seen_field, 3);
  EXPECT_TRUE(tests::content_of<core::Start>(list[0]).confirmed);
  EXPECT_EQ(list[1].id, 2) << "numbered by its place";
  EXPECT_FALSE(list[1].at.has_value());
  EXPECT_FALSE(tests::content_of<core::Start>(list[1]).seen_field.has_value());
  EXPECT_FALSE(tests::content_of<core::Start>(list[1]).confirmed);
  EXPECT_EQ(list[2].id, -1);
  EXPECT_EQ(list[2].at, core::FieldTime(123'456'789));
  EXPECT_EQ(tests::content_of<core::Pick>(list[2]).seen_field, 5);
  EXPECT_EQ(list[3].id, 4);
}

TEST(ReplayEvents, NumbersTheEventsOfAnOldFile) {
  ReplayEvents events;
  Messages messages;
  core::EventList list;

  ASSERT_TRUE(events.parse(kHeader + "5,0.25,pose,\n6,,claim,1,2\n", "e", messages));
  events.take_before(6, list);

  ASSERT_EQ(list.size(), 2);
  EXPECT_EQ(list[0].id, 1);
  EXPECT_EQ(list[0].at, core::FieldTime(250'000'000));
  EXPECT_EQ(list[1].id, 2);
}

TEST(ReplayEvents, TellsWrongCellsOfTheAppendedColumns) {
  ReplayEvents events;
  Messages messages;

  EXPECT_FALSE(
      events.parse("field,time_s,kind,values,id,seen_field,confirm\n"
                   "5,,pick,\"1,2\",x,6,1\n5,5000000000,start,\"1,2,3,4;1,3,5,6;2,2,7,8\",,-1,yes\n"
                   "5,,claim,\"1,2\",,5,\n5,,pose,,\n",
                   "e", messages));

  EXPECT_EQ(
      messages,
      (Messages{"e:2: id: 'x', expected a whole number, or nothing",
                "e:2: seen_field: '6', expected a whole number from 0 to the row's field, or "
                "nothing",
                "e:2: confirm: '1', expected nothing for pick",
                "e:3: time_s: '5000000000', expected at most 4000000000 s to either side of "
                "zero, or nothing",
                "e:3: seen_field: '-1', expected a whole number from 0 to the row's field, "
                "or nothing",
                "e:3: confirm: 'yes', expected 1, 0 or nothing",
                "e:4: seen_field: '5', expected nothing for claim", "e:5: 5 cells, expected 7"}));
}

TEST(ReplayEvents, TakesWhatABoxRecordedAsItCame) {
  const std::string header = "field,time_s,kind,values,id,seen_field,confirm,origin\n";
  ReplayEvents events;
  Messages messages;
  ASSERT_TRUE(events.parse(header + "3,,start,\"1,2,3.5,4\",7,99,,robot\n"
                                    "3,,start,,8,-2,,operator\n3,,lamp,5,9,,,operator\n"
                                    "3,,pick,\"1,2\",10,,,\n",
                           "e", messages))
      << messages.front();
  core::EventList list;
  events.take_before(3, list);

  ASSERT_EQ(list.size(), 4);
  EXPECT_EQ(list[0].origin, core::EventOrigin::kRobot);
  EXPECT_EQ(content_of<core::Start>(list[0]).seen_field, 99);
  EXPECT_EQ(content_of<core::Start>(list[0]).tubes.size(), 1);
  EXPECT_TRUE(content_of<core::Start>(list[1]).tubes.empty());
  EXPECT_EQ(content_of<core::Start>(list[1]).seen_field, -2);
  EXPECT_EQ(list[2].origin, core::EventOrigin::kOperator);
  EXPECT_EQ(list[3].origin, core::EventOrigin::kOperator) << "by its kind";
}

TEST(ReplayEvents, TellsAnOriginThatIsNone) {
  ReplayEvents events;
  Messages messages;
  EXPECT_FALSE(
      events.parse("field,time_s,kind,values,id,seen_field,confirm,origin\n"
                   "3,,lamp,5,9,,,page\n4,,start,\"1,2,3,4\",9,,,\n",
                   "e", messages));
  EXPECT_EQ(messages, (Messages{"e:2: origin: 'page', expected robot, operator or nothing",
                                "e:3: values: '1,2,3,4', expected 3 to 8 clicks R,C,U,V separated "
                                "by ';' for start"}));
}

TEST(ReplayEvents, HandsRowsBetweenFieldsToTheNext) {
  ReplayEvents events;
  Messages messages;
  core::EventList list;
  ASSERT_TRUE(events.parse(kHeader + "1,0,pose,\n", "a", messages));

  events.take_before(0, list);
  EXPECT_TRUE(list.empty());
  events.take_before(2, list);  // progressive: even numbers only
  EXPECT_EQ(list.size(), 1);
}

TEST(ReplayEvents, TellsEachWrongRow) {
  ReplayEvents events;
  Messages messages;

  const auto outcome = events.parse(kHeader +
                                        "x,y,jump,\n"
                                        "0,0,claim,4\n0,0,claim,\"4,5,6\"\n"
                                        "0,0,start,\"1,2,3,4;1,3,5,6\"\n"
                                        "0,0,lamp,1001\n0,0,pick,\"nan,1\"\n0,0,pose,1\n0\n"
                                        "7,0,pose,\n6,0,pose,\n",
                                    "a.events.csv", messages);

  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error(), core::Error::kInvalidArgument);
  EXPECT_EQ(
      messages,
      (Messages{
          "a.events.csv:2: field: 'x', expected a whole number from 0",
          "a.events.csv:2: time_s: 'y', expected seconds with at most 9 decimals, or nothing",
          "a.events.csv:2: kind: 'jump', expected claim, start, lamp, pose, pick, acknowledge "
          "or pose-result",
          "a.events.csv:3: values: '4', expected R,C (row and column) for claim",
          "a.events.csv:4: values: '4,5,6', expected R,C (row and column) for claim",
          "a.events.csv:5: values: '1,2,3,4;1,3,5,6', expected 3 to 8 clicks R,C,U,V separated by "
          "';' for start",
          "a.events.csv:6: values: '1001', expected a level from 0 to 1000 for lamp",
          "a.events.csv:7: values: 'nan,1', expected U,V (pixels) for pick",
          "a.events.csv:8: values: '1', expected nothing, or the robot's own "
          "X,Y,Z[,ALPHA,BETA,GAMMA[,JOINT...]] (mm, deg) for pose",
          "a.events.csv:9: 1 cells, expected 4",
          "a.events.csv:11: field: 6, expected no less than in the row before (7)"}));
}

TEST(ReplayEvents, TellsARobotsPoseThatIsNone) {
  for (const char* const values :
       {"1,2", "1,2,3,", "1,2,3,4", "1,2,3,4,5", "1,2,3,4,5,", "1,2,3,,,", "1,2,3,,5,6", "1,2,x",
        "1,2,3.0000001", "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15", "1,2,3,4,5,6,"}) {
    ReplayEvents events;
    Messages messages;
    EXPECT_FALSE(events.parse(kHeader + "0,0,pose,\"" + values + "\"\n", "a", messages)) << values;
  }
}

TEST(ReplayEvents, RefusesMoreThanAStepTakes) {
  ReplayEvents events;
  Messages messages;
  std::string text = kHeader;
  for (int i = 0; i < 17; ++i) {
    text += "3,0,pose,\n";
  }

  EXPECT_FALSE(events.parse(text, "a", messages));
  EXPECT_EQ(messages, Messages{"a:18: field: more than 16 events before field 3, expected at most "
                               "that many"});
}

TEST(ReplayEvents, ReadsTheFileBesideARecording) {
  const support::TemporaryFolder folder;
  ReplayEvents events;
  Messages messages;

  EXPECT_TRUE(events.load_beside(folder.path("none.y4m"), messages));
  EXPECT_EQ(events.size(), 0u);
  folder.write("a.events.csv", kHeader + "0,0,pose,\n");
  EXPECT_TRUE(events.load_beside(folder.path("a.y4m.xz"), messages));
  EXPECT_EQ(events.size(), 1u);
  folder.write("b.events.csv", "kind\n");
  EXPECT_FALSE(events.load_beside(folder.path("b.y4m"), messages));
  EXPECT_EQ(messages, Messages{folder.path("b.events.csv") +
                               ":1: wrong header, expected field,time_s,kind,values"});
}

}  // namespace
}  // namespace tubesight::drivers
