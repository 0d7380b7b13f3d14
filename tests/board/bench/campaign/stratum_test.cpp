#include "board/bench/campaign/stratum.h"

#include <array>
#include <set>

#include <gtest/gtest.h>

namespace tubesight::board::campaign {
namespace {

TEST(Stratum, HasEveryCombinationOnce) {
  std::set<std::string> names;
  for (std::int32_t index = 0; index < kStrata; ++index) {
    const std::string name = name_of(stratum_at(index));
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(find_stratum(name), index);
  }
  EXPECT_EQ(names.size(), 96U);
  EXPECT_EQ(names.count("triangular/turned/fillet/jump/fast"), 1U);
  EXPECT_EQ(find_stratum("square/upright/flush/none"), -1);
  EXPECT_EQ(find_stratum(""), -1);
}

TEST(Stratum, GetsMoreThanAHundredthOfTheMoves) {
  std::array<int, kStrata> moves{};
  constexpr int kMoves = 960;
  for (std::int64_t move = 1000; move < 1000 + kMoves; ++move) {
    ++moves.at(static_cast<std::size_t>(stratum_of_move(move)));
  }
  for (const int count : moves) {
    EXPECT_EQ(count, 10);
    EXPECT_GE(100 * count, kMoves);
  }
}

}  // namespace
}  // namespace tubesight::board::campaign
