#include "core/base/names.h"

#include <set>
#include <string_view>

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
  EXPECT_EQ(name_of(Reason::kNone), "");
}

TEST(Names, OfReasonsAreSingleWordsAndDiffer) {
  std::set<std::string_view> seen;
  constexpr int kFirst = static_cast<int>(Reason::kNoStart);
  constexpr int kLast = static_cast<int>(Reason::kArithmetic);
  for (int i = kFirst; i <= kLast; ++i) {
    const std::string_view name = name_of(static_cast<Reason>(i));
    EXPECT_FALSE(name.empty()) << i;
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string_view::npos)
        << name;
    EXPECT_TRUE(seen.insert(name).second) << name;
  }
}

}  // namespace
}  // namespace tubesight::core
