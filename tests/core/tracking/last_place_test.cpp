#include "core/tracking/last_place.h"

#include <chrono>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/overflow.h"
#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class LastPlaceOf : public ObservedScene<S> {
 protected:
  using ObservedScene<S>::scene_;
  using ObservedScene<S>::sheet_;
  using ObservedScene<S>::frame_;

  static constexpr std::chrono::milliseconds kField{17};

  /// Whether clicks are refuted whose addresses are so far off, so long after the tool was seen.
  bool refutes(TubeAddress off, std::chrono::milliseconds since = kField) {
    StartClickList clicks;
    for (const TubeAddress tube : std::vector<TubeAddress>{{20, 10}, {21, 10}, {20, 11}}) {
      const auto at = sheet_->image_of(kOverTube, tube);
      const ImagePoint point = make_image_point({at[0] + 3.0, at[1] - 2.0});
      EXPECT_TRUE(clicks.try_push_back(
          {{tube.row + off.row, tube.column + off.column}, point.u_q16, point.v_q16}));
    }
    sheet_->draw(kOverTube, Parity::kEven, 1, frame_);
    Field field;
    field.pixels = sheet_->view(frame_, Parity::kEven);
    field.mid_exposure = std::chrono::seconds(1);
    LastPlace<S> last;
    last.believe(field, kTube, {}, motion_);
    field.mid_exposure += since;
    StartSearch<S> search(scene_.model, *scene_.map, field.pixels, clicks);
    return last.refutes(field, search);
  }

  Motion<S> motion_{};
};
TYPED_TEST_SUITE(LastPlaceOf, Scalars);

TYPED_TEST(LastPlaceOf, RefutesWhatNobodyCanHaveReached) {
  EXPECT_FALSE(this->refutes({0, 0}));
  EXPECT_TRUE(this->refutes({1, 0}));
  EXPECT_TRUE(this->refutes({0, -3}));
}

TYPED_TEST(LastPlaceOf, RefutesWhatIsFarFromWhereTheMotionLeads) {
  using M = Mm<TypeParam>;
  TrackingModel<TypeParam>& model = this->scene_.model;
  model.max_speed_mm_s = constant<M>(1150.0);  // a step is within its reach in a field
  model.max_acceleration_m_s2 = constant<M>(3.0);
  EXPECT_FALSE(this->refutes({1, 0})) << "nothing is known of the motion";
  this->motion_.known = true;
  this->motion_.interval_s = constant<Unit<TypeParam>>(0.017);
  EXPECT_TRUE(this->refutes({1, 0})) << "it rests";
  EXPECT_FALSE(this->refutes({0, 0}));
  EXPECT_FALSE(this->refutes({1, 0}, std::chrono::milliseconds(100))) << "time to get there";
  this->motion_.velocity_mm_s = {constant<M>(800.0), constant<M>(800.0)};
  EXPECT_TRUE(this->refutes({0, 0})) << "it cannot have stopped";
}

// As a search leaves it whose numbers are of no pose.
TYPED_TEST(LastPlaceOf, IsNotMisledByNumbersThatLeftTheirRangeBefore) {
  raise_overflow_flag();
  EXPECT_TRUE(this->refutes({1, 0}));
  EXPECT_FALSE(take_overflow_flag());
}

}  // namespace
}  // namespace tubesight::core::tracking
