#include <vector>

#include <gtest/gtest.h>

#include "drivers/modbus/dialogue.h"
#include "tests/drivers/modbus/link_bench.h"
#include "tests/support/events.h"

namespace tubesight::drivers {
namespace {

using tests::content_of;
using tests::kBegin;
using tests::LinkBench;
using namespace std::chrono_literals;
using enum Register;

/// Writes the block claim in one go.
Refusal claim(LinkBench& bench, std::int32_t id, core::TubeAddress tube, std::int32_t age_ms = 0) {
  RegisterImage image(WordOrder::kHighFirst);
  image.set(kClaimId, id);
  image.set(kClaimRow, tube.row);
  image.set(kClaimColumn, tube.column);
  image.set(kClaimAge, age_ms);
  image.set(kClaimCommit, 1);
  std::vector<std::uint16_t> words;
  for (std::int32_t address = 300; address < 308; ++address) {
    words.push_back(image.word(address));
  }
  return bench.dialogue.write(300, words, bench.now);
}

core::ClaimReply agree(core::TubeAddress tube) {
  return {tube, core::ClaimVerdict::kConfirmed, core::ClaimDoubt::kNone, tube, 3601};
}

TEST(DialogueClaim, BecomesAnEventAtItsOwnInstant) {
  LinkBench bench;

  ASSERT_EQ(claim(bench, 4711, {12, -7}, 30), Refusal::kNone);

  const core::Event event = bench.take_event();
  EXPECT_EQ(content_of<core::Claim>(event).tube, (core::TubeAddress{12, -7}));
  EXPECT_EQ(event.at, kBegin - 30ms);
  EXPECT_EQ(event.origin, core::EventOrigin::kRobot);
  EXPECT_EQ(event.id & 0xFFFFFFFF, 4711);
  EXPECT_EQ(bench.get(kClaimAge), 0) << "the next claim is of now unless it says otherwise";
  EXPECT_EQ(bench.get(kClaimCommit), 0);
}

TEST(DialogueClaim, IsNoneWithoutCommit) {
  LinkBench bench;

  ASSERT_EQ(bench.set(kClaimRow, 12), Refusal::kNone);

  EXPECT_EQ(bench.events.size(), 0u);
  ASSERT_EQ(bench.set(kClaimCommit, 1), Refusal::kNone) << "register by register";
  EXPECT_EQ(content_of<core::Claim>(bench.take_event()).tube.row, 12);
}

TEST(DialogueClaim, EchoesIdAndClaimWithTheVerdict) {
  LinkBench bench;
  ASSERT_EQ(claim(bench, 4711, {12, -7}, 30), Refusal::kNone);
  const core::Event event = bench.take_event();
  EXPECT_EQ(bench.get(kVerdictValid), 4) << "being judged";
  EXPECT_EQ(bench.get(kVerdict), 0);

  bench.now += 10ms;
  bench.reply(event.id, agree({12, -7}));

  EXPECT_EQ(bench.get(kVerdictValid), 3);
  EXPECT_EQ(bench.get(kVerdict), 1);
  EXPECT_EQ(bench.get(kVerdictReason), 0);
  EXPECT_EQ(bench.get(kVerdictId), 4711);
  EXPECT_EQ(bench.get(kVerdictClaimedRow), 12);
  EXPECT_EQ(bench.get(kVerdictClaimedColumn), -7);
  EXPECT_EQ(bench.get(kVerdictTubeRow), 12);
  EXPECT_EQ(bench.get(kVerdictTubeColumn), -7);
  EXPECT_EQ(bench.get(kVerdictField), 3601);
  EXPECT_EQ(bench.get(kVerdictAge), 40);
  EXPECT_EQ(bench.get(kVerdictSequence), 1);
  EXPECT_EQ(bench.get(kVerdictBoot), 77);
}

TEST(DialogueClaim, DisagreesAndCannotSay) {
  LinkBench bench;
  ASSERT_EQ(claim(bench, 1, {12, -7}), Refusal::kNone);
  bench.reply(
      bench.take_event().id,
      core::ClaimReply{
          {12, -7}, core::ClaimVerdict::kContradicted, core::ClaimDoubt::kNone, {12, -6}, 3601});
  EXPECT_EQ(bench.get(kVerdict), 2);
  EXPECT_EQ(bench.get(kVerdictTubeColumn), -6);

  ASSERT_EQ(claim(bench, 2, {12, -7}), Refusal::kNone);
  bench.reply(bench.take_event().id,
              core::ClaimReply{
                  {12, -7}, core::ClaimVerdict::kUnknown, core::ClaimDoubt::kNotAligned, {}, 3602});
  EXPECT_EQ(bench.get(kVerdict), 3);
  EXPECT_EQ(bench.get(kVerdictReason), static_cast<int>(core::ClaimDoubt::kNotAligned));
  EXPECT_EQ(bench.get(kVerdictValid), 1);
  EXPECT_EQ(bench.get(kVerdictTubeRow), kUnknown);
}

TEST(DialogueClaim, ALateAnswerToTheClaimBeforeIsNotTaken) {
  LinkBench bench;
  ASSERT_EQ(claim(bench, 7, {12, -7}), Refusal::kNone);
  const core::Event first = bench.take_event();
  ASSERT_EQ(claim(bench, 7, {12, -7}), Refusal::kNone) << "the same id and tube again";
  const core::Event second = bench.take_event();
  ASSERT_NE(first.id, second.id);

  bench.reply(first.id, agree({12, -7}));
  EXPECT_EQ(bench.get(kVerdict), 0);
  bench.reply(second.id, agree({12, -7}));
  EXPECT_EQ(bench.get(kVerdict), 1);
  EXPECT_EQ(bench.get(kVerdictSequence), 2);
}

TEST(DialogueClaim, AnOldVerdictIsGoneOnceTheNextClaimIsTaken) {
  LinkBench bench;
  ASSERT_EQ(claim(bench, 7, {12, -7}), Refusal::kNone);
  bench.reply(bench.take_event().id, agree({12, -7}));
  ASSERT_EQ(bench.get(kVerdict), 1);

  ASSERT_EQ(claim(bench, 8, {12, -7}), Refusal::kNone);

  EXPECT_EQ(bench.get(kVerdict), 0);
  EXPECT_EQ(bench.get(kVerdictId), kUnknown);
}

TEST(DialogueClaim, AVerdictIsReadForASecondOrUntilAcknowledged) {
  LinkBench bench;
  ASSERT_EQ(claim(bench, 7, {12, -7}), Refusal::kNone);
  bench.reply(bench.take_event().id, agree({12, -7}));
  bench.now += 1s;
  EXPECT_EQ(bench.get(kVerdict), 1);
  bench.now += 1ns;
  EXPECT_EQ(bench.get(kVerdict), 0);
  EXPECT_EQ(bench.get(kVerdictValid), 0);

  ASSERT_EQ(claim(bench, 8, {12, -7}), Refusal::kNone);
  bench.reply(bench.take_event().id, agree({12, -7}));
  ASSERT_EQ(bench.set(kCommand, bit_of(CommandBit::kAcknowledge)), Refusal::kNone);
  EXPECT_EQ(bench.get(kVerdict), 0);
  EXPECT_EQ(bench.get(kAcknowledge), bit_of(CommandBit::kAcknowledge));
}

TEST(DialogueClaim, CannotSayWhenTheBoxDoesNotAnswer) {
  LinkBench bench;
  ASSERT_EQ(claim(bench, 7, {12, -7}), Refusal::kNone);
  const core::Event event = bench.take_event();

  bench.now += 55ms;

  EXPECT_EQ(bench.get(kVerdict), 3);
  EXPECT_EQ(bench.get(kVerdictReason), 100);
  EXPECT_EQ(bench.get(kVerdictId), 7);
  bench.reply(event.id, agree({12, -7}));
  EXPECT_EQ(bench.get(kVerdict), 3) << "what was said stays said";
  EXPECT_EQ(bench.state.counters.late_claims, 1u);
}

TEST(DialogueClaim, AReplyToAnotherClaimIsNoVerdict) {
  LinkBench bench;
  ASSERT_EQ(claim(bench, 7, {12, -7}), Refusal::kNone);

  bench.reply(bench.take_event().id, agree({12, -8}));

  EXPECT_EQ(bench.get(kVerdict), 3);
  EXPECT_EQ(bench.get(kVerdictReason), 100);
}

TEST(DialogueClaim, RefusesWhatItCannotTake) {
  LinkBench bench;
  EXPECT_EQ(claim(bench, 1, {1, 1}, 10'001), Refusal::kIllegalValue);
  EXPECT_EQ(bench.set(kClaimCommit, 2), Refusal::kIllegalValue);
  for (std::int32_t i = 0; i < OutboxShare::kMostClaims; ++i) {
    ASSERT_EQ(claim(bench, 1, {1, 1}), Refusal::kNone);
  }
  EXPECT_EQ(claim(bench, 2, {1, 1}), Refusal::kBusy);
  EXPECT_EQ(bench.state.counters.dropped_events, 1u);
  EXPECT_EQ(bench.get(kClaimId), 1) << "nothing of it was written";
}

TEST(Dialogue, AnotherMasterStartsWithNothing) {
  LinkBench bench;
  ASSERT_EQ(claim(bench, 7, {12, -7}), Refusal::kNone);
  const core::Event event = bench.take_event();

  bench.dialogue.reset();
  bench.reply(event.id, agree({12, -7}));

  EXPECT_EQ(bench.get(kVerdict), 0);
  EXPECT_EQ(bench.get(kVerdictSequence), 0);
  EXPECT_EQ(bench.get(kClaimId), 0);
}

}  // namespace
}  // namespace tubesight::drivers
