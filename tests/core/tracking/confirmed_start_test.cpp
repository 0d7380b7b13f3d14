#include "core/tracking/confirmed_start.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class ConfirmedStart : public ObservedScene<S> {
 protected:
  using ObservedScene<S>::scene_;
  using ObservedScene<S>::sheet_;
  using ObservedScene<S>::observer_;
  using ObservedScene<S>::frame_;

  /// Clicks on three tubes, each said to be that at the same place of `told`.
  StartRefusal start(const std::vector<TubeAddress>& told) {
    const std::vector<TubeAddress> clicked{{20, 10}, {21, 10}, {20, 11}};
    StartClickList clicks;
    for (std::size_t i = 0; i < clicked.size(); ++i) {
      const auto at = sheet_->image_of(kOverTube, clicked[i]);
      const ImagePoint point = make_image_point({at[0] + 3.0, at[1] - 2.0});
      EXPECT_TRUE(clicks.try_push_back({told[i], point.u_q16, point.v_q16}));
    }
    sheet_->draw(kOverTube, Parity::kEven, 1, frame_);
    std::mt19937 random(5);
    for (std::size_t i = 0; i < specks_; ++i) {
      frame_[random() % frame_.size()] = 255;
    }
    const FieldView view = sheet_->view(frame_, Parity::kEven);
    StartSearch<S> search(scene_.model, *scene_.map, view, clicks);
    return find_confirmed_start<S>(search, *observer_, seen_).refusal;
  }

  std::size_t specks_ = 0;
  Observation<S> seen_{};
};
TYPED_TEST_SUITE(ConfirmedStart, Scalars);

TYPED_TEST(ConfirmedStart, RefinesTheClicksOnTheWholeWindow) {
  ASSERT_EQ(this->start({{20, 10}, {21, 10}, {20, 11}}), StartRefusal::kNone);
  ASSERT_TRUE(this->seen_.fitted);
  EXPECT_GE(this->seen_.fit.used, 3);
  EXPECT_LT(this->error_mm(this->seen_), 0.3);
}

TYPED_TEST(ConfirmedStart, IsTakenUnderSpecksAndUnderARaisedBlackLevel) {
  this->specks_ = 4000;
  ASSERT_EQ(this->start({{20, 10}, {21, 10}, {20, 11}}), StartRefusal::kNone);
  EXPECT_LT(this->error_mm(this->seen_), 0.3);
  EXPECT_NE(this->start({{20, 10}, {21, 10}, {20, 12}}), StartRefusal::kNone);
  this->specks_ = 0;
  this->sheet_->look.gain = 0.5;
  this->sheet_->look.offset = 64.0;
  ASSERT_EQ(this->start({{20, 10}, {21, 10}, {20, 11}}), StartRefusal::kNone);
  EXPECT_LT(this->error_mm(this->seen_), 0.3);
}

TYPED_TEST(ConfirmedStart, IsRefusedWhenOneAddressIsAnother) {
  for (const TubeAddress wrong : {TubeAddress{20, 12}, {21, 11}, {19, 11}}) {
    EXPECT_NE(this->start({{20, 10}, {21, 10}, wrong}), StartRefusal::kNone)
        << wrong.row << ", " << wrong.column;
  }
}

TYPED_TEST(ConfirmedStart, IsRefusedWhenTheWindowShowsSheetWhereTubeEndsShouldBe) {
  auto& plugs = this->sheet_->look.flush_plugs;
  for (std::int32_t row = 15; row <= 25; ++row) {
    for (std::int32_t column = 5; column <= 15; ++column) {
      const bool clicked =
          (row == 20 && column <= 11 && column >= 10) || (row == 21 && column == 10);
      if (!clicked) {
        plugs.push_back({row, column});
      }
    }
  }
  EXPECT_EQ(this->start({{20, 10}, {21, 10}, {20, 11}}), StartRefusal::kPicture);
}

TYPED_TEST(ConfirmedStart, TellsWhatTheRoughStartRefused) {
  EXPECT_EQ(this->start({{20, 10}, {21, 10}, {900, 11}}), StartRefusal::kAddresses);
  this->sheet_->look.gain = 0.0;
  this->sheet_->look.offset = 4.0;
  EXPECT_NE(this->start({{20, 10}, {21, 10}, {20, 11}}), StartRefusal::kNone);
}

}  // namespace
}  // namespace tubesight::core::tracking
