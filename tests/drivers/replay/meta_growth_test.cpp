#include "drivers/replay/meta_growth.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

using core::FieldStatus;
using Numbers = std::vector<std::int64_t>;

constexpr std::int64_t kStep_ns = 20'000'000;

/// Rows of an interlaced recording, one step apart.
std::vector<FieldMeta> rows_of(const Numbers& sequences) {
  std::vector<FieldMeta> rows;
  for (const std::int64_t sequence : sequences) {
    FieldMeta row;
    row.field = static_cast<std::int64_t>(rows.size());
    row.sequence = sequence;
    row.time = core::FieldTime(kStep_ns * row.field);
    row.line = row.field + 2;
    rows.push_back(row);
  }
  return rows;
}

/// Puts the rows from `first` on so many steps later.
void delay(std::vector<FieldMeta>& rows, std::size_t first, double steps) {
  for (std::size_t i = first; i < rows.size(); ++i) {
    rows[i].time += core::FieldTime(static_cast<std::int64_t>(steps * kStep_ns));
  }
}

Messages problems(std::vector<FieldMeta> rows) {
  Messages messages;
  check_growth(rows, "m", messages);
  return messages;
}

Numbers unwrapped(std::vector<FieldMeta> rows) {
  Messages messages;
  check_growth(rows, "m", messages);
  EXPECT_EQ(messages, Messages{});
  Numbers numbers;
  for (const FieldMeta& row : rows) {
    numbers.push_back(row.sequence);
  }
  return numbers;
}

TEST(CheckGrowth, LetsGapsOfNumberAndTimeBe) {
  auto rows = rows_of({-3, -2, 7, 8, 1'000'000, 1'000'001});
  delay(rows, 3, 50.0);

  EXPECT_EQ(unwrapped(rows), (Numbers{-3, -2, 7, 8, 1'000'000, 1'000'001}));
  EXPECT_EQ(problems({}), Messages{});
  EXPECT_EQ(problems(rows_of({5})), Messages{});
}

TEST(CheckGrowth, WantsTimeToGrow) {
  auto back = rows_of({0, 1, 2, 3});
  back[2].time = core::FieldTime(19'000'000);
  EXPECT_EQ(problems(back), Messages{"m:4: time_s: 0.019000000, expected more than in the row "
                                     "before (0.020000000)"});

  auto nonsense_first = rows_of({0, 1, 2});
  nonsense_first[0].time = core::FieldTime(3'154'505'010'207'436'000);
  EXPECT_EQ(problems(nonsense_first), Messages{"m:3: time_s: 0.020000000, expected more than in "
                                               "the row before (3154505010.207436000)"});

  auto same = rows_of({0, 1, 2, 3});
  same[2].time = same[1].time;
  EXPECT_EQ(problems(same),
            Messages{"m:4: time_s: 0.020000000, expected more than in the row before"});

  auto damaged = rows_of({0, 1, 2, 3});
  damaged[1].status = FieldStatus::kDamaged;
  damaged[1].time = core::FieldTime(-1);
  EXPECT_EQ(problems(damaged).size(), 1U);
}

TEST(CheckGrowth, TellsOneStampForBothFieldsOnce) {
  auto times = rows_of({0, 1, 2, 3, 4, 5});
  for (const std::size_t later : {1U, 3U, 5U}) {
    times[later].time = times[later - 1].time;
  }
  EXPECT_EQ(problems(times), Messages{"m:3: time_s: 0.000000000 for both fields of a frame, "
                                      "expected each field's own mid-exposure"});
  EXPECT_EQ(problems(rows_of({7, 7, 8, 8, 9, 9})),
            Messages{"m:3: sequence: 7 for both fields of a frame, expected 1 more for the later"});
}

TEST(CheckGrowth, TellsWhatNeverGrowsOnce) {
  EXPECT_EQ(problems(rows_of(Numbers(60, 0))),
            Messages{"m:3: sequence: 0 in all 60 rows, expected 1 more in each (the driver does "
                     "not count)"});
  auto still = rows_of({0, 1, 2, 3});
  for (FieldMeta& row : still) {
    row.time = core::FieldTime(5);
  }
  EXPECT_EQ(problems(still),
            Messages{"m:3: time_s: 0.000000005 in all 4 rows, expected more in each"});
}

TEST(CheckGrowth, TellsASequenceThatStandsStillOrGoesBack) {
  const std::string hint = "), or 0 or 1 where a counter of 8, 16 or 32 bits wraps";
  EXPECT_EQ(
      problems(rows_of({0, 1, 2, 2, 3, 3})),
      (Messages{"m:5: sequence: 2 for both fields of a frame, expected 1 more for the later"}));
  EXPECT_EQ(problems(rows_of({0, 1, 1, 2})),
            Messages{"m:4: sequence: 1, expected more than in the row before"});
  EXPECT_EQ(problems(rows_of({5000, 5001, 0, 1})),
            Messages{"m:4: sequence: 0, expected more than in the row before (5001" + hint});
  // A counter of four decimal digits, a signed one, and one begun anew near the end of its bits.
  EXPECT_EQ(problems(rows_of({9998, 9999, 0})).size(), 1U);
  EXPECT_EQ(problems(rows_of({2147483646, 2147483647, -2147483648})).size(), 1U);
  EXPECT_EQ(problems(rows_of({65520, 65521, 0, 1})).size(), 1U);
  EXPECT_EQ(problems(rows_of({250, 251, 252, 3, 4})).size(), 1U);
}

TEST(CheckGrowth, UnwrapsCountersOf8And16And32Bits) {
  for (const std::int64_t values :
       {std::int64_t{1} << 8, std::int64_t{1} << 16, std::int64_t{1} << 32}) {
    EXPECT_EQ(unwrapped(rows_of({values - 3, values - 2, values - 1, 0, 1, 2})),
              (Numbers{values - 3, values - 2, values - 1, values, values + 1, values + 2}));
    // From the last number to the first tells by itself, without a step of time to go by.
    EXPECT_EQ(unwrapped(rows_of({values - 1, 0})), (Numbers{values - 1, values}));
  }
  // Again and again.
  Numbers eight_bits;
  Numbers expected;
  for (int i = 0; i < 1000; ++i) {
    eight_bits.push_back(i % 256);
    expected.push_back(i);
  }
  EXPECT_EQ(unwrapped(rows_of(eight_bits)), expected);
}

TEST(CheckGrowth, UnwrapsACounterThatPassesOverZero) {
  EXPECT_EQ(unwrapped(rows_of({65533, 65534, 65535, 1, 2})),
            (Numbers{65533, 65534, 65535, 65536, 65537}));
  // One field lost over the wrap: 65535 or 1 is missing.
  auto lost = rows_of({65533, 65534, 1, 2});
  delay(lost, 2, 1.0);
  EXPECT_EQ(unwrapped(lost), (Numbers{65533, 65534, 65536, 65537}));
}

TEST(CheckGrowth, CountsTheFieldsLostOverAWrapByTheTimes) {
  auto rows = rows_of({252, 253, 254, 3, 4});
  delay(rows, 3, 4.1);
  EXPECT_EQ(unwrapped(rows), (Numbers{252, 253, 254, 259, 260}));
  // 0 itself is what was lost.
  auto zero = rows_of({253, 254, 255, 1, 2});
  delay(zero, 3, 1.0);
  EXPECT_EQ(unwrapped(zero), (Numbers{253, 254, 255, 257, 258}));
  // The times say that something else went on.
  auto other = rows_of({252, 253, 254, 3, 4});
  delay(other, 3, 20.0);
  EXPECT_EQ(problems(other).size(), 1U);
}

TEST(CheckGrowth, GivesMissingFieldsTheNumberBefore) {
  auto rows = rows_of({65534, 0, 65535, 0, 0, 1});
  for (const std::size_t missing : {1U, 4U}) {
    rows[missing].status = FieldStatus::kMissing;
  }
  EXPECT_EQ(unwrapped(rows), (Numbers{65534, 65534, 65535, 65536, 65536, 65537}));

  rows[4].time = rows[3].time;
  EXPECT_EQ(problems(rows), Messages{"m:6: time_s: 0.060000000, expected more than in the row "
                                     "before"});
}

TEST(CheckGrowth, StopsAfterTwentyMessages) {
  Numbers back;
  for (int i = 0; i < 100; ++i) {
    back.push_back(-i);
  }
  EXPECT_EQ(problems(rows_of(back)).size(), 20U);
}

}  // namespace
}  // namespace tubesight::drivers
