#include "drivers/modbus/outbox.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

using std::chrono::seconds;

TEST(OutboxShare, OneThatAsksTooMuchShutsNobodyOut) {
  EventQueue queue;
  Outbox outbox(queue);
  OutboxShare greedy(outbox);
  OutboxShare modest(outbox);

  std::int32_t sent = 0;
  while (greedy.has_room(1, OutboxShare::kMostClaims) && sent < 100) {
    greedy.send(core::Claim{}, 1, seconds(1));
    ++sent;
  }

  EXPECT_EQ(sent, OutboxShare::kMostClaims);
  EXPECT_TRUE(greedy.has_room(2, OutboxShare::kMostEvents)) << "two of the commands";
  EXPECT_FALSE(greedy.has_room(3, OutboxShare::kMostEvents));
  EXPECT_TRUE(modest.has_room(OutboxShare::kMostEvents, OutboxShare::kMostEvents));
}

TEST(OutboxShare, HasRoomForAsManyAsTheLoopTook) {
  EventQueue queue;
  Outbox outbox(queue);
  OutboxShare first(outbox);
  OutboxShare second(outbox);
  for (int i = 0; i < 3; ++i) {
    first.send(core::Claim{}, i, seconds(1));
    second.send(core::Claim{}, i, seconds(1));
  }
  EXPECT_FALSE(first.has_room(1, 3));
  EXPECT_FALSE(second.has_room(1, 3));

  core::Event event;
  ASSERT_TRUE(queue.try_pop(event));  // the first's

  EXPECT_TRUE(first.has_room(1, 3));
  EXPECT_FALSE(first.has_room(2, 3));
  EXPECT_FALSE(second.has_room(1, 3));
  for (int turn = 0; turn < 1000; ++turn) {  // the ring of the last ones goes round
    first.send(core::Claim{}, turn, seconds(1));
    EXPECT_FALSE(first.has_room(1, 3));
    ASSERT_TRUE(queue.try_pop(event));
    ASSERT_TRUE(queue.try_pop(event));
    second.send(core::Claim{}, turn, seconds(1));
  }
}

TEST(OutboxShare, AllMastersTogetherHaveRoom) {
  EventQueue queue;
  Outbox outbox(queue);
  for (int master = 0; master < 5; ++master) {
    OutboxShare share(outbox);
    for (std::int32_t i = 0; i < OutboxShare::kMostEvents; ++i) {
      ASSERT_TRUE(share.has_room(1, OutboxShare::kMostEvents)) << master << ", " << i;
      share.send(core::Claim{}, i, seconds(1));
    }
    EXPECT_FALSE(share.has_room(1, OutboxShare::kMostEvents));
  }
}

}  // namespace
}  // namespace tubesight::drivers
