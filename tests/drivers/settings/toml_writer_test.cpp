#include "drivers/settings/toml_writer.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(TomlNumber, IsShortExactAndARealNumber) {
  EXPECT_EQ(toml_number(0.1), "0.1");
  EXPECT_EQ(toml_number(25.0), "25.0");
  EXPECT_EQ(toml_number(-1.0 / 3.0), "-0.3333333333333333");
  EXPECT_EQ(toml_number(1e-7), "1e-07");
  EXPECT_EQ(toml_number(std::int64_t{-12}), "-12");
}

TEST(TomlWriter, WritesTablesKeysAndLists) {
  TomlWriter toml;
  toml.number("format", 1);
  toml.table("path");
  toml.text("profile", "s-curve");
  toml.word("told", true);
  toml.numbers("at_mm", std::array{1.5, -2.0});
  toml.entry("fault");
  toml.addresses("rolled", std::vector<core::TubeAddress>{{1, 2}, {-3, 4}});
  toml.addresses("flush", {});
  EXPECT_EQ(toml.take(),
            "format = 1\n\n[path]\nprofile = \"s-curve\"\ntold = true\nat_mm = [1.5, -2.0]\n"
            "\n[[fault]]\nrolled = [[1, 2], [-3, 4]]\n");
}

}  // namespace
}  // namespace tubesight::drivers
