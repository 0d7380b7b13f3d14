#include "drivers/v4l2/sequence_counter.h"

#include <vector>

#include <gtest/gtest.h>

namespace tubesight::drivers::v4l2 {
namespace {

using Sequences = std::vector<std::int64_t>;

struct Told {
  std::uint32_t number;
  bool odd = false;
};

Sequences count(SequenceCounter& counter, const std::vector<Told>& told) {
  Sequences given;
  for (const Told& buffer : told) {
    given.push_back(counter.next(buffer.number, buffer.odd).sequence);
  }
  return given;
}

TEST(SequenceCounter, AGapOfFramesIsAGapOfFields) {
  SequenceCounter frames(BufferKind::kFrame);
  SequenceCounter pairs(BufferKind::kPair);

  EXPECT_EQ(count(frames, {{7}, {8}, {11}, {12}}), (Sequences{0, 1, 4, 5}));
  EXPECT_EQ(count(pairs, {{7}, {8}, {11}, {12}}), (Sequences{0, 2, 8, 10}));
  EXPECT_EQ(pairs.next(15, false).lost, 4);
  EXPECT_EQ(pairs.next(16, false).lost, 0);
}

TEST(SequenceCounter, GoesOnWhereTheDriversCounterWraps) {
  SequenceCounter counter(BufferKind::kFrame);

  EXPECT_EQ(count(counter, {{0xfffffffe}, {0xffffffff}, {0}, {2}}), (Sequences{0, 1, 2, 4}));
}

TEST(SequenceCounter, CountsItselfWhereTheDriverDoesNot) {
  SequenceCounter pairs(BufferKind::kPair);
  SequenceCounter fields(BufferKind::kOneField);

  EXPECT_EQ(count(pairs, {{0}, {0}, {0}}), (Sequences{0, 2, 4}));
  EXPECT_EQ(count(fields, {{0}, {0, true}, {0}, {0, true}, {0}}), (Sequences{0, 1, 2, 3, 4}));
  EXPECT_FALSE(pairs.counts());
  EXPECT_FALSE(fields.counts());
}

TEST(SequenceCounter, FieldsOfOneFrameMayShareTheirNumber) {
  SequenceCounter counter(BufferKind::kOneField);

  EXPECT_EQ(count(counter, {{5}, {5, true}, {6}, {6, true}, {7}}), (Sequences{0, 1, 2, 3, 4}));
  EXPECT_TRUE(counter.counts());
  EXPECT_EQ(counter.next(8, false).lost, 1) << "the odd one of 7";
  EXPECT_EQ(counter.next(9, true).lost, 2) << "the odd one of 8, and the even one of 9";
}

TEST(SequenceCounter, FieldsMayHaveANumberEach) {
  SequenceCounter counter(BufferKind::kOneField);

  EXPECT_EQ(count(counter, {{5}, {6, true}, {7}, {10, true}}), (Sequences{0, 1, 2, 5}));
}

TEST(SequenceCounter, FindsOutThatNumbersAreSharedFromTheMiddleOfAFrameToo) {
  SequenceCounter counter(BufferKind::kOneField);

  EXPECT_EQ(count(counter, {{5, true}, {6}, {6, true}, {7}, {7, true}}),
            (Sequences{0, 1, 2, 3, 4}));
}

TEST(SequenceCounter, WhichFieldIsFirstIsTheDriversBusiness) {
  SequenceCounter counter(BufferKind::kOneField);

  EXPECT_EQ(count(counter, {{5, true}, {5}, {6, true}, {6}, {7, true}}),
            (Sequences{0, 1, 2, 3, 4}));
}

TEST(SequenceCounter, ACounterThatGoesBackIsANewBeginningThatNoTrackGoesOver) {
  SequenceCounter counter(BufferKind::kFrame);
  count(counter, {{50}, {51}});

  const auto back = counter.next(3, false);

  EXPECT_TRUE(back.went_back);
  EXPECT_EQ(back.sequence, 1 + SequenceCounter::kNewBeginning);
  EXPECT_EQ(counter.next(4, false).sequence, back.sequence + 1);
}

TEST(SequenceCounter, ANumberThatComesTwiceIsToldOfADriverThatCounts) {
  SequenceCounter counter(BufferKind::kFrame);
  count(counter, {{1}, {2}});

  const auto twice = counter.next(2, false);

  EXPECT_TRUE(twice.repeated);
  EXPECT_EQ(twice.sequence, 2);
}

TEST(SequenceCounter, AnotherStreamIsANewBeginning) {
  SequenceCounter counter(BufferKind::kFrame);
  count(counter, {{1}, {2}});
  counter.begin_anew(BufferKind::kPair);

  EXPECT_EQ(count(counter, {{0}, {1}}),
            (Sequences{1 + SequenceCounter::kNewBeginning, 3 + SequenceCounter::kNewBeginning}));
}

}  // namespace
}  // namespace tubesight::drivers::v4l2
