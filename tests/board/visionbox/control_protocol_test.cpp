#include "board/visionbox/control_protocol.h"

#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "tests/support/events.h"

namespace tubesight::board {
namespace {

core::StartSettings three_clicks() {
  core::StartSettings start;
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(start.tubes.try_push_back({{40 + i, 60}, {300.0 + i, 190.0}}));
  }
  return start;
}

core::Event event_of_line(const std::string& line, const core::StartSettings& start = {}) {
  const ControlRequest request = parse_request(line, start);
  const auto* const event = std::get_if<EventRequest>(&request.content);
  EXPECT_NE(event, nullptr) << line;
  return event != nullptr ? event->event : core::Event{};
}

TEST(ParseRequest, KnowsEachCommand) {
  EXPECT_TRUE(std::holds_alternative<StatusRequest>(parse_request("1 status", {}).content));
  EXPECT_TRUE(std::holds_alternative<SelfTestRequest>(parse_request("1 self-test", {}).content));
  EXPECT_TRUE(std::holds_alternative<RecordRequest>(parse_request("1 record", {}).content));
  EXPECT_EQ(parse_request("1 status", {}).command, "status");
  EXPECT_EQ(tests::content_of<core::LampCommand>(event_of_line("1 lamp 640")).permille, 640);
}

TEST(ParseRequest, StartTakesTubesFieldAndConfirmation) {
  const core::Event event = event_of_line("1 start -3,5,10.5,20;4,6,1,2 field=41 confirm");

  EXPECT_EQ(event.origin, core::EventOrigin::kOperator);
  const auto start = tests::content_of<core::Start>(event);
  ASSERT_EQ(start.tubes.size(), 2);
  EXPECT_EQ(start.tubes[0].address, (core::TubeAddress{-3, 5}));
  EXPECT_EQ(start.tubes[0].at_px, (std::array<double, 2>{10.5, 20.0}));
  EXPECT_EQ(start.seen_field, 41);
  EXPECT_TRUE(start.confirmed);
}

TEST(ParseRequest, StartWithoutTubesTakesThoseOfTheSettings) {
  const auto start = tests::content_of<core::Start>(event_of_line("1 start", three_clicks()));

  ASSERT_EQ(start.tubes.size(), 3);
  EXPECT_EQ(start.tubes[2].address, (core::TubeAddress{42, 60}));
  EXPECT_FALSE(start.seen_field);
  EXPECT_FALSE(start.confirmed);
}

TEST(ParseRequest, PickTakesAPlaceAndAField) {
  const auto pick = tests::content_of<core::Pick>(event_of_line("1 pick 3.5,4.25 field=12"));

  EXPECT_EQ(pick.at_px, (std::array<double, 2>{3.5, 4.25}));
  EXPECT_EQ(pick.seen_field, 12);
}

TEST(ParseRequest, RefusesEverythingElse) {
  for (const std::string line :
       {"",
        " ",
        "status",
        "2 status",
        "1",
        "1 ",
        "1 nonsense",
        "1 status now",
        "1 lamp",
        "1 lamp -1",
        "1 lamp 1001",
        "1 lamp 5 5",
        "1 lamp 1e2",
        "1 pick",
        "1 pick 1",
        "1 pick 1,2,3",
        "1 pick 1,x",
        "1 pick 1,2 field=-1",
        "1 pick 1,2 later",
        "1 pick nan,1",
        "1 start",
        "1 start 1,2,3",
        "1 start 1,2,3,4,5",
        "1 start 1.5,2,3,4",
        "1 start 1,2,3,4;",
        "1 start 99999999999,2,3,4",
        "1 start 1,2,3,4 5,6,7,8",
        "1 start confirmed",
        "1 start 1,1,1,1;1,1,1,1;1,1,1,1;1,1,1,1;1,1,1,1;1,1,1,1;1,1,1,1;1,1,1,1;1,1,1,1",
        "1 \xff\xfe",
        "11 status"}) {
    const ControlRequest request = parse_request(line, {});
    EXPECT_TRUE(std::holds_alternative<WrongRequest>(request.content)) << line;
  }
}

TEST(ReplyAnswer, TellsWhatTheBoxSaid) {
  core::Reply reply;
  reply.content = core::StartReply{core::StartRefusal::kMoved};
  EXPECT_EQ(reply_answer("start", reply),
            R"({"protocol":1,"ok":false,"command":"start","error":"moved",)"
            R"("text":"refused: the tool may have moved since the picture clicked into"})");
  reply.content = core::StartReply{};
  EXPECT_EQ(reply_answer("start", reply),
            R"({"protocol":1,"ok":true,"command":"start","text":"taken: the box tracks"})");
  reply.content = core::PickReply{core::PickDoubt::kNone, {40, -7}};
  EXPECT_EQ(reply_answer("pick", reply),
            R"({"protocol":1,"ok":true,"command":"pick","tube":"40,-7","text":"tube 40,-7"})");
  reply.content = core::PickReply{core::PickDoubt::kNoTube, {}};
  EXPECT_EQ(reply_answer("pick", reply),
            R"({"protocol":1,"ok":false,"command":"pick","error":"no-tube",)"
            R"("text":"no tube stands there"})");
  reply.content = core::LampReply{300};
  EXPECT_EQ(reply_answer("lamp", reply),
            R"({"protocol":1,"ok":true,"command":"lamp","permille":300,"automatic":false,)"
            R"("text":"300 permille wanted from now on"})");
  reply.content = core::LampReply{700, true};
  EXPECT_EQ(reply_answer("lamp", reply),
            R"({"protocol":1,"ok":true,"command":"lamp","permille":700,"automatic":true,)"
            R"("text":"700 permille now, by the picture from now on"})");
}

}  // namespace
}  // namespace tubesight::board
