#include "drivers/modbus/request_handler.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "tests/drivers/modbus/link_bench.h"

namespace tubesight::drivers {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Outcome = RequestHandler::Outcome;
using tests::LinkBench;
using namespace std::chrono_literals;

Bytes bytes_of(const Pdu& pdu) { return {pdu.begin(), pdu.end()}; }

struct Answer {
  Outcome outcome;
  Bytes bytes;
};

Answer ask(LinkBench& bench, const Bytes& request) {
  Pdu answer;
  const Outcome outcome = bench.handler.take(request, bench.now, answer);
  return {outcome, bytes_of(answer)};
}

void expect_exception(LinkBench& bench, const Bytes& request, std::uint8_t code) {
  const Answer answer = ask(bench, request);
  EXPECT_EQ(answer.outcome, Outcome::kRefused);
  EXPECT_EQ(answer.bytes, (Bytes{static_cast<std::uint8_t>(request[0] | 0x80), code}))
      << "function " << int{request[0]};
}

TEST(RequestHandler, Functions3And4ReadAlike) {
  LinkBench bench;

  const Answer holding = ask(bench, {3, 0, 2, 0, 4});
  const Answer input = ask(bench, {4, 0, 2, 0, 4});

  EXPECT_EQ(holding.outcome, Outcome::kAnswered);
  EXPECT_EQ(holding.bytes, (Bytes{3, 8, 1, 2, 3, 4, 0x54, 0x55, 0x42, 0x45}));
  EXPECT_EQ(input.bytes, (Bytes{4, 8, 1, 2, 3, 4, 0x54, 0x55, 0x42, 0x45}));
}

TEST(RequestHandler, Function6WritesOneAndEchoes) {
  LinkBench bench;

  const Answer answer = ask(bench, {6, 0x01, 0x4A, 0x02, 0x80});

  EXPECT_EQ(answer.bytes, (Bytes{6, 0x01, 0x4A, 0x02, 0x80}));
  EXPECT_EQ(bench.get(Register::kLampLevel), 640);
}

TEST(RequestHandler, Function16WritesSeveral) {
  LinkBench bench;

  const Answer answer = ask(bench, {16, 0x01, 0x2E, 0, 4, 8, 0, 0, 0, 12, 0xFF, 0xFF, 0xFF, 0xF9});

  EXPECT_EQ(answer.outcome, Outcome::kAnswered);
  EXPECT_EQ(answer.bytes, (Bytes{16, 0x01, 0x2E, 0, 4}));
  EXPECT_EQ(bench.get(Register::kClaimRow), 12);
  EXPECT_EQ(bench.get(Register::kClaimColumn), -7);
}

const Bytes kClaimAndVerdict{23,   0, 200, 0, 24, 1,    44,   0,    8,    16, 0, 0, 0x12,
                             0x67, 0, 0,   0, 12, 0xFF, 0xFF, 0xFF, 0xF9, 0,  0, 0, 1};

TEST(RequestHandler, Function23WaitsForTheVerdictOfItsClaim) {
  LinkBench bench;
  ASSERT_EQ(ask(bench, kClaimAndVerdict).outcome, Outcome::kWaits);
  const core::Event event = bench.take_event();

  bench.reply(
      event.id,
      core::ClaimReply{
          {12, -7}, core::ClaimVerdict::kConfirmed, core::ClaimDoubt::kNone, {12, -7}, 3601});
  Pdu answer;
  bench.handler.finish(bench.now, answer);

  const Bytes expected{23, 48, 0,    0,    0,    1,                 // sequence
                       0,  0,  0,    77,                            // boot
                       0,  3,  0,    1,    0,    0,    0,    0,     // valid, AGREE, reason, 0
                       0,  0,  0x12, 0x67,                          // id
                       0,  0,  0,    12,   0xFF, 0xFF, 0xFF, 0xF9,  // claim
                       0,  0,  0,    12,   0xFF, 0xFF, 0xFF, 0xF9,  // tube
                       0,  0,  0x0E, 0x11,                          // field
                       0,  0,  0,    0,    0,    0,    0,    1};    // age, sequence
  EXPECT_EQ(bytes_of(answer), expected);
}

TEST(RequestHandler, Function23WithoutAClaimAnswersAtOnce) {
  LinkBench bench;

  const Answer answer = ask(bench, {23, 0, 2, 0, 2, 1, 44, 0, 2, 4, 0, 0, 0, 5});

  EXPECT_EQ(answer.outcome, Outcome::kAnswered);
  EXPECT_EQ(answer.bytes, (Bytes{23, 4, 1, 2, 3, 4}));
}

TEST(RequestHandler, Function23ThatCannotBeAnsweredIsNotObeyed) {
  LinkBench bench;
  Bytes request = kClaimAndVerdict;
  request[4] = 25;  // one register behind the block

  expect_exception(bench, request, 2);

  EXPECT_EQ(bench.events.size(), 0u);
}

TEST(RequestHandler, RefusesUnknownFunctions) {
  LinkBench bench;
  for (const int function : {0, 1, 2, 5, 7, 8, 11, 15, 17, 20, 22, 24, 43, 100, 127}) {
    expect_exception(bench, {static_cast<std::uint8_t>(function), 0, 0, 0, 1}, 1);
  }
}

TEST(RequestHandler, RefusesRegistersOutOfTheMap) {
  LinkBench bench;
  expect_exception(bench, {3, 0, 16, 0, 1}, 2);
  expect_exception(bench, {4, 0xFF, 0xFF, 0, 2}, 2);
  expect_exception(bench, {3, 0, 0, 0, 17}, 2);
  expect_exception(bench, {6, 0, 100, 0, 1}, 2);
  expect_exception(bench, {16, 1, 51, 0, 2, 4, 0, 0, 0, 0}, 2);  // 307 is the last of its block
}

TEST(RequestHandler, RefusesCountsAndLengthsThatLie) {
  LinkBench bench;
  expect_exception(bench, {3, 0, 100, 0, 0}, 3);
  expect_exception(bench, {3, 0, 100, 0, 126}, 3);
  expect_exception(bench, {3, 0, 100, 1, 1}, 3);
  expect_exception(bench, {3, 0, 100}, 3);
  expect_exception(bench, {3, 0, 100, 0, 1, 0}, 3);
  expect_exception(bench, {6, 0, 100}, 3);
  expect_exception(bench, {16, 1, 44, 0, 1, 4, 0, 0, 0, 0}, 3);
  expect_exception(bench, {16, 1, 44, 0, 2, 4, 0, 0}, 3);
  expect_exception(bench, {16, 1, 44, 0, 0, 0}, 3);
  expect_exception(bench, {16}, 3);
  expect_exception(bench, {23, 0, 0, 0, 1, 1, 44, 0, 1, 4, 0, 0}, 3);
  expect_exception(bench, {23, 0, 0, 0, 126, 1, 44, 0, 1, 2, 0, 0}, 3);
  expect_exception(bench, {23, 0, 0, 0, 1, 1, 44}, 3);
}

TEST(RequestHandler, RefusesValuesAndWritesNothingOfThem) {
  LinkBench bench;

  expect_exception(bench, {6, 0x01, 0x4A, 0x03, 0xE9}, 3);  // 1001 permille

  EXPECT_EQ(bench.get(Register::kLampLevel), 1000);
}

TEST(RequestHandler, SaysBusyWhenTheLoopDoesNotListen) {
  LinkBench bench;
  for (std::int32_t i = 0; i < OutboxShare::kMostClaims; ++i) {
    ASSERT_EQ(ask(bench, kClaimAndVerdict).outcome, Outcome::kWaits);
  }

  expect_exception(bench, kClaimAndVerdict, 6);
}

}  // namespace
}  // namespace tubesight::drivers
