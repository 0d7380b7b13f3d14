#include "drivers/replay/companion.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

TEST(CompanionPath, ReplacesTheEndingsOfRecordings) {
  EXPECT_EQ(companion_path("a/b.y4m", ".meta.csv"), "a/b.meta.csv");
  EXPECT_EQ(companion_path("a/b.y4m.xz", ".meta.csv"), "a/b.meta.csv");
  EXPECT_EQ(companion_path("a/b.c.y4m.xz", ".events.csv"), "a/b.c.events.csv");
  EXPECT_EQ(companion_path("a/b.video", ".events.csv"), "a/b.video.events.csv");
}

TEST(ReadCompanion, TellsAbsentFromUnreadable) {
  const support::TemporaryFolder folder;
  std::string text;
  Messages messages;

  const auto absent = read_companion(folder.path("a.csv"), text, messages);
  ASSERT_TRUE(absent);
  EXPECT_FALSE(*absent);
  const auto present = read_companion(folder.write("b.csv", "x"), text, messages);
  ASSERT_TRUE(present);
  EXPECT_TRUE(*present);
  EXPECT_EQ(text, "x");
  EXPECT_EQ(messages, Messages{});
  const auto broken = read_companion(folder.path(""), text, messages);
  ASSERT_FALSE(broken);
  EXPECT_EQ(messages, Messages{folder.path("") + ": cannot be read: Is a directory"});
}

}  // namespace
}  // namespace tubesight::drivers
