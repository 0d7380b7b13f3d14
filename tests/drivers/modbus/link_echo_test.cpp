// A line on which the box hears what it sends: it must not talk to itself.

#include <thread>

#include "tests/drivers/modbus/link_on_line.h"

namespace tubesight::drivers {
namespace {

using tests::Bytes;
using tests::kMark;
using tests::kReadMark;
using tests::rtu_frame;
using namespace std::chrono_literals;

/// So slow that a time of the line is long for a busy machine: 8 bytes take 73 ms.
ModbusSettings slow_settings(const std::string& device) {
  ModbusSettings settings = tests::settings_for(device);
  settings.serial.line.baud = 1200;
  settings.serial.frame_gap = 40ms;
  return settings;
}

/// A link on two wires whose receiver is never off.
class EchoingLine : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(link_.start()); }

  /// Sends a request, and whatever the box answers back to it, for so long; all answers.
  [[nodiscard]] Bytes ask(const Bytes& request, std::chrono::milliseconds time = 120ms) const {
    line_.send(rtu_frame(17, request));
    Bytes all;
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) {
      const Bytes answer = line_.receive(10ms);
      if (!answer.empty()) {
        line_.send(answer);
        all.insert(all.end(), answer.begin(), answer.end());
      }
    }
    return all;
  }
  [[nodiscard]] LinkCounters counters() const {
    LinkCounters now;
    while (!link_.counters(now)) {
      std::this_thread::yield();
    }
    return now;
  }
  int events() {
    int count = 0;
    for (int i = 0; i < 20; ++i) {
      const auto event = link_.poll_event();
      count += event && *event ? 1 : 0;
    }
    return count;
  }

  tests::Pty line_;
  tests::SteadyClock clock_;
  ModbusRobotLink link_{slow_settings(line_.device()), tests::make_identity(), clock_};
};

TEST_F(EchoingLine, EachRequestIsAnsweredOnce) {
  const Bytes level{6, 1, 74, 2, 128};
  const Bytes refused{0x83, 2};
  EXPECT_EQ(ask(level), rtu_frame(17, level)) << "before the line is known";
  EXPECT_EQ(ask(kReadMark), rtu_frame(17, kMark));
  EXPECT_EQ(ask({3, 0, 99, 0, 1}), rtu_frame(17, refused));
  EXPECT_EQ(ask({16, 1, 74, 0, 1, 2, 2, 128}), rtu_frame(17, {16, 1, 74, 0, 1}));
  EXPECT_EQ(ask(level), rtu_frame(17, level));

  const LinkCounters now = counters();
  EXPECT_EQ(now.requests, 5U);
  EXPECT_EQ(now.answers, 5U);
  EXPECT_EQ(now.exceptions, 1U);
  EXPECT_EQ(now.stray_bytes, 8U + 9U + 5U + 8U + 8U) << "what came back";
  EXPECT_EQ(now.crc_errors + now.cut_frames, 0U);
}

TEST_F(EchoingLine, AClaimByFunction6IsOneClaim) {
  const Bytes commit{6, 1, 51, 0, 1};
  EXPECT_EQ(ask(commit), rtu_frame(17, commit));
  EXPECT_EQ(events(), 1);
}

TEST_F(EchoingLine, ARequestRightBehindAnEchoIsAnswered) {
  line_.send(rtu_frame(17, kReadMark));
  const Bytes answer = line_.receive(1000ms);
  ASSERT_EQ(answer, rtu_frame(17, kMark));

  Bytes both = answer;
  const Bytes next = rtu_frame(17, {3, 0, 0, 0, 1});
  both.insert(both.end(), next.begin(), next.end());
  line_.send(both);

  EXPECT_EQ(line_.receive(1000ms), rtu_frame(17, {3, 2, 0, 1}));
}

TEST_F(EchoingLine, ALateEchoOfAWriteIsKnownOnceTheLineIs) {
  EXPECT_EQ(ask(kReadMark), rtu_frame(17, kMark));
  const Bytes commit = rtu_frame(17, {6, 1, 51, 0, 1});
  line_.send(commit);
  ASSERT_EQ(line_.receive(1000ms), commit);
  std::this_thread::sleep_for(200ms);  // an adapter that hands on late
  line_.send(commit);

  EXPECT_EQ(line_.receive(100ms), Bytes());

  EXPECT_EQ(events(), 1);
}

/// Without an echo nothing is lost.
TEST_F(EchoingLine, TheSameWriteTwiceIsTwoRequestsWhereNothingComesBack) {
  ASSERT_EQ(tests::ask(line_, kReadMark), kMark);
  const Bytes level{6, 1, 74, 2, 128};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(tests::ask(line_, level), level) << i;
  }
  EXPECT_EQ(counters().stray_bytes, 0U);
}

}  // namespace
}  // namespace tubesight::drivers
