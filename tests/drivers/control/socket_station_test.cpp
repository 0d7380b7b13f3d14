#include "drivers/control/socket_station.h"

#include <thread>

#include "tests/hal/operator_station_contract.h"
#include "tests/support/events.h"

namespace tubesight::support {
namespace {

using drivers::SocketStation;

class SocketMaker {
 public:
  hal::OperatorStation& station() { return station_; }
  void say(const core::Event& event) { ASSERT_TRUE(station_.submit(event)); }
  [[nodiscard]] std::size_t replies() {
    while (station_.take_reply()) {
      ++replies_;
    }
    return replies_;
  }
  [[nodiscard]] std::size_t pictures() const {
    return static_cast<std::size_t>(station_.pictures());
  }

 private:
  SocketStation station_;
  std::size_t replies_ = 0;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Socket, OperatorStationContract, SocketMaker);

TEST(SocketStation, RefusesEventsWhileNobodyTakesThem) {
  SocketStation station;

  EXPECT_FALSE(station.submit({}));
  ASSERT_TRUE(station.start());
  EXPECT_TRUE(station.submit({}));
}

TEST(SocketStation, TellsOnceThatEventsFoundNoRoomAndGoesOn) {
  SocketStation station;
  ASSERT_TRUE(station.start());
  int taken = 0;
  while (station.submit({})) {
    ++taken;
  }

  const auto told = station.poll_event();

  ASSERT_FALSE(told);
  EXPECT_EQ(told.error(), core::Error::kDataLoss);
  for (int i = 0; i < taken; ++i) {
    const auto polled = station.poll_event();
    ASSERT_TRUE(polled);
    EXPECT_TRUE(polled->has_value());
  }
  EXPECT_TRUE(station.submit({}));
}

TEST(SocketStation, SaysWhenAnswersAreNotTaken) {
  SocketStation station;
  ASSERT_TRUE(station.start());
  core::Result<void> sent;
  for (int i = 0; i < 1000 && sent; ++i) {
    sent = station.send_reply({});
  }

  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error(), core::Error::kBufferTooSmall);
}

TEST(SocketStation, CarriesEventsAndAnswersBetweenTwoThreads) {
  constexpr std::int64_t kEvents = 20'000;
  SocketStation station;
  ASSERT_TRUE(station.start());
  std::thread tracking([&] {
    std::int64_t next = 0;
    while (next < kEvents) {
      const auto polled = station.poll_event();
      if (!polled || !polled->has_value()) {
        std::this_thread::yield();
        continue;
      }
      core::Reply reply;
      reply.id = (*polled)->id;
      while (!station.send_reply(reply)) {
        std::this_thread::yield();
      }
      next = reply.id + 1;
    }
  });
  std::int64_t sent = 0;
  std::int64_t answered = 0;
  while (answered < kEvents) {
    core::Event event = tests::event_of(core::Pick{}, core::EventOrigin::kOperator);
    event.id = sent;
    if (sent < kEvents && station.submit(event)) {
      ++sent;
    }
    while (const auto reply = station.take_reply()) {
      ASSERT_EQ(reply->id, answered);
      ++answered;
    }
  }
  tracking.join();
}

}  // namespace
}  // namespace tubesight::support
