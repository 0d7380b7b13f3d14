#include "core/tracking/primary_tube.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class PrimaryTubeOf : public ::testing::Test {
 protected:
  /// A tube-end of this column, measured at so many pixels right of the optimum point.
  void add(std::int32_t column, double right_px, bool used = true) {
    TubeMeasurement<S> tube;
    tube.address = {7, column};
    tube.center_px = {Px<S>(320.0 + right_px), Px<S>(200.0)};
    tube.used = used;
    tubes_.push_back(tube);
  }
  void choose() {
    primary_.choose<S>(tubes_, {Px<S>(320.0), Px<S>(200.0)});
    tubes_.clear();
  }

  std::vector<TubeMeasurement<S>> tubes_;
  PrimaryTube primary_;
};
TYPED_TEST_SUITE(PrimaryTubeOf, Scalars);

TYPED_TEST(PrimaryTubeOf, IsTheNearestToTheOptimumPoint) {
  EXPECT_FALSE(this->primary_.known());
  this->add(1, -120.0);
  this->add(2, -40.0);
  this->add(3, 60.0);
  this->choose();
  ASSERT_TRUE(this->primary_.known());
  EXPECT_EQ(this->primary_.address(), (TubeAddress{7, 2}));
  EXPECT_TRUE(this->primary_.is({7, 2}));
  EXPECT_FALSE(this->primary_.is({7, 3}));
}

TYPED_TEST(PrimaryTubeOf, IsNoneThatTheFitRejected) {
  this->add(1, -120.0);
  this->add(2, -40.0, false);
  this->choose();
  EXPECT_EQ(this->primary_.address(), (TubeAddress{7, 1}));
}

TYPED_TEST(PrimaryTubeOf, IsKeptUntilAnotherIsNearerByATenth) {
  this->add(1, 100.0);
  this->choose();
  this->add(1, 100.0);
  this->add(2, -91.0);
  this->choose();
  EXPECT_EQ(this->primary_.address(), (TubeAddress{7, 1}));
  this->add(1, 100.0);
  this->add(2, -89.0);
  this->choose();
  EXPECT_EQ(this->primary_.address(), (TubeAddress{7, 2}));
}

TYPED_TEST(PrimaryTubeOf, GivesWayWhenItIsNotMeasured) {
  this->add(1, 10.0);
  this->choose();
  this->add(1, 10.0, false);
  this->add(2, -90.0);
  this->choose();
  EXPECT_EQ(this->primary_.address(), (TubeAddress{7, 2}));
}

TYPED_TEST(PrimaryTubeOf, StaysWithoutTubeEndsAndIsForgottenOnDemand) {
  this->add(1, 10.0);
  this->choose();
  this->choose();
  EXPECT_TRUE(this->primary_.is({7, 1}));
  this->primary_.forget();
  EXPECT_FALSE(this->primary_.known());
  EXPECT_FALSE(this->primary_.is({7, 1}));
  // What was forgotten has no tenth in its favour.
  this->add(1, 100.0);
  this->add(2, -99.0);
  this->choose();
  EXPECT_EQ(this->primary_.address(), (TubeAddress{7, 2}));
}

}  // namespace
}  // namespace tubesight::core::tracking
