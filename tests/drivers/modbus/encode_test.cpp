#include "drivers/modbus/encode.h"

#include <gtest/gtest.h>

#include "drivers/modbus/register_codes.h"
#include "tests/drivers/modbus/link_bench.h"

namespace tubesight::drivers {
namespace {

using tests::kBegin;
using tests::LinkBench;
using namespace std::chrono_literals;
using enum Register;

constexpr std::int32_t kAllBits = 0x3FF;

TEST(EncodeSighting, SaysAllThatIsKnown) {
  LinkBench bench;

  EXPECT_EQ(bench.get(kSequence), 5);
  EXPECT_EQ(bench.get(kSequenceAgain), 5);
  EXPECT_EQ(bench.get(kSightingBoot), 77);
  EXPECT_EQ(bench.get(kSightingValid), kAllBits);
  EXPECT_EQ(bench.get(kState), 2);
  EXPECT_EQ(bench.get(kReason), 0);
  EXPECT_EQ(bench.get(kLiveness), 1);
  EXPECT_EQ(bench.get(kJudgedFields), 3500);
  EXPECT_EQ(bench.get(kAge), 20);
  EXPECT_EQ(bench.get(kSightingAge), 20);
  EXPECT_EQ(bench.get(kField), 3600);
  EXPECT_EQ(bench.get(kPrimaryRow), 13);
  EXPECT_EQ(bench.get(kPrimaryColumn), -6);
  EXPECT_EQ(bench.get(kPrimaryU), 320'000);
  EXPECT_EQ(bench.get(kPrimaryV), 190'500);
  EXPECT_EQ(bench.get(kTubeRow), 12);
  EXPECT_EQ(bench.get(kTubeColumn), -7);
  EXPECT_EQ(bench.get(kOffset), 500);
  EXPECT_EQ(bench.get(kOffsetX), 300);
  EXPECT_EQ(bench.get(kOffsetY), -400);
  EXPECT_EQ(bench.get(kHeight), 50'000);
  EXPECT_EQ(bench.get(kAxisU), 300'000);
  EXPECT_EQ(bench.get(kAxisV), -10'000);
  EXPECT_EQ(bench.get(kMargin), 123'456);
  EXPECT_EQ(bench.get(kVelocityX), 1500);
  EXPECT_EQ(bench.get(kVelocityY), -250);
  EXPECT_EQ(bench.get(kTracked), 9);
  EXPECT_EQ(bench.get(kAligned), 1);
  EXPECT_EQ(bench.get(kResidual), 100);
}

TEST(EncodeSelfTest, SaysWhatTheBoxFoundOfItself) {
  LinkBench bench;
  EXPECT_EQ(bench.get(kSelfTest), 0) << "not finished";
  EXPECT_EQ(bench.get(kBootNumber), kUnknown);
  EXPECT_EQ(bench.get(kStartNumber), kUnknown);

  bench.state.self_test = {Health::kFailed, 0x0101, 0x3000, 17, 2, 86'400};

  EXPECT_EQ(bench.get(kSelfTest), 2);
  EXPECT_EQ(bench.get(kSelfTestBad), 0x0101) << "numbers and disk";
  EXPECT_EQ(bench.get(kSelfTestAbsent), 0x3000) << "boots and watchdog";
  EXPECT_EQ(bench.get(kSelfTestReserved), 0);
  EXPECT_EQ(bench.get(kBootNumber), 17);
  EXPECT_EQ(bench.get(kStartNumber), 2);
  EXPECT_EQ(bench.get(kUp), 86'400);
  bench.state.self_test.verdict = Health::kWell;
  EXPECT_EQ(bench.get(kSelfTest), 1);
}

/// Every value of the block but those that need no sighting.
void expect_nothing_known(LinkBench& bench) {
  EXPECT_EQ(bench.get(kSightingValid), 0);
  for (const RegisterRow& row : register_table()) {
    if (row.address >= 105 && row.address < 150 && row.name != kJudgedFields) {
      EXPECT_EQ(bench.get(row.name), row.width == 1 ? kUnknownWord : kUnknown) << row.label;
    }
  }
}

TEST(EncodeSighting, IsInvalidOnceItIsOver100MillisecondsOld) {
  LinkBench bench;

  bench.now = bench.state.sighting->time + 100ms;
  EXPECT_EQ(bench.get(kSightingValid), kAllBits);
  bench.now = bench.state.sighting->time + 100ms + 1ns;
  expect_nothing_known(bench);
  bench.now = bench.state.sighting->time - 101ms;  // another clock
  expect_nothing_known(bench);
}

TEST(EncodeSighting, NothingIsKnownBeforeTheFirst) {
  LinkBench bench;
  bench.state.sighting.reset();
  bench.state.sequence = 0;

  expect_nothing_known(bench);
  EXPECT_EQ(bench.get(kSequence), 0);
}

TEST(EncodeSighting, CoastingForLongLeavesTheStateAlone) {
  LinkBench bench;
  bench.state.sighting->judged = false;
  bench.state.sighting->age = 81ms;  // and 20 ms until it is read
  bench.state.sighting->state = core::TrackState::kLost;
  bench.state.sighting->reason = core::Reason::kCoasted;

  EXPECT_EQ(bench.get(kSightingValid), 0b1'0000'0101) << "sighting, age, liveness";
  EXPECT_EQ(bench.get(kState), 4);
  EXPECT_EQ(bench.get(kAligned), 0);
  EXPECT_EQ(bench.get(kAge), 101);
  EXPECT_EQ(bench.get(kTubeRow), kUnknown);
}

TEST(EncodeSighting, EachUnknownTakesItsBitAlone) {
  const auto bits = [](auto&& change) {
    LinkBench bench;
    change(*bench.state.sighting);
    return bench.get(kSightingValid) ^ kAllBits;
  };

  EXPECT_EQ(bits([](core::Sighting& s) { s.primary_known = false; }), 1 << 3);
  EXPECT_EQ(bits([](core::Sighting& s) { s.tool_known = false; }), 1 << 4);
  EXPECT_EQ(bits([](core::Sighting& s) { s.axis_known = false; }), 1 << 5);
  EXPECT_EQ(bits([](core::Sighting& s) { s.margin_known = false; }), 1 << 6);
  EXPECT_EQ(bits([](core::Sighting& s) { s.velocity_known = false; }), 1 << 7);
  EXPECT_EQ(bits([](core::Sighting& s) { s.liveness = core::Liveness::kUnknown; }), 1 << 8);
  EXPECT_EQ(bits([](core::Sighting& s) { s.judged = false; }), 1 << 1 | 1 << 9);
}

TEST(EncodeSighting, VouchesForNothingThatIsNotKnown) {
  LinkBench unknown;
  unknown.state.sighting->tool_known = false;
  EXPECT_EQ(unknown.get(kAligned), 0);
  LinkBench coasting;
  coasting.state.sighting->judged = false;
  EXPECT_EQ(coasting.get(kAligned), 0);
}

TEST(EncodeIdentity, SaysWhoItIs) {
  LinkBench bench;

  EXPECT_EQ(bench.get(kMapVersion), 1);
  EXPECT_EQ(bench.get(kWordOrderMark), 0x01020304);
  EXPECT_EQ(bench.get(kProduct), 0x54554245);
  EXPECT_EQ(bench.get(kProductVersion), 102);
  EXPECT_EQ(bench.get(kBoot), 77);
  EXPECT_EQ(bench.get(kIdentityValid), 1);
  EXPECT_EQ(bench.get(kCameraId), 0x11223344);
  EXPECT_EQ(bench.get(kToolId), kUnknown);
  EXPECT_EQ(bench.get(kBaseId), kUnknown);
}

TEST(EncodeHealth, SaysWhatIsKnownOfLampAndCamera) {
  LinkBench bench;
  EXPECT_EQ(bench.get(kHealthValid), 1 << 2) << "the lamp's pattern alone";
  EXPECT_EQ(bench.get(kCameraHealth), kUnknownWord);

  bench.state.health = {Health::kWell, Health::kFailed, true, false, 640, 100, 3, 2};
  bench.state.counters.crc_errors = 0x12345678;

  EXPECT_EQ(bench.get(kHealthValid), 0b11111);
  EXPECT_EQ(bench.get(kCameraHealth), 1);
  EXPECT_EQ(bench.get(kLampHealth), 2);
  EXPECT_EQ(bench.get(kLampPattern), 1);
  EXPECT_EQ(bench.get(kLampNow), 640);
  EXPECT_EQ(bench.get(kLampModeNow), 1) << "commanded";
  bench.state.health.lamp_automatic = true;
  EXPECT_EQ(bench.get(kLampModeNow), 2) << "the box's own";
  bench.state.health.lamp_dimmed = false;
  EXPECT_EQ(bench.get(kLampModeNow), 0) << "nobody dims it";
  EXPECT_EQ(bench.get(kFields), 100);
  EXPECT_EQ(bench.get(kFieldsMissing), 3);
  EXPECT_EQ(bench.get(kFieldsLate), 2);
  EXPECT_EQ(bench.get(kCrcErrors), 0x12345678);
}

}  // namespace
}  // namespace tubesight::drivers
