#include "board/visionbox/life_signs.h"

#include <chrono>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using std::chrono::milliseconds;

constexpr MonotonicTime kBegin = std::chrono::hours(1);

TEST(LifeSigns, AreThereWhileEachPartComesRound) {
  LifeSigns signs;
  for (int i = 0; i < 100; ++i) {
    signs.look({i, i, i / 2, i}, kBegin + i * milliseconds(200));
    EXPECT_TRUE(signs.alive()) << i << ": " << signs.stuck();
  }
}

TEST(LifeSigns, NameEachPartThatStandsStill) {
  constexpr const char* kNames[] = {"the tracking", "the robot's link", "the lamp",
                                    "the control desk"};
  for (std::size_t stuck = 0; stuck < kParts; ++stuck) {
    LifeSigns signs;
    for (std::int64_t i = 0; i <= 16; ++i) {
      Beats beats{i, i, i, i};
      beats[stuck] = 7;
      signs.look(beats, kBegin + i * milliseconds(200));
      EXPECT_EQ(signs.alive(), i <= 15) << i << ": 3 s are allowed";
    }
    EXPECT_EQ(signs.stuck(), kNames[stuck]);
  }
}

TEST(LifeSigns, NameAllOfThemAndForgiveThoseThatComeBack) {
  LifeSigns signs;
  signs.look({1, 1, 1, 1}, kBegin);
  signs.look({1, 1, 2, 2}, kBegin + milliseconds(3001));
  EXPECT_EQ(signs.stuck(), "the tracking, the robot's link");

  signs.look({2, 2, 3, 3}, kBegin + milliseconds(3200));

  EXPECT_TRUE(signs.alive());
}

TEST(LifeSigns, MissNothingThatIsNotThere) {
  LifeSigns signs;
  for (int i = 0; i < 100; ++i) {
    signs.look({i, -1, -1, i}, kBegin + i * milliseconds(200));
    EXPECT_TRUE(signs.alive()) << i;
  }
  signs.look({100, 5, -1, 100}, kBegin + milliseconds(20'000));
  EXPECT_TRUE(signs.alive()) << "a line that could be opened at last has its time, too";
}

}  // namespace
}  // namespace tubesight::board
