#include "drivers/settings/toml_writer.h"

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(TomlNumber, IsShortExactAndARealNumber) {
  EXPECT_EQ(toml_number(0.1), "0.1");
  EXPECT_EQ(toml_number(25.0), "25.0");
  EXPECT_EQ(toml_number(-1.0 / 3.0), "-0.3333333333333333");
  EXPECT_EQ(toml_number(1e-7), "1e-07");
}

TEST(TomlNumber, HasNoExponentWhereItIsToBePlain) {
  EXPECT_EQ(toml_number(25.0, TomlManner::kPlain), "25.0");
  EXPECT_EQ(toml_number(-0.00005, TomlManner::kPlain), "-0.00005");
  EXPECT_EQ(toml_number(19.24741459910915, TomlManner::kPlain), "19.24741459910915");
  EXPECT_EQ(toml_number(5e-324, TomlManner::kPlain).size(), 326U);
}

TEST(TomlWriter, WritesTablesKeysAndLists) {
  TomlWriter toml;
  toml.whole("format", 1);
  toml.table("path");
  toml.text("profile", "s-curve");
  toml.truth("told", true);
  toml.numbers("at_mm", std::array{1.5, -2.0});
  toml.entry("fault");
  toml.addresses("rolled", std::vector<core::TubeAddress>{{1, 2}, {-3, 4}});
  toml.addresses("flush", {});
  EXPECT_EQ(toml.take(),
            "format = 1\n\n[path]\nprofile = \"s-curve\"\ntold = true\nat_mm = [1.5, -2.0]\n"
            "\n[[fault]]\nrolled = [[1, 2], [-3, 4]]\n");
}

TEST(TomlWriter, BreaksListsAfterTenAddressesUnlessPlain) {
  const std::vector<core::TubeAddress> eleven(11, {1, 2});
  TomlWriter brief;
  TomlWriter plain(TomlManner::kPlain);
  brief.addresses("a", eleven);
  plain.addresses("a", eleven);
  plain.addresses("b", {});
  EXPECT_NE(brief.take().find("[1, 2],\n  [1, 2]]\n"), std::string::npos);
  EXPECT_NE(plain.take().find("[1, 2], [1, 2]]\nb = []\n"), std::string::npos);
}

TEST(TomlWriter, KeepsQuotationMarksApart) {
  TomlWriter toml;
  toml.text("title", "a \"b\" \\ c\nd");
  EXPECT_EQ(toml.take(), "title = \"a \\\"b\\\" \\\\ c d\"\n");
  EXPECT_EQ(toml_comment("a\nb"), "# a b\n");
}

TEST(TomlWriter, WritesTablesWithinAList) {
  TomlWriter tube;
  tube.whole("row", 3);
  tube.numbers("at_px", std::array{1.0, 2.5});
  const std::string one = tube.take_inline();
  TomlWriter toml;
  toml.table("start");
  toml.inline_tables("tubes", std::vector<std::string>{one, one});
  EXPECT_EQ(toml.take(),
            "[start]\ntubes = [{ row = 3, at_px = [1.0, 2.5] }, { row = 3, at_px = [1.0, 2.5] "
            "}]\n");
}

}  // namespace
}  // namespace tubesight::drivers
