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
}

TEST(LinkIdentity, DigestsAsFnv1a) {
  // Test vectors of the algorithm's authors, without the uppermost bit.
  EXPECT_EQ(calibration_id(""), 0x011c9dc5);
  EXPECT_EQ(calibration_id("a"), 0x640c292c);
  EXPECT_EQ(calibration_id("foobar"), 0x3f9cf968);
}

TEST(LinkIdentity, CalibrationsHaveAnIdentityEachThatAnyChangeOfThemChanges) {
  const auto session = std::make_unique<core::SessionSettings>();
  session->camera.focal_length_mm = 5.06;
  session->tool.position_mm = {-3.0, 31.0, 112.0};
  const drivers::LinkIdentity before = link_identity(*session);
  ASSERT_TRUE(before.camera_id && before.tool_id);
  EXPECT_EQ(link_identity(*session).camera_id, before.camera_id) << "the same after a restart";
  EXPECT_FALSE(before.base_id) << "nothing tells of it";

  session->camera.distortion_per_mm2 = 1e-9;
  const drivers::LinkIdentity other_camera = link_identity(*session);
  session->tool.rotation_deg[2] = 0.0001;
  const drivers::LinkIdentity other_tool = link_identity(*session);
  session->start.window_px = {1, 2, 3, 4};

  EXPECT_NE(other_camera.camera_id, before.camera_id);
  EXPECT_EQ(other_camera.tool_id, before.tool_id);
  EXPECT_NE(other_tool.tool_id, before.tool_id);
  EXPECT_EQ(link_identity(*session).camera_id, other_camera.camera_id) << "of the camera alone";
}

}  // namespace
}  // namespace tubesight::board
