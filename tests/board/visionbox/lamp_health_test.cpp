#include <gtest/gtest.h>

#include "board/visionbox/tracking_thread.h"

namespace tubesight::board {
namespace {

using core::lighting::LampCondition;
using drivers::Health;

TEST(LampHealth, IsWellOnlyWhereThePictureShowsIt) {
  EXPECT_EQ(lamp_health(false, LampCondition::kWell), Health::kWell);
  EXPECT_EQ(lamp_health(false, LampCondition::kUnknown), Health::kUnknown);
  for (const LampCondition fault :
       {LampCondition::kWeak, LampCondition::kDark, LampCondition::kUnseen}) {
    EXPECT_EQ(lamp_health(false, fault), Health::kFailed);
  }
  EXPECT_EQ(lamp_health(true, LampCondition::kWell), Health::kFailed);
  EXPECT_EQ(lamp_health(true, LampCondition::kUnknown), Health::kFailed);
}

}  // namespace
}  // namespace tubesight::board
