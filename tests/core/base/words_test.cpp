#include "core/base/words.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

/// The rows of the tables below a heading of docs/messages.md: by the word in the first cell the
/// rest of the row, without the marks around code.
using Rows = std::map<std::string, std::string>;

Rows rows_below(const std::string& heading) {
  std::ifstream page(TUBESIGHT_SOURCE_DIR "/docs/messages.md");
  Rows rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) {
      inside = line == "## " + heading;
    }
    const std::size_t end = line.find("` |");
    if (!inside || !line.starts_with("| `") || end == std::string::npos) {
      continue;
    }
    std::string rest = line.substr(end + 3);
    rest.erase(std::remove(rest.begin(), rest.end(), '`'), rest.end());
    EXPECT_TRUE(rows.emplace(line.substr(3, end - 3), rest).second) << line;
  }
  return rows;
}

/// What a page lacks, has too much, or explains otherwise than the program.
template <HasWords E>
std::string difference_to(Rows rows) {
  std::string found;
  for (std::int32_t i = 1; i < count_of<E>(); ++i) {
    const Words words = words_of(static_cast<E>(i));
    const std::string word(words.word);
    const auto row = rows.find(word);
    if (row == rows.end()) {
      found += word + ": missing\n";
      continue;
    }
    if (row->second.find(words.meaning) == std::string::npos) {
      found += word + ": not explained by '" + std::string(words.meaning) + "'\n";
    }
    rows.erase(row);
  }
  for (const auto& [word, rest] : rows) {
    found += word + ": surplus\n";
  }
  return found;
}

template <typename E>
class WordsOf : public ::testing::Test {};
using Kinds = ::testing::Types<Reason, StartRefusal, PoseReason, ClaimDoubt, PickDoubt>;
TYPED_TEST_SUITE(WordsOf, Kinds);

TYPED_TEST(WordsOf, AreSingleWordsWithAMeaningAndDiffer) {
  EXPECT_TRUE(name_of(TypeParam::kNone).empty());
  EXPECT_TRUE(explain(TypeParam::kNone).empty());
  std::set<std::string_view> words;
  std::set<std::string_view> meanings;
  ASSERT_GT(count_of<TypeParam>(), 1);
  for (std::int32_t i = 1; i < count_of<TypeParam>(); ++i) {
    const auto value = static_cast<TypeParam>(i);
    EXPECT_EQ(name_of(value).find_first_not_of("abcdefghijklmnopqrstuvwxyz-"),
              std::string_view::npos)
        << name_of(value);
    EXPECT_FALSE(explain(value).empty()) << name_of(value);
    EXPECT_TRUE(words.insert(name_of(value)).second) << name_of(value);
    EXPECT_TRUE(meanings.insert(explain(value)).second) << name_of(value);
  }
}

TEST(WordsOfReasons, HaveAMarkForTheOverlayOfTheirOwn) {
  std::set<std::string_view> marks;
  for (std::int32_t i = 1; i < count_of<Reason>(); ++i) {
    const std::string_view mark = words_of(static_cast<Reason>(i)).mark;
    EXPECT_FALSE(mark.empty()) << i;
    EXPECT_LE(mark.size(), 14U) << mark;
    EXPECT_TRUE(marks.insert(mark).second) << mark;
  }
}

TEST(Messages, HaveARowForEachReasonAndNoOther) {
  EXPECT_EQ(difference_to<Reason>(rows_below("Why the state is not `tracking`")), "");
}

TEST(Messages, HaveARowForEachRefusedStartAndNoOther) {
  EXPECT_EQ(difference_to<StartRefusal>(rows_below("Why a start was refused")), "");
}

TEST(Messages, HaveARowForEachRefusedPoseRequestAndNoOther) {
  EXPECT_EQ(difference_to<PoseReason>(rows_below("Why a pose request was refused")), "");
}

TEST(Messages, HaveARowForEachDoubtOfAClaimAndNoOther) {
  EXPECT_EQ(difference_to<ClaimDoubt>(rows_below("Why a claim was answered \"unknown\"")), "");
}

TEST(Messages, HaveARowForEachDoubtOfAPickAndNoOther) {
  EXPECT_EQ(difference_to<PickDoubt>(rows_below("Why a pick named no tube")), "");
}

TEST(Messages, AreFoundWantingWhereTheyAre) {
  Rows rows = rows_below("Why a pose request was refused");
  rows.erase("busy");
  rows["weary"] = "the box is tired";
  rows["moving"] = " the tool rests |";
  EXPECT_EQ(difference_to<PoseReason>(rows),
            "moving: not explained by 'the tool moves'\nbusy: missing\nweary: surplus\n");
}

}  // namespace
}  // namespace tubesight::core
