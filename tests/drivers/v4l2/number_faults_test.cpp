// What drivers say wrong of their pictures: counters, stamps, the order of fields. Each test
// injects one fault and shows the state that follows, what was counted, and how it ends.

#include <chrono>

#include <gtest/gtest.h>

#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using core::FieldStatus;
using core::Scan;
using drivers::CameraTrouble;
using std::chrono::seconds;

using Memory = std::span<std::byte>;

class NumbersAndStamps : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(bench_.grabber().start()) << bench_.message(); }
  CameraBench bench_;
};

TEST_F(NumbersAndStamps, ACounterAlwaysZeroIsSeenAndReplaced) {
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.sequence = 0; };
  std::int64_t last = -1;
  for (int i = 0; i < 5; ++i) {
    const auto lease = bench_.grab();
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease->field().status, FieldStatus::kGood);
    EXPECT_EQ(lease->field().sequence, last + 1);
    last = lease->field().sequence;
  }
  EXPECT_FALSE(bench_.report().counts);
}

TEST_F(NumbersAndStamps, LostFieldsAreCounted) {
  ASSERT_TRUE(bench_.good_within(1));
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.sequence += 3; };

  ASSERT_TRUE(bench_.good_within(1));

  EXPECT_EQ(bench_.counters().lost_fields, 3);
}

TEST_F(NumbersAndStamps, FieldsThatNobodyTakesInTimeAreLostAndCounted) {
  ASSERT_TRUE(bench_.good_within(1));
  bench_.kernel().advance(seconds(1));
  for (int i = 0; i < 10; ++i) {
    static_cast<void>(bench_.next_status());
  }

  EXPECT_GT(bench_.counters().lost_fields, 15) << "of 30";
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(NumbersAndStamps, ACounterThatWrapsIsNoGap) {
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    buffer.sequence += 0xffff'fffd;  // of 32 bits
  };
  for (int i = 0; i < 8; ++i) {
    const auto lease = bench_.grab();
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease->field().status, FieldStatus::kGood);
    EXPECT_EQ(lease->field().sequence, i);
  }
  EXPECT_EQ(bench_.counters().lost_fields, 0);
  EXPECT_EQ(bench_.counters().counter_back, 0);
}

TEST_F(NumbersAndStamps, ACounterThatGoesBackIsToldByAGap) {
  ASSERT_TRUE(bench_.good_within(1));
  ASSERT_TRUE(bench_.good_within(1));
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.sequence -= 2; };

  const auto lease = bench_.grab();

  ASSERT_TRUE(lease);
  EXPECT_GT(lease->field().sequence, 100);
  EXPECT_EQ(bench_.counters().counter_back, 1);
}

TEST_F(NumbersAndStamps, APictureTwiceIsDamaged) {
  ASSERT_TRUE(bench_.good_within(1));
  ASSERT_TRUE(bench_.good_within(1));
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.sequence -= 1; };

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.counters().counter_repeated, 1);

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(NumbersAndStamps, StampsOfZeroAreWrongAndThenNotListenedTo) {
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.timestamp = {}; };

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStamps);
  EXPECT_FALSE(bench_.report().stamps);
  EXPECT_TRUE(bench_.good_within(8)) << "by the instant of arrival from then on";
  EXPECT_EQ(bench_.counters().wrong_stamps, 8);
  EXPECT_EQ(bench_.counters().without_stamp, 1);
}

TEST_F(NumbersAndStamps, StampsOfAnotherClockThatTheDriverNamesAreNotListenedTo) {
  bench_.camera().stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    buffer.timestamp.tv_sec += 1'700'000'000;
  };

  EXPECT_TRUE(bench_.good_within(1));
  EXPECT_EQ(bench_.counters().without_stamp, 1);
  EXPECT_FALSE(bench_.report().stamps);
}

TEST_F(NumbersAndStamps, StampsOfAnotherClockThatTheDriverDoesNotNameAreWrongAndThenNotListenedTo) {
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    buffer.timestamp.tv_sec += 1'700'000'000;  // the clock on the wall
  };

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStamps);
  EXPECT_TRUE(bench_.good_within(8)) << "by the instant of arrival from then on";
  EXPECT_EQ(bench_.counters().wrong_stamps, 8);
  EXPECT_FALSE(bench_.report().stamps);

  bench_.camera().tamper = nullptr;
  ASSERT_TRUE(bench_.start_anew());
  EXPECT_TRUE(bench_.good_within(1));
  EXPECT_TRUE(bench_.report().stamps) << "a new stream is listened to";
}

TEST(WithoutStamps, ADriverWhoseClockIsInThePastMayBeLeftUnheard) {
  drivers::V4l2Settings settings = settings_of();
  settings.use_stamps = false;
  CameraBench bench(settings);
  bench.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.timestamp.tv_sec -= 900; };
  ASSERT_TRUE(bench.grabber().start());

  EXPECT_TRUE(bench.good_within(1));
  EXPECT_FALSE(bench.report().stamps);
  EXPECT_EQ(bench.counters().without_stamp, 1);
}

// Of ten seconds in which the program stood still there are six buffers, and nothing says how old.
TEST_F(NumbersAndStamps, WithoutStampsWhatLayThereIsDamaged) {
  bench_.camera().stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  ASSERT_TRUE(bench_.good_within(1));
  bench_.kernel().advance(seconds(10));

  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged) << i;
    EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStamps);
  }
  EXPECT_TRUE(bench_.good_within(1));
}

// One that is there as soon as the stream begins is of the stream before.
TEST_F(NumbersAndStamps, WithoutStampsAFirstPictureThatIsThereAtOnceIsDamaged) {
  bench_.grabber().stop();
  bench_.camera().stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  bench_.camera().every = core::FieldTime{1};  // the fake's way to have one at once
  ASSERT_TRUE(bench_.grabber().start());

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStamps);
}

TEST_F(NumbersAndStamps, WithoutStampsAPictureThatHadToBeWaitedForIsNew) {
  bench_.camera().stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  ASSERT_TRUE(bench_.good_within(1));
  bench_.camera().every = {};
  for (int i = 0; i < 5; ++i) {
    EXPECT_FALSE(bench_.grab());
  }
  bench_.camera().every = core::FieldTime{33'333'333};
  static_cast<void>(bench_.next_status());

  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(NumbersAndStamps, StampsThatRunBackwardsAreWrongAndPass) {
  ASSERT_TRUE(bench_.good_within(1));
  const core::FieldTime before = bench_.grab()->field().mid_exposure;
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.timestamp.tv_sec -= 1; };
  {
    const auto lease = bench_.grab();
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease->field().status, FieldStatus::kDamaged);
    EXPECT_GT(lease->field().mid_exposure, before);
  }
  EXPECT_EQ(bench_.counters().wrong_stamps, 1);

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(NumbersAndStamps, PicturesHeldBackAreDamagedHoweverManyCome) {
  ASSERT_TRUE(bench_.good_within(1));
  bench_.kernel().advance(seconds(5));
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.timestamp.tv_sec -= 3; };

  EXPECT_FALSE(bench_.good_within(200));
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStamps);

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(NumbersAndStamps, AFirstPictureFromBeforeTheStreamIsDamaged) {
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    if (buffer.sequence == 0) {
      buffer.timestamp.tv_sec -= 1;
    }
  };

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.next_status(), FieldStatus::kGood);
}

/// A stream of fields, of another order than the settings say.
class FieldFaults : public testing::Test {
 protected:
  void start(std::uint32_t field) {
    bench_.camera().fields = {field};
    ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  }
  CameraBench bench_{settings_of(Scan::kEvenFirst)};
};

TEST_F(FieldFaults, ADriverThatDoesNotSayWhichFieldItIsIsNotBelieved) {
  start(V4L2_FIELD_ALTERNATE);
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    buffer.field = V4L2_FIELD_NONE;
  };

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kOrder);
  EXPECT_EQ(bench_.counters().odd_order, 1);

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(FieldFaults, AFieldLostOfFieldsByTurnsKeepsTheOthersInTheirPlaces) {
  start(V4L2_FIELD_ALTERNATE);
  bench_.camera().every = core::FieldTime{16'666'667};
  ASSERT_TRUE(bench_.good_within(1));  // even
  ASSERT_TRUE(bench_.good_within(1));  // odd
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    buffer.field = V4L2_FIELD_BOTTOM;
  };

  const auto lease = bench_.grab();

  ASSERT_TRUE(lease);
  EXPECT_EQ(lease->field().parity, core::Parity::kOdd);
  EXPECT_EQ(lease->field().number, 3) << "the later one of its frame";
  EXPECT_EQ(lease->field().sequence, 3);
  EXPECT_EQ(bench_.counters().lost_fields, 1);
}

TEST_F(FieldFaults, HalfAFrameWhereBothFieldsWereAgreedIsDamaged) {
  start(V4L2_FIELD_INTERLACED);
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.field = V4L2_FIELD_TOP; };

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged) << "both fields of it";
  EXPECT_EQ(bench_.counters().odd_order, 1);

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

// The tracking finds the truth by the tool's motion (field_order_test.cpp); here it is counted.
TEST_F(FieldFaults, AnOrderThatContradictsTheSettingsIsCountedAndTheSettingsHold) {
  start(V4L2_FIELD_INTERLACED_BT);

  const auto lease = bench_.grab();

  ASSERT_TRUE(lease);
  EXPECT_EQ(lease->field().parity, core::Parity::kEven);
  EXPECT_EQ(lease->field().status, FieldStatus::kGood);
  EXPECT_EQ(bench_.counters().odd_order, 1);
}

TEST_F(FieldFaults, ASequentialBufferTellsItselfWhichFieldIsAbove) {
  start(V4L2_FIELD_SEQ_TB);
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    buffer.field = V4L2_FIELD_SEQ_BT;
  };

  const auto lease = bench_.grab();

  // The fake camera drew the even lines above before the word was changed.
  ASSERT_TRUE(lease);
  EXPECT_EQ(lease->field().parity, core::Parity::kEven);
  EXPECT_EQ(lease->field().pixels.pixels[0], drawn_grey(0, 1)) << "the lower half";
  EXPECT_EQ(bench_.counters().odd_order, 1);
}

}  // namespace
}  // namespace tubesight::tests
