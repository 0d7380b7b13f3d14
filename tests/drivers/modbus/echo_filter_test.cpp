#include "drivers/modbus/echo_filter.h"

#include <chrono>
#include <vector>

#include <gtest/gtest.h>

#include "tests/drivers/modbus/serial_robot.h"

namespace tubesight::drivers {
namespace {

using tests::Bytes;
using tests::rtu_frame;
using namespace std::chrono_literals;

const Bytes kWritten = rtu_frame(17, {6, 1, 51, 0, 1});  // request and answer
const Bytes kRead = rtu_frame(17, {3, 4, 1, 2, 3, 4});
const Bytes kNextRequest = rtu_frame(17, {3, 0, 2, 0, 2});

/// A filter on a line where all comes at one instant, sooner than an answer and a request take.
struct EchoBench {
  EchoFilter filter;
  core::FieldTime arrival{1s};
  Bytes passed;
  int echoes = 0;

  void answer(const Bytes& bytes) {
    RtuFrame frame;
    for (const std::uint8_t byte : bytes) {
      ASSERT_TRUE(frame.try_push_back(byte));
    }
    filter.expect(frame, 1s + 10ms);
    passed.clear();
  }
  void come(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      const EchoFilter::Byte what = filter.take(byte, arrival);
      echoes += what == EchoFilter::Byte::kEcho ? 1 : 0;
      if (what == EchoFilter::Byte::kOther) {
        pass_held();
      }
    }
  }
  void pass_held() { passed.insert(passed.end(), filter.held().begin(), filter.held().end()); }
  /// A request came, whole, and was found so.
  bool request(const Bytes& frame) {
    come(frame);
    return filter.is_echo(std::span(frame).subspan(1, frame.size() - 3), arrival);
  }
};

TEST(EchoFilter, LetsThroughWhatIsNoEchoByteByByte) {
  EchoBench bench;
  bench.come(kNextRequest);
  EXPECT_EQ(bench.passed, kNextRequest) << "before any answer";

  bench.answer(kRead);
  EXPECT_FALSE(bench.request(kNextRequest)) << "its first two bytes are the answer's";

  EXPECT_EQ(bench.passed, kNextRequest);
  EXPECT_EQ(bench.echoes, 0);
}

TEST(EchoFilter, TakesAnEchoOutInFrontOfARequest) {
  EchoBench bench;
  bench.answer(kRead);
  bench.arrival += 5s;  // no request looks like that, whenever it comes

  bench.come(kRead);
  bench.come(kNextRequest);

  EXPECT_EQ(bench.echoes, 1);
  EXPECT_EQ(bench.passed, kNextRequest);
  bench.come(kRead);
  EXPECT_EQ(bench.echoes, 1) << "one answer comes back once";
}

TEST(EchoFilter, AnEchoThatBreaksOffIsLetGoWithTheSilence) {
  EchoBench bench;
  bench.answer(kRead);
  bench.come({kRead.begin(), kRead.begin() + 4});
  ASSERT_TRUE(bench.filter.holds());

  bench.filter.let_go();
  bench.pass_held();

  EXPECT_FALSE(bench.filter.holds());
  EXPECT_EQ(bench.passed.size(), 4U);
}

TEST(EchoFilter, TheSameWriteIsAnEchoWhereItComesTooSoon) {
  EchoBench bench;
  bench.answer(kWritten);
  bench.come(kWritten);
  EXPECT_EQ(bench.echoes, 1);

  bench.answer(kWritten);
  bench.arrival += 11ms;
  EXPECT_FALSE(bench.request(kWritten)) << "a master may have asked again by now";
  EXPECT_EQ(bench.passed, kWritten);
  EXPECT_EQ(bench.echoes, 1);
}

TEST(EchoFilter, TheSameWriteDoesNotGoRoundForEverWhereEchoesAreLate) {
  EchoBench bench;
  bench.arrival += 30ms;
  for (int i = 0; i < 3; ++i) {
    bench.answer(kWritten);
    EXPECT_FALSE(bench.request(kWritten)) << i;
  }
  bench.answer(kWritten);
  bench.come(kWritten);
  EXPECT_EQ(bench.echoes, 1);

  bench.arrival += 100ms;
  for (int i = 0; i < 10; ++i) {
    bench.answer(kWritten);
    EXPECT_FALSE(bench.request(kWritten)) << "a master that repeats itself";
  }
  EXPECT_EQ(bench.echoes, 1);
}

TEST(EchoFilter, TheSameWriteIsAnEchoWheneverItComesOnALineThatEchoes) {
  EchoBench bench;
  bench.answer(kRead);
  bench.come(kRead);
  bench.arrival += 1s;

  bench.answer(kWritten);
  bench.come(kWritten);
  EXPECT_EQ(bench.echoes, 2);

  EXPECT_FALSE(bench.request(kWritten)) << "the second is the master's";
  EXPECT_EQ(bench.passed, kWritten);
}

TEST(EchoFilter, TheSameWriteIsARequestOnALineThatDoesNotEcho) {
  EchoBench bench;
  bench.answer(kRead);
  EXPECT_FALSE(bench.request(kNextRequest));

  bench.answer(kWritten);
  EXPECT_FALSE(bench.request(kWritten));

  EXPECT_EQ(bench.passed, kWritten);
}

TEST(EchoFilter, AnEchoBehindNoiseIsNoneTheLess) {
  EchoBench bench;
  bench.answer(kRead);
  bench.come({0xFF});
  bench.come(kNextRequest);
  EXPECT_FALSE(bench.filter.is_echo(Bytes{3, 0, 2, 0, 2}, bench.arrival));

  bench.answer(kWritten);
  bench.come({0xFF});
  EXPECT_TRUE(bench.request(kWritten)) << "noise does not prove that the line does not echo";
}

}  // namespace
}  // namespace tubesight::drivers
