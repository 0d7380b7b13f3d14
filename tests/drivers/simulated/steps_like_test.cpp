#include "drivers/simulated/steps_like.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

using Steps = std::array<std::int32_t, 2>;

/// A square pitch of 25.4 mm at 3000 mm/s^2 and 60 fields a second: up to 1.67 + 0.6 mm.
class StepsLike : public ::testing::Test {
 protected:
  StepsLike() {
    sheet_.row_step_mm = {0.0, 25.4};
    sheet_.column_step_mm = {25.4, 0.0};
    sheet_.rows = {0, 50};
    sheet_.columns = {0, 50};
  }
  [[nodiscard]] Steps of(double x, double y) const {
    return steps_like(sheet_, {}, 1.0 / 60.0, {x, y});
  }

  core::TubesheetSettings sheet_;
};

TEST_F(StepsLike, AreThoseThatAreMissedByLittle) {
  EXPECT_EQ(of(25.4, -50.8), (Steps{-2, 1}));
  EXPECT_EQ(of(25.4 + 2.2, -50.8), (Steps{-2, 1}));
  EXPECT_EQ(of(25.4, -50.8 - 2.2), (Steps{-2, 1}));
}

TEST_F(StepsLike, AreNoneOffTheLattice) {
  EXPECT_EQ(of(25.4 + 2.4, -50.8), (Steps{0, 0}));
  EXPECT_EQ(of(12.7, 12.7), (Steps{0, 0}));
  EXPECT_EQ(of(1.0, 0.0), (Steps{0, 0}));
}

TEST_F(StepsLike, LeaveOutWhatDoesNotLieOnItself) {
  sheet_.addresses = core::AddressParity::kEvenSum;
  EXPECT_EQ(of(25.4, 0.0), (Steps{0, 0}));
  EXPECT_EQ(of(25.4, 25.4), (Steps{1, 1}));
}

}  // namespace
}  // namespace tubesight::drivers
