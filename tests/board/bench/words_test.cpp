#include "board/bench/words.h"

#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/base/names.h"

namespace tubesight::board {
namespace {

using core::Reason;
using core::tracking::StartRefusal;

std::string messages_page() {
  std::ifstream file(TUBESIGHT_SOURCE_DIR "/docs/messages.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Words, ExplainEachReasonDifferently) {
  std::set<std::string_view> seen;
  constexpr int kLast = static_cast<int>(Reason::kArithmetic);
  for (int i = 1; i <= kLast; ++i) {
    const auto reason = static_cast<Reason>(i);
    EXPECT_FALSE(core::name_of(reason).empty()) << i;
    EXPECT_FALSE(explain(reason).empty()) << i;
    seen.insert(explain(reason));
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kLast));
}

TEST(Words, OfEachReasonAndRefusalAreInTheDocumentation) {
  const std::string page = messages_page();
  ASSERT_FALSE(page.empty());
  for (int i = 1; i <= static_cast<int>(Reason::kArithmetic); ++i) {
    const std::string word(core::name_of(static_cast<Reason>(i)));
    EXPECT_NE(page.find("| `" + word + "` |"), std::string::npos) << word;
  }
  for (int i = 1; i <= static_cast<int>(StartRefusal::kPicture); ++i) {
    const std::string word(name_of(static_cast<StartRefusal>(i)));
    EXPECT_NE(page.find("| `" + word + "` |"), std::string::npos) << word;
    EXPECT_FALSE(explain(static_cast<StartRefusal>(i)).empty()) << word;
  }
}

}  // namespace
}  // namespace tubesight::board
