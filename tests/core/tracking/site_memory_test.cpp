#include "core/tracking/site_memory.h"

#include <gtest/gtest.h>

namespace tubesight::core::tracking {
namespace {

constexpr TubeAddress kTool{10, 10};
constexpr TubeAddress kSite{12, -3};

TEST(SiteMemory, VouchesForWhatItNeverSaw) { EXPECT_TRUE(SiteMemory().vouches_for(kSite)); }

TEST(SiteMemory, DoesNotVouchForASiteThatWasBrightAlone) {
  SiteMemory memory;
  memory.saw_closed(kSite, true, kTool);
  memory.end_field();
  EXPECT_FALSE(memory.vouches_for(kSite));
  for (int field = 0; field < 100; ++field) {
    memory.end_field();
  }
  EXPECT_FALSE(memory.vouches_for(kSite)) << "out of view, it is no other";
  memory.begin();
  EXPECT_TRUE(memory.vouches_for(kSite));
}

TEST(SiteMemory, OneLookAtATubeEndIsEnough) {
  SiteMemory memory;
  memory.saw_closed(kSite, true, kTool);
  memory.end_field();
  memory.saw_tube_end(kSite);
  memory.end_field();
  EXPECT_TRUE(memory.vouches_for(kSite));
  memory.saw_closed(kSite, true, kTool);
  memory.end_field();
  EXPECT_TRUE(memory.vouches_for(kSite)) << "a glare, or the guidetube, on a tube-end";
}

TEST(SiteMemory, APlateInPoorLightIsNoTubeEnd) {
  SiteMemory memory;
  memory.saw_dark(kSite);
  memory.end_field();
  memory.saw_closed(kSite, true, kTool);
  memory.end_field();
  EXPECT_FALSE(memory.vouches_for(kSite));
  memory.saw_dark(kSite);
  memory.end_field();
  EXPECT_FALSE(memory.vouches_for(kSite));
}

TEST(SiteMemory, BehindTheGuidetubeNothingIsLearnt) {
  SiteMemory memory;
  memory.saw_closed(kSite, false, kTool);
  memory.end_field();
  EXPECT_TRUE(memory.vouches_for(kSite));
}

TEST(SiteMemory, TubeEndsOutOfViewAreForgottenWhereRoomIsNeeded) {
  SiteMemory memory;
  memory.saw_tube_end(kSite);
  memory.end_field();
  memory.end_field();
  memory.saw_closed(kSite, true, kTool);
  memory.end_field();
  EXPECT_TRUE(memory.vouches_for(kSite));
  for (std::int32_t column = 0; column < 50; ++column) {
    memory.saw_tube_end({1, column});
  }
  memory.end_field();
  memory.saw_closed(kSite, true, kTool);
  memory.end_field();
  EXPECT_FALSE(memory.vouches_for(kSite));
}

TEST(SiteMemory, KeepsTheBrightSitesNearestToTheTool) {
  SiteMemory memory;
  for (std::int32_t column = 100; column > 60; --column) {
    memory.saw_closed({10, column}, true, kTool);
  }
  memory.end_field();
  for (std::int32_t column = 61; column <= 92; ++column) {
    EXPECT_FALSE(memory.vouches_for({10, column})) << column;
  }
  for (std::int32_t column = 93; column <= 100; ++column) {
    EXPECT_TRUE(memory.vouches_for({10, column})) << column;
  }
}

TEST(SiteMemory, KnowsAsManyTubeEndsAsAWindowShows) {
  SiteMemory memory;
  for (std::int32_t column = 0; column < 64; ++column) {
    memory.saw_tube_end({1, column});
  }
  memory.end_field();
  for (std::int32_t column = 0; column < 64; ++column) {
    memory.saw_closed({1, column}, true, kTool);
  }
  memory.end_field();
  for (std::int32_t column = 0; column < 64; ++column) {
    EXPECT_TRUE(memory.vouches_for({1, column})) << column;
  }
}

}  // namespace
}  // namespace tubesight::core::tracking
