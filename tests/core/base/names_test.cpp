#include "core/base/names.h"

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

TEST(Names, AreThoseOfTheFileFormats) {
  EXPECT_EQ(name_of(Parity::kEven), "even");
  EXPECT_EQ(name_of(Parity::kOdd), "odd");
  EXPECT_EQ(name_of(Parity::kProgressive), "progressive");
  EXPECT_EQ(name_of(TrackState::kWaiting), "waiting");
  EXPECT_EQ(name_of(TrackState::kTracking), "tracking");
  EXPECT_EQ(name_of(TrackState::kDegraded), "degraded");
  EXPECT_EQ(name_of(TrackState::kLost), "lost");
}

}  // namespace
}  // namespace tubesight::core
