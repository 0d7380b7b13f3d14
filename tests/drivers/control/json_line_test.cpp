#include "drivers/control/json_line.h"

#include <string>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(JsonLine, IsOneObjectInOneLine) {
  JsonLine line;
  line.add("ok", true).add("n", std::int64_t{-3}).open("in").add("word", "a\"b\\c\nd").close();
  line.add_printed("mm", "0.5000");

  EXPECT_EQ(line.finish(), R"({"ok":true,"n":-3,"in":{"word":"a\"b\\c\nd"},"mm":0.5000})");
}

TEST(JsonLine, EscapesWhatIsNoText) {
  EXPECT_EQ(json_string(std::string("\x01\t\x7f", 3)), R"("\u0001\u0009\u007f")");
  EXPECT_EQ(json_string("ä"), "\"ä\"");
}

TEST(FindJsonString, ReadsWhatWasWritten) {
  const std::string text = "two\nlines, \"quoted\" \\ and a bell \x07";
  const std::string line = JsonLine().add("other", "x").add("text", text).finish();

  EXPECT_EQ(find_json_string(line, "text"), text);
  EXPECT_EQ(find_json_string(line, "missing"), "");
  EXPECT_EQ(find_json_string("{\"text\":\"cut", "text"), "cut");
  EXPECT_EQ(find_json_string("{\"text\":5}", "text"), "");
}

TEST(FindJsonNumber, ReadsWholeNumbers) {
  const std::string line = JsonLine().add("n", std::int64_t{-42}).add("word", "x").finish();

  EXPECT_EQ(find_json_number(line, "n", 7), -42);
  EXPECT_EQ(find_json_number(line, "word", 7), 7);
  EXPECT_EQ(find_json_number(line, "missing", 7), 7);
}

}  // namespace
}  // namespace tubesight::drivers
