#include "drivers/journal/journal_columns.h"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "drivers/journal/journal_digest.h"

namespace tubesight::drivers {
namespace {

TEST(JournalDigest, IsSha256) {
  // FIPS 180-2, appendix B.1, and the empty message.
  EXPECT_EQ(sha256_hex(std::string_view("abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(std::string_view("")),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(JournalDigest, ReadsBackHexadecimalDigitsAlone) {
  EXPECT_EQ(to_hex(*from_hex("00ff7a")), "00ff7a");
  EXPECT_FALSE(from_hex("0"));
  EXPECT_FALSE(from_hex("0g"));
  EXPECT_FALSE(from_hex("0A"));
}

TEST(JournalColumns, WritesEachCellWithItsLength) {
  const std::array<JournalCell, 5> cells = {std::int64_t{-12}, JournalCell(), std::string("a:b,"),
                                            std::string("\xc3\xbc"), std::string()};

  EXPECT_EQ(canonical_text("f0", cells), "f03:-12,-,4:a:b,,2:\xc3\xbc,0:,");
}

TEST(JournalColumns, TellsCellsApartThatLookAlikeTogether) {
  const std::array<JournalCell, 2> one = {std::string("ab"), std::string("c")};
  const std::array<JournalCell, 2> other = {std::string("a"), std::string("bc")};

  EXPECT_NE(chain_of("", one), chain_of("", other));
}

TEST(JournalColumns, PutsEveryMemberIntoItsColumn) {
  using std::chrono::microseconds;
  hal::JournalRow row;
  row.kind = hal::JournalKind::kVerification;
  row.time = {"boot", microseconds(5), microseconds(6), microseconds(7)};
  row.version = "1.2";
  row.origin = "robot";
  row.event_id = 8;
  row.claimed = core::TubeAddress{9, -10};
  row.verdict = "contradicted";
  row.reason = "moving";
  row.seen = {core::TubeAddress{11, 12}, 13, 14, 15, 16, 17, std::chrono::nanoseconds(18999), "d"};
  row.camera_id = "c";
  row.tool_id = "t";
  row.base_id = "b";
  row.first = microseconds(19);
  row.last = microseconds(20);
  row.count = 21;
  row.detail = "x=1";

  EXPECT_EQ(canonical_text("", cells_of(row, 4, "p")),
            "1:4,12:verification,4:boot,1:5,1:6,1:7,3:1.2,5:robot,1:8,1:9,3:-10,12:contradicted,"
            "6:moving,2:11,2:12,2:13,2:14,2:15,2:16,2:17,2:18,1:d,1:c,1:t,1:b,2:19,2:20,2:21,1:p,"
            "3:x=1,");
}

TEST(JournalColumns, LeavesOpenWhatIsNotKnown) {
  hal::JournalRow row;

  EXPECT_EQ(canonical_text("", cells_of(row, 1, "")),
            "1:1,4:boot,-,1:0,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,-,1:1,-,-,");
}

TEST(JournalColumns, KeepsOutWhatIsNoText) {
  hal::JournalRow row;
  row.detail = "a\nb\x7f\xff\xc3(\xc3\xbc\xe2\x82";

  EXPECT_EQ(std::get<std::string>(cells_of(row, 1, "").back()),
            "a?b?"
            "?"
            "?(\xc3\xbc?"
            "?");
}

}  // namespace
}  // namespace tubesight::drivers
