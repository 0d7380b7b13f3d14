#include "board/bench/event_feed.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/events.h"

namespace tubesight::board {
namespace {

using core::EventList;

core::StartSettings start_of_rows(std::int32_t count) {
  core::StartSettings start;
  for (std::int32_t row = 0; row < count; ++row) {
    EXPECT_TRUE(start.tubes.try_push_back({{row, 7}, {1.0, 2.0}}));
  }
  return start;
}

drivers::ReplayEvents claims(int count, int field) {
  std::string text = "field,time_s,kind,values\n";
  for (int i = 0; i < count; ++i) {
    text += std::to_string(field) + ",,claim,\"" + std::to_string(i) + ",0\"\n";
  }
  drivers::ReplayEvents events;
  drivers::Messages messages;
  EXPECT_TRUE(events.parse(text, "events", messages));
  return events;
}

TEST(EventFeed, HandsTheSettingsStartBeforeTheFirstFieldOnly) {
  EventFeed feed(start_of_rows(3));
  drivers::ReplayEvents none;
  EventList events;

  feed.take_before(0, none, events);

  ASSERT_EQ(events.size(), 1);
  const auto start = tests::content_of<core::Start>(events[0]);
  ASSERT_EQ(start.tubes.size(), 3);
  EXPECT_EQ(start.tubes[2].address, (core::TubeAddress{2, 7}));
  feed.take_before(1, none, events);
  EXPECT_TRUE(events.empty());
}

TEST(EventFeed, HandsRecordedEventsAfterTheStart) {
  EventFeed feed(start_of_rows(3));
  drivers::ReplayEvents recorded = claims(2, 0);
  EventList events;

  feed.take_before(0, recorded, events);

  ASSERT_EQ(events.size(), 3);
  EXPECT_TRUE(tests::is<core::Start>(events[0]));
  EXPECT_EQ(tests::content_of<core::Claim>(events[1]).tube.row, 0);
  EXPECT_EQ(tests::content_of<core::Claim>(events[2]).tube.row, 1);
}

TEST(EventFeed, HandsWhatDoesNotFitBeforeTheNextField) {
  EventFeed feed(start_of_rows(3));
  drivers::ReplayEvents recorded = claims(core::kMaxEventsPerField, 0);
  EventList events;

  feed.take_before(0, recorded, events);

  EXPECT_EQ(events.size(), 16);
  EXPECT_EQ(tests::content_of<core::Claim>(events[15]).tube.row, 14);
  EXPECT_EQ(feed.left(), 1U);
  feed.take_before(1, recorded, events);
  ASSERT_EQ(events.size(), 1);
  EXPECT_EQ(tests::content_of<core::Claim>(events[0]).tube.row, 15);
  EXPECT_EQ(feed.left(), 0U);
}

}  // namespace
}  // namespace tubesight::board
