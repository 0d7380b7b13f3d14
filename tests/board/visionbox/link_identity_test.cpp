#include "board/visionbox/link_identity.h"

#include <memory>
#include <set>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

TEST(LinkIdentity, AVersionIsANumberThatGrowsWithIt) {
  EXPECT_EQ(version_number("1.12.3"), 11'203);
  EXPECT_EQ(version_number("0.1.0"), 100);
  EXPECT_EQ(version_number("2"), 20'000);
  EXPECT_EQ(version_number("0.2.1-dirty"), 201);
}

TEST(LinkIdentity, ABootNumberIsNeverZeroAndNeverTheOneBefore) {
  std::set<std::int32_t> numbers;
  for (int i = 0; i < 100; ++i) {
    numbers.insert(draw_boot_number());
  }

  EXPECT_EQ(numbers.size(), 100U);
  EXPECT_GT(*numbers.begin(), 0);
}

TEST(LinkIdentity, HasTheSettingsWindowAndOptimum) {
  const auto session = std::make_unique<core::SessionSettings>();
  session->start.window_px = {1, 2, 3, 4};
  session->start.optimum_px = {5.0, 6.5};

  const drivers::LinkIdentity identity = link_identity(*session);

  EXPECT_EQ(identity.window_px, session->start.window_px);
  EXPECT_EQ(identity.optimum_px, session->start.optimum_px);
  EXPECT_GT(identity.product_version, 0);
  EXPECT_FALSE(identity.camera_id);
}

}  // namespace
}  // namespace tubesight::board
