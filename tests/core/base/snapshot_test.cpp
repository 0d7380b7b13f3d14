#include "core/base/snapshot.h"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

struct Odd {
  std::array<std::uint8_t, 7> bytes{};  // no whole number of words
};

TEST(Snapshot, HoldsNothingUntilTheFirstPublication) {
  const Snapshot<int> snapshot;
  int value = 5;

  EXPECT_FALSE(snapshot.try_read(value));
  EXPECT_EQ(snapshot.version(), 0U);
}

TEST(Snapshot, GivesTheLatestValueAsOftenAsAsked) {
  Snapshot<std::int64_t> snapshot;
  std::int64_t value = 0;

  snapshot.publish(0x0123456789abcdef);
  snapshot.publish(-2);

  EXPECT_TRUE(snapshot.try_read(value));
  EXPECT_EQ(value, -2);
  value = 0;
  EXPECT_TRUE(snapshot.try_read(value));
  EXPECT_EQ(value, -2);
}

TEST(Snapshot, CountsPublications) {
  Snapshot<char> snapshot;

  snapshot.publish('a');
  EXPECT_EQ(snapshot.version(), 1U);
  snapshot.publish('a');
  EXPECT_EQ(snapshot.version(), 2U);
}

TEST(Snapshot, CopiesEveryByteAndNoFurther) {
  Snapshot<Odd> snapshot;
  struct {
    Odd value;
    std::uint8_t behind = 99;
  } got;

  snapshot.publish({{1, 2, 3, 4, 5, 6, 7}});

  ASSERT_TRUE(snapshot.try_read(got.value));
  EXPECT_EQ(got.value.bytes, (std::array<std::uint8_t, 7>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(got.behind, 99);
}

}  // namespace
}  // namespace tubesight::core
