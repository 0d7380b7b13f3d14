// What stands between camera and box: a store that hangs, a compressor, a host that stamps late.

#include "drivers/simulated/video_source.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/simulated/simulated_world.h"
#include "tests/drivers/simulated/small_scenario.h"

namespace tubesight::drivers {
namespace {

constexpr std::int32_t kWidth = 64;
constexpr std::int32_t kLines = 32;

/// A source that fields of one parity go through, each of one grey level but for two of noise.
class VideoSourceOf : public ::testing::Test {
 protected:
  using Picture = std::vector<std::uint8_t>;

  VideoSourceOf() { source_.begin(pixels_.size()); }

  Picture send(int level, const FieldFaults& faults = {}) {
    const FieldPixels field{pixels_.data(), kWidth, kLines, kWidth};
    source_.remember(field, core::Parity::kEven, faults);
    for (std::uint8_t& pixel : pixels_) {
      pixel = static_cast<std::uint8_t>(level + static_cast<int>(dice_.next() % 3U));
    }
    source_.pass(field, core::Parity::kEven, faults, dice_);
    return pixels_;
  }
  static FieldFaults with(FaultKind kind) {
    FieldFaults faults;
    faults.kinds = std::uint32_t{1} << static_cast<unsigned>(kind);
    return faults;
  }
  static std::ptrdiff_t equal(const Picture& a, const Picture& b, std::int32_t from,
                              std::int32_t to) {
    std::ptrdiff_t count = 0;
    for (std::int32_t i = 0; i < kWidth * kLines; ++i) {
      const auto at = static_cast<std::size_t>(i);
      count += i % kWidth >= from && i % kWidth < to && a[at] == b[at] ? 1 : 0;
    }
    return count;
  }

  Picture pixels_ = Picture(std::size_t{kWidth} * kLines);
  Dice dice_{7};
  VideoSource source_;
};

TEST_F(VideoSourceOf, LeavesPicturesAloneWithoutAFault) {
  static_cast<void>(send(100));
  const Picture next = send(150);
  EXPECT_GE(*std::min_element(next.begin(), next.end()), 150);
}

TEST_F(VideoSourceOf, HangsInTheLeftColumnsToTheLastBit) {
  FieldFaults held = with(FaultKind::kHeld);
  held.held_share = 0.75;
  const Picture last = send(100);
  for (int i = 0; i < 3; ++i) {
    const Picture now = send(150 + i, held);
    EXPECT_EQ(equal(now, last, 0, 48), 48 * kLines);
    EXPECT_EQ(equal(now, last, 48, 64), 0);
  }
  const Picture anew = send(160);
  EXPECT_EQ(equal(anew, last, 0, 64), 0);
  EXPECT_EQ(equal(send(170, held), anew, 0, 48), 48 * kLines) << "the store has a new picture";
}

TEST_F(VideoSourceOf, AddsTheNoiseOfALineToTheStore) {
  FieldFaults held = with(FaultKind::kHeld);
  held.held_share = 1.0;
  held.held_noise = 2.0;
  const Picture last = send(100);
  const Picture first = send(150, held);
  const Picture second = send(150, held);
  double squares = 0.0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    const int d = int{second[i]} - int{last[i]};
    squares += d * d;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(last.size())), 2.0, 0.2);
  EXPECT_LT(equal(first, second, 0, kWidth), kWidth * kLines / 2);
}

TEST_F(VideoSourceOf, SendsSquaresAgainThatHardlyChange) {
  FieldFaults compressed = with(FaultKind::kCompressed);
  compressed.coarseness = 4.0;
  const Picture first = send(100, compressed);
  EXPECT_EQ(send(100, compressed), first) << "noise is skipped";
  const Picture moved = send(120, compressed);
  EXPECT_EQ(equal(moved, first, 0, kWidth), 0);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_NEAR(moved[i], 121, 1) << "the mean alone, in steps of four";
  }
}

TEST(FaultJitter, WaversTheStampsAlone) {
  const auto play = [](double waver_ms) {
    const auto scenario = small_scenario();
    scenario->video.length_s = 0.3;
    Fault jitter;
    jitter.kind = FaultKind::kJitter;
    jitter.waver_ms = waver_ms;
    scenario->faults = {jitter};
    const auto world = std::make_unique<SimulatedWorld>();
    EXPECT_TRUE(world->configure(*scenario));
    std::vector<core::Field> fields;
    SimulatedField field;
    while (world->next(field)) {
      fields.push_back(field.field);
    }
    return fields;
  };
  const auto plain = play(0.0);
  const auto wavering = play(5.0);
  const auto wildly = play(100.0);

  ASSERT_EQ(plain.size(), 18U);
  ASSERT_EQ(wavering.size(), plain.size());
  std::int64_t most_ns = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(wavering[i].sequence, plain[i].sequence);
    const std::int64_t off_ns = (wavering[i].mid_exposure - plain[i].mid_exposure).count();
    EXPECT_LE(std::abs(off_ns), 5'000'000);
    most_ns = std::max(most_ns, std::abs(off_ns));
    if (i > 0) {
      EXPECT_GT(wildly[i].mid_exposure, wildly[i - 1].mid_exposure) << "stamps grow";
    }
  }
  EXPECT_GT(most_ns, 2'000'000);
}

}  // namespace
}  // namespace tubesight::drivers
