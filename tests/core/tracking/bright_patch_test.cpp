#include "core/tracking/bright_patch.h"

#include <initializer_list>

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class BrightPatch : public ::testing::Test {
 protected:
  void SetUp() override { scene_.make(); }

  bool one_patch(std::initializer_list<TubeAddress> bright) {
    SiteSightings::List list;
    for (const TubeAddress address : bright) {
      EXPECT_TRUE(list.try_push_back(address));
    }
    return is_one_patch<S>(scene_.model, list);
  }

  Scene<S> scene_;
};
TYPED_TEST_SUITE(BrightPatch, Scalars);

TYPED_TEST(BrightPatch, IsWhatHangsTogether) {
  EXPECT_TRUE(this->one_patch({}));
  EXPECT_TRUE(this->one_patch({{5, 5}}));
  // Whatever their order.
  EXPECT_TRUE(this->one_patch({{20, 10}, {22, 10}, {21, 10}, {20, 11}, {22, 12}, {22, 11}}));
  // One of five may lie elsewhere, as a plug does; two of six are too many.
  EXPECT_TRUE(this->one_patch({{20, 10}, {21, 10}, {20, 11}, {21, 11}, {30, 11}}));
  EXPECT_FALSE(this->one_patch({{20, 10}, {21, 10}, {20, 11}, {21, 11}, {30, 11}, {32, 11}}));
}

TYPED_TEST(BrightPatch, IsNotWhatLiesAllOverTheWindow) {
  EXPECT_FALSE(this->one_patch({{20, 10}, {22, 10}, {20, 12}, {22, 12}, {24, 10}, {24, 12}}));
}

}  // namespace
}  // namespace tubesight::core::tracking
