#include "core/verification/claim_judge.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/support/events.h"

namespace tubesight::core::verification {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using tests::content_of;

constexpr TubeAddress kTube{20, 10};
constexpr TubeAddress kNext{20, 11};

/// Fields every 20 ms in which the box vouches for kTube, at rest 1 mm off, unless told otherwise.
class ClaimJudgeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    judge_->configure(make_claim_limits({}, {}, 25.4));
    for (int i = 0; i < 4; ++i) {
      see();
    }
  }

  static Sighting aligned() {
    Sighting sighting;
    sighting.status = FieldStatus::kGood;
    sighting.state = TrackState::kTracking;
    sighting.judged = true;
    sighting.tool_known = true;
    sighting.tool = kTube;
    sighting.offset_um_q8 = 1000 * 256;
    sighting.aligned = true;
    sighting.velocity_known = true;
    return sighting;
  }

  /// The next field; answers what waits.
  void see(Sighting sighting = aligned()) {
    now_ += milliseconds(20);
    sighting.time = now_;
    sighting.field = number_++;
    recent_->push({sighting, {}});
    replies_.clear();
    judge_->answer_waiting(*recent_, replies_);
  }

  /// A claim made so long before the last field.
  void claim(FieldTime before, TubeAddress tube = kTube, std::int64_t id = 1) {
    Event event = tests::event_of(Claim{tube});
    event.id = id;
    event.at = now_ - before;
    judge_->take(event, Claim{tube}, *recent_, replies_);
  }

  [[nodiscard]] ClaimReply only() const {
    EXPECT_EQ(replies_.size(), 1);
    return replies_.empty() ? ClaimReply{} : content_of<ClaimReply>(replies_[0]);
  }

  std::unique_ptr<ClaimJudge<FixedPoint>> judge_ = std::make_unique<ClaimJudge<FixedPoint>>();
  std::unique_ptr<RecentFields<FixedPoint>> recent_ = std::make_unique<RecentFields<FixedPoint>>();
  ReplyList replies_;
  FieldTime now_{0};
  std::int64_t number_ = 0;
};

TEST_F(ClaimJudgeTest, JudgesByTheFieldNearestToTheClaim) {
  Sighting next = aligned();
  next.tool = kNext;
  see(next);  // field 4; before it kTube was seen

  claim(milliseconds(11), kTube, 5);
  EXPECT_EQ(only().verdict, ClaimVerdict::kConfirmed);
  EXPECT_EQ(only().field, 3);
  EXPECT_EQ(replies_[0].id, 5);
  EXPECT_EQ(replies_[0].at, now_);
  replies_.clear();
  claim(milliseconds(9), kTube, 6);
  EXPECT_EQ(only().verdict, ClaimVerdict::kContradicted);
  EXPECT_EQ(only().claimed, kTube);
  EXPECT_EQ(only().tube, kNext);
  EXPECT_EQ(only().field, 4);
}

// A start at the field of 100 ms: what the claim speaks of was nearer to the one before it.
TEST_F(ClaimJudgeTest, DoesNotJudgeATimeBeforeAStartByTheFieldBehindIt) {
  recent_->clear();
  see();
  claim(milliseconds(9));
  EXPECT_EQ(only().verdict, ClaimVerdict::kConfirmed);
  for (const int before_ms : {10, 11, 19, 21, 45}) {
    replies_.clear();
    claim(milliseconds(before_ms));
    EXPECT_EQ(only().verdict, ClaimVerdict::kUnknown) << before_ms;
    EXPECT_EQ(only().doubt, ClaimDoubt::kNotKnown) << before_ms;
  }
  see();
  claim(milliseconds(19));
  EXPECT_EQ(only().verdict, ClaimVerdict::kConfirmed) << "by the start's own field";
}

TEST_F(ClaimJudgeTest, WaitsForTheNextFieldWhereItMayBeNearer) {
  claim(-milliseconds(3), kTube, 9);
  EXPECT_TRUE(replies_.empty());
  see();
  EXPECT_EQ(only().verdict, ClaimVerdict::kConfirmed);
  EXPECT_EQ(only().field, 3) << "3 ms from the one before, 17 ms from this";
  EXPECT_EQ(replies_[0].id, 9);
  see();
  EXPECT_TRUE(replies_.empty()) << "answered once";
}

TEST_F(ClaimJudgeTest, TakesAnInstantWithinAMicrosecondForTheFieldsOwn) {
  claim(-microseconds(1));
  EXPECT_EQ(only().verdict, ClaimVerdict::kConfirmed);
}

TEST_F(ClaimJudgeTest, CannotSayWithoutAFieldWithin50ms) {
  now_ += milliseconds(120);  // fields that never came
  see();
  claim(milliseconds(70));
  EXPECT_EQ(only().verdict, ClaimVerdict::kUnknown);
  EXPECT_EQ(only().doubt, ClaimDoubt::kNoSighting);
}

TEST_F(ClaimJudgeTest, CannotSayToWhatIsOver250msOldOrAhead) {
  for (int i = 0; i < 20; ++i) {
    see();
  }
  claim(milliseconds(250));
  EXPECT_EQ(only().verdict, ClaimVerdict::kConfirmed);
  replies_.clear();
  claim(milliseconds(251));
  EXPECT_EQ(only().doubt, ClaimDoubt::kTooOld);
  replies_.clear();
  claim(-milliseconds(251));
  EXPECT_EQ(only().doubt, ClaimDoubt::kNotYet);
}

TEST_F(ClaimJudgeTest, CannotSayToAWaitingClaimThatGrewOld) {
  claim(-milliseconds(3));
  now_ += milliseconds(400);
  see();
  EXPECT_EQ(only().doubt, ClaimDoubt::kTooOld);
}

TEST_F(ClaimJudgeTest, CannotSayByAFieldWithoutAPicture) {
  for (const FieldStatus status : {FieldStatus::kDamaged, FieldStatus::kMissing}) {
    Sighting none = aligned();
    none.status = status;
    none.judged = false;
    none.aligned = false;
    none.state = TrackState::kDegraded;
    see(none);
    claim(FieldTime(0));
    EXPECT_EQ(only().doubt, ClaimDoubt::kNoPicture);
  }
}

TEST_F(ClaimJudgeTest, SaysWhyThereIsNoTubeToCompareWith) {
  Sighting lost;
  lost.status = FieldStatus::kGood;
  lost.state = TrackState::kLost;
  see(lost);
  claim(FieldTime(0));
  EXPECT_EQ(only().doubt, ClaimDoubt::kNotKnown);

  Sighting between = aligned();
  between.aligned = false;
  see(between);
  claim(FieldTime(0));
  EXPECT_EQ(only().doubt, ClaimDoubt::kNotAligned);

  Sighting dark = aligned();
  dark.judged = false;
  dark.aligned = false;
  dark.state = TrackState::kDegraded;
  see(dark);
  claim(FieldTime(0));
  EXPECT_EQ(only().doubt, ClaimDoubt::kNoPicture) << "it coasts: nothing of this picture was used";
}

// 2.5 mm off and 300 mm/s: after 24 ms it is 9.7 mm off by the speed, and 3000 mm/s2 may add 0.9
// mm: more than 0.4 of 25.4 mm.
TEST_F(ClaimJudgeTest, CannotSayWhereTheToolMayHaveGoneToAnotherTubeSince) {
  Sighting fast = aligned();
  fast.offset_um_q8 = 2500 * 256;
  fast.velocity_um_s = {0, -300'000};
  see(fast);
  claim(-milliseconds(24));  // waits
  now_ += milliseconds(30);
  Sighting none = fast;
  none.status = FieldStatus::kDamaged;
  none.judged = false;
  none.aligned = false;
  see(none);
  ASSERT_EQ(replies_.size(), 1);
  EXPECT_EQ(only().doubt, ClaimDoubt::kMoving);
  EXPECT_EQ(only().verdict, ClaimVerdict::kUnknown);
}

TEST_F(ClaimJudgeTest, TrustsASlowToolOverTheSameSpan) {
  Sighting slow = aligned();
  slow.velocity_um_s = {20'000, 20'000};
  see(slow);
  claim(-milliseconds(20));
  now_ += milliseconds(25);
  see(slow);
  EXPECT_EQ(only().verdict, ClaimVerdict::kConfirmed);
}

// Without a velocity the tool may have gone at the greatest speed: 300 mm/s over 40 ms are 12 mm.
TEST_F(ClaimJudgeTest, TakesAnUnknownSpeedForTheGreatest) {
  Sighting fresh = aligned();
  fresh.velocity_known = false;
  see(fresh);
  now_ += milliseconds(60);
  Sighting lost;
  lost.status = FieldStatus::kGood;
  lost.state = TrackState::kLost;
  see(lost);
  claim(milliseconds(45));
  EXPECT_EQ(only().doubt, ClaimDoubt::kMoving);
}

TEST_F(ClaimJudgeTest, WaitsNoLongerThanForSoManyFields) {
  claim(-milliseconds(5));
  const FieldTime stuck = now_;
  int waited = 0;
  while (replies_.empty() && waited < 200) {
    now_ = stuck - milliseconds(20);  // a camera that stamps all its fields alike
    see();
    ++waited;
  }
  EXPECT_EQ(only().verdict, ClaimVerdict::kUnknown);
  EXPECT_LT(waited, 100);
}

// A velocity that is the mean over a tenth of a second is old: 3000 mm/s2 may have added 12 mm by
// 45 ms behind it.
TEST_F(ClaimJudgeTest, TakesTheAgeOfTheVelocityIntoAccount) {
  Sighting old = aligned();
  old.velocity_span_us = 150'000;
  see(old);
  now_ += milliseconds(80);
  see(old);
  claim(milliseconds(45));
  EXPECT_EQ(only().doubt, ClaimDoubt::kMoving);
}

TEST_F(ClaimJudgeTest, SaysSoWhenTooManyWait) {
  for (int i = 0; i < kMaxWaitingClaims; ++i) {
    claim(-milliseconds(5), kTube, i);
  }
  EXPECT_TRUE(replies_.empty());
  claim(-milliseconds(5), kTube, 99);
  EXPECT_EQ(only().doubt, ClaimDoubt::kBusy);
  EXPECT_EQ(replies_[0].id, 99);
  see();
  ASSERT_EQ(replies_.size(), kMaxWaitingClaims);
  for (int i = 0; i < kMaxWaitingClaims; ++i) {
    EXPECT_EQ(replies_[i].id, i) << "in their order";
  }
}

TEST(ClaimLimits, AreTheSettings) {
  VerificationSettings verification;
  verification.claim_within_s = 0.02;
  const ClaimLimits limits = make_claim_limits(verification, {150.0, 2000.0}, 22.225);

  EXPECT_EQ(limits.within, milliseconds(20));
  EXPECT_EQ(limits.oldest, milliseconds(250));
  EXPECT_EQ(limits.step_um, 22'225);
  EXPECT_EQ(limits.max_um_s, 150'000);
  EXPECT_EQ(limits.max_um_s2, 2'000'000);
}

}  // namespace
}  // namespace tubesight::core::verification
