#include "drivers/simulated/spoilt_picture.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

constexpr std::int32_t kWidth = 400;
constexpr std::int32_t kHeight = 300;

// A grey frame, of which every other line is the field at hand.
struct Frame {
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(kWidth * kHeight, 100);

  FieldPixels odd() { return {pixels.data() + kWidth, kWidth, kHeight / 2, 2 * kWidth}; }
  [[nodiscard]] std::uint8_t at(int u, int v) const {
    return pixels[static_cast<std::size_t>(v * kWidth + u)];
  }
  // Share of the pixels of a parity's lines of which `is` is true.
  template <typename Is>
  [[nodiscard]] double share(int parity, Is is) const {
    int count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      count += (static_cast<int>(i) / kWidth) % 2 == parity && is(pixels[i]) ? 1 : 0;
    }
    return count / (kWidth * kHeight / 2.0);
  }
};

bool other(std::uint8_t grey) { return grey != 100; }

TEST(SpoiltPicture, HasBlotsOverTheShareOfItsFieldAlone) {
  Frame frame;
  Dice dice(5);
  blot(frame.odd(), 0.1, dice);
  EXPECT_EQ(frame.share(0, other), 0.0);
  EXPECT_NEAR(frame.share(1, other), 0.08, 0.03);
  EXPECT_EQ(*std::min_element(frame.pixels.begin(), frame.pixels.end()), 12);
}

TEST(SpoiltPicture, HasReflectionsThatFadeOutwards) {
  Frame frame;
  Dice dice(5);
  reflect(frame.odd(), 0.1, dice);
  EXPECT_EQ(frame.share(0, other), 0.0);
  EXPECT_NEAR(frame.share(1, other), 0.08, 0.03);
  const double white = frame.share(1, [](std::uint8_t grey) { return grey == 255; });
  EXPECT_GT(white, 0.02);
  EXPECT_LT(white, 0.8 * frame.share(1, other));
}

TEST(SpoiltPicture, ShowsAGhostATwentiethToTheRight) {
  Frame frame;
  for (int v = 0; v < kHeight; ++v) {
    frame.pixels[static_cast<std::size_t>(v * kWidth + 50)] = 200;
  }
  add_ghost(frame.odd(), 0.25);
  EXPECT_EQ(frame.at(50, 1), 175);
  EXPECT_EQ(frame.at(70, 1), 125);
  EXPECT_EQ(frame.at(60, 1), 100);
  EXPECT_EQ(frame.at(50, 2), 200);
}

TEST(SpoiltPicture, HasItsBlackRaisedAndItsContrastHalved) {
  Frame frame;
  frame.pixels[kWidth] = 0;
  frame.pixels[kWidth + 1] = 255;
  raise_black(frame.odd(), 64.0, 0.5);
  EXPECT_EQ(frame.at(0, 1), 64);
  EXPECT_NEAR(frame.at(1, 1), 160, 1);
  EXPECT_EQ(frame.at(2, 1), 101);
  EXPECT_EQ(frame.at(2, 2), 100);
}

TEST(SpoiltPicture, IsCoveredFromBelow) {
  Frame frame;
  cover(frame.odd(), 0.25, 170.0, false);
  EXPECT_NEAR(frame.share(1, [](std::uint8_t grey) { return grey == 170; }), 0.25, 0.01);
  EXPECT_EQ(frame.at(7, 299), 170);
  EXPECT_EQ(frame.at(7, 1), 100);
  EXPECT_EQ(frame.at(7, 298), 100);
}

TEST(SpoiltPicture, IsCoveredFromTheLeft) {
  Frame frame;
  cover(frame.odd(), 0.25, 170.0, true);
  EXPECT_NEAR(frame.share(1, [](std::uint8_t grey) { return grey == 170; }), 0.25, 0.01);
  EXPECT_EQ(frame.at(99, 1), 170);
  EXPECT_EQ(frame.at(100, 299), 100);
  EXPECT_EQ(frame.at(99, 2), 100);
}

TEST(SpoiltPicture, IsAsTheFaultsSay) {
  Fault ghost;
  ghost.kind = FaultKind::kGhost;
  ghost.share = 0.2;
  ghost.for_s = 1.0;
  Fault raised = ghost;
  raised.kind = FaultKind::kBlackLevel;
  raised.level = 50.0;
  raised.share = 1.0;
  Fault covered = raised;
  covered.kind = FaultKind::kCovered;
  covered.told = false;
  const std::vector<Fault> list{ghost, raised, covered};
  FieldSlot slot;
  slot.time_s = slot.frame_time_s = 0.5;
  slot.period_s = 0.1;
  Frame frame;
  spoil(frame.odd(), faults_of(list, slot), 3);
  // Covered by 50, the black raised behind it: 50 + (1 - 50 / 255) 50.
  EXPECT_EQ(frame.at(200, 1), 90);
  Frame clean;
  spoil(clean.odd(), {}, 3);
  EXPECT_EQ(clean.share(1, other), 0.0);
}

}  // namespace
}  // namespace tubesight::drivers
