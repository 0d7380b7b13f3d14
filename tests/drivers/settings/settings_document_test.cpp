#include "drivers/settings/settings_document.h"

#include <array>

#include <gtest/gtest.h>

#include "tests/drivers/settings/settings_files.h"

namespace tubesight::drivers {
namespace {

constexpr std::array<std::string_view, 2> kKnown = {"camera", "tool"};

Messages mistakes_of(MemoryFiles& files, const std::string& path = "dir/s.toml") {
  SettingsDocument document;
  Messages messages;
  document.load(files, path, kKnown);
  const auto outcome = document.report(messages);
  EXPECT_EQ(outcome.has_value(), messages.empty());
  return messages;
}

Messages mistakes_in(const std::string& text) {
  MemoryFiles files;
  files.texts["dir/s.toml"] = text;
  return mistakes_of(files);
}

TEST(SettingsDocument, MergesTheTablesOfIncludedFiles) {
  MemoryFiles files;
  files.texts["dir/s.toml"] = "format = 1\ninclude = [\"sub/c.toml\"]\n[tool]\na = 1\n";
  files.texts["dir/sub/c.toml"] = "include = [\"../more.toml\"]\n";
  files.texts["dir/sub/../more.toml"] = "\n[camera]\nb = 2\n";
  SettingsDocument document;
  Messages messages;

  document.load(files, "dir/s.toml", kKnown);

  ASSERT_TRUE(document.report(messages)) << messages.front();
  ASSERT_NE(document.find("camera"), nullptr);
  EXPECT_EQ(document.find("camera")->place.line, 2);
  EXPECT_EQ(document.find("camera")->place.file, 2);
  EXPECT_NE(document.find("tool"), nullptr);
  EXPECT_EQ(document.find("start"), nullptr);
}

TEST(SettingsDocument, TellsTheSameTableTwice) {
  MemoryFiles files;
  files.texts["dir/s.toml"] = "include = [\"c.toml\", \"c.toml\"]\n[tool]\n";
  files.texts["dir/c.toml"] = "\n\n[tool]\n";

  EXPECT_EQ(
      mistakes_of(files),
      (Messages{"dir/s.toml:2: [tool]: the table is already in dir/c.toml:3, expected it once",
                "dir/c.toml:3: [tool]: the table is already in dir/c.toml:3, expected it "
                "once"}));
}

TEST(SettingsDocument, TellsIncludesThatCannotBe) {
  MemoryFiles files;
  files.texts["dir/s.toml"] = "include = [\"none.toml\", 3,\n \"c.toml\"]\n";
  files.texts["dir/c.toml"] = "\ninclude = [\"../dir/s.toml\"]\n";

  EXPECT_EQ(mistakes_of(files),
            (Messages{"dir/s.toml:1: include: 'dir/none.toml' cannot be read: No such file or "
                      "directory",
                      "dir/s.toml:1: include: not a file's name, expected [\"file.toml\", ...]",
                      "dir/c.toml:2: include: 'dir/../dir/s.toml' includes itself, expected no "
                      "circle"}));
  EXPECT_EQ(mistakes_in("include = \"c.toml\"\n"),
            Messages{"dir/s.toml:1: include: not a list, expected [\"file.toml\", ...]"});
}

TEST(SettingsDocument, TellsAFileThatCannotBeRead) {
  MemoryFiles files;

  EXPECT_EQ(mistakes_of(files, "none.toml"),
            Messages{"none.toml: cannot be read: No such file or directory"});
}

TEST(SettingsDocument, TellsUnknownTablesAndKeys) {
  EXPECT_EQ(mistakes_in("foo = 1\ncamera = 2\n[bar]\n[[tool]]\n[[baz]]\n"),
            (Messages{"dir/s.toml:1: foo: unknown key, expected format, include or a table",
                      "dir/s.toml:2: camera: not a table, expected [camera]",
                      "dir/s.toml:3: [bar]: unknown table, expected one of camera, tool",
                      "dir/s.toml:5: [baz]: unknown table, expected one of camera, tool"}));
}

TEST(SettingsDocument, TakesFormatOneOnly) {
  EXPECT_EQ(mistakes_in("format = 1\n"), Messages{});
  EXPECT_EQ(mistakes_in("format = 2\n"), Messages{"dir/s.toml:1: format: 2, expected 1"});
  EXPECT_EQ(mistakes_in("\nformat = \"1\"\n"),
            Messages{"dir/s.toml:2: format: not an integer, expected 1"});
}

TEST(SettingsDocument, TellsWhatIsNoToml) {
  EXPECT_EQ(mistakes_in(std::string("a = 1\n[\0]\n", 10)),
            Messages{"dir/s.toml:2: not TOML: a control character, expected text"});
  EXPECT_EQ(mistakes_in("a = f\n"), Messages{"dir/s.toml:1: not TOML: Error while parsing boolean: "
                                             "expected 'false', saw 'f\\n'"});
  // Inputs on which toml++ 3.3 as it comes ends a debug build, or relies on what is not so.
  for (const char* const text :
       {"\n[?]\n", "\na = ]\n", "\na = [1, 2\xC2\xB5]\n", "\n\xC3\xA9 = 1\n", "\na = [1, ]]\n",
        "\na = 1\na = 2\n", "\na = 1.\n"}) {
    const Messages messages = mistakes_in(text);
    ASSERT_EQ(messages.size(), 1u) << text;
    EXPECT_TRUE(messages[0].starts_with("dir/s.toml:2: not TOML: ") ||
                messages[0].starts_with("dir/s.toml:3: not TOML: "))
        << messages[0];
  }
}

}  // namespace
}  // namespace tubesight::drivers
