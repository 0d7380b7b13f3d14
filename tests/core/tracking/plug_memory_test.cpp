#include "core/tracking/plug_memory.h"

#include <gtest/gtest.h>

namespace tubesight::core::tracking {
namespace {

TEST(PlugMemory, BelievesTheThirdSighting) {
  PlugMemory memory;
  memory.saw_plug({4, 5});
  memory.saw_plug({4, 5});
  EXPECT_FALSE(memory.is_plug({4, 5}));
  memory.saw_plug({4, 5});
  EXPECT_TRUE(memory.is_plug({4, 5}));
  EXPECT_FALSE(memory.is_plug({5, 4}));
}

TEST(PlugMemory, CountsSightingsAsOpenAgainstIt) {
  PlugMemory memory;
  for (int i = 0; i < 20; ++i) {
    memory.saw_plug({4, 5});
    memory.saw_open({4, 5});
  }
  EXPECT_FALSE(memory.is_plug({4, 5}));
}

TEST(PlugMemory, ForgetsALongPlugWithinAQuarterOfASecondOfOpenSightings) {
  PlugMemory memory;
  for (int i = 0; i < 1000; ++i) {
    memory.saw_plug({4, 5});
  }
  int fields = 0;
  while (memory.is_plug({4, 5}) && fields < 100) {
    memory.saw_open({4, 5});
    ++fields;
  }
  EXPECT_LE(fields, 15);
  EXPECT_GE(fields, 1);
}

TEST(PlugMemory, HoldsAsManyAsAWindowShows) {
  PlugMemory memory;
  for (int seen = 0; seen < 3; ++seen) {
    for (std::int32_t i = 0; i < 64; ++i) {
      memory.saw_plug({i, -i});
    }
  }
  for (std::int32_t i = 0; i < 64; ++i) {
    EXPECT_TRUE(memory.is_plug({i, -i})) << i;
  }
}

TEST(PlugMemory, GivesUpTheWeakestWhenFull) {
  PlugMemory memory;
  for (std::int32_t i = 0; i < 64; ++i) {
    memory.saw_plug({i, 0});
    memory.saw_plug({i, 0});
  }
  for (std::int32_t i = 1; i < 64; ++i) {
    memory.saw_plug({i, 0});
  }

  for (int i = 0; i < 3; ++i) {
    memory.saw_plug({100, 0});
  }

  EXPECT_TRUE(memory.is_plug({100, 0}));
  EXPECT_FALSE(memory.is_plug({0, 0}));
  for (std::int32_t i = 1; i < 64; ++i) {
    EXPECT_TRUE(memory.is_plug({i, 0})) << i;
  }
}

TEST(PlugMemory, KnowsNothingAfterClearing) {
  PlugMemory memory;
  for (int i = 0; i < 5; ++i) {
    memory.saw_plug({1, 1});
  }
  memory.clear();
  EXPECT_FALSE(memory.is_plug({1, 1}));
  EXPECT_FALSE(memory.is_plug({0, 0})) << "an empty entry's address";
}

}  // namespace
}  // namespace tubesight::core::tracking
