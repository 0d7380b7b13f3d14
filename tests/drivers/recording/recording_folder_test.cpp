#include "drivers/recording/recording_folder.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using hal::RecordingReason;
using support::TemporaryFolder;

constexpr std::int64_t kNight_s = 1'796'000'467;  // 2026-11-30 01:01:07 UTC

std::vector<std::string> sorted_names(const TemporaryFolder& folder) {
  std::vector<std::string> names = folder.names();
  std::sort(names.begin(), names.end());
  return names;
}

std::string name_of(int number, const char* reason = "command") {
  return "box-00000" + std::to_string(number) + "-20261130T010107Z-" + reason;
}

/// A recording of 100 bytes.
void put(const TemporaryFolder& folder, const std::string& name) {
  for (const std::string_view ending : RecordingFolder::kEndings) {
    folder.write(name + std::string(ending), std::string(20, 'x'));
  }
}

TEST(RecordingFolder, NamesByNumberTimeAndReason) {
  const TemporaryFolder folder;
  put(folder, name_of(7));
  RecordingFolder recordings(folder.path("."), 1000);
  ASSERT_TRUE(recordings.open());
  EXPECT_EQ(recordings.next_path(kNight_s, RecordingReason::kTrackLost),
            folder.path("./") + name_of(8, "track-lost"));
  EXPECT_EQ(recordings.next_path(0, RecordingReason::kDisagreement),
            folder.path("./box-000009-19700101T000000Z-disagreement"));
}

TEST(RecordingFolder, RemovesTheOldestOfItsOwnAndNothingElse) {
  const TemporaryFolder folder;
  put(folder, name_of(1));
  put(folder, name_of(2, "disagreement"));
  put(folder, name_of(3));
  folder.write("notes.txt", std::string(5000, 'x'));
  folder.write("box-000000-somebody.y4m", "x");
  folder.write(name_of(0) + ".mp4", "x");
  RecordingFolder recordings(folder.path("."), 300);
  ASSERT_TRUE(recordings.open());
  ASSERT_TRUE(recordings.make_room(0));
  EXPECT_EQ(folder.names().size(), 18U);
  ASSERT_TRUE(recordings.make_room(150));

  const auto names = sorted_names(folder);
  EXPECT_EQ(names,
            (std::vector<std::string>{"box-000000-20261130T010107Z-command.mp4",
                                      "box-000000-somebody.y4m", name_of(3) + ".events.csv",
                                      name_of(3) + ".meta.csv", name_of(3) + ".session.toml",
                                      name_of(3) + ".state", name_of(3) + ".y4m", "notes.txt"}));
}

TEST(RecordingFolder, RefusesWhatNeverFits) {
  const TemporaryFolder folder;
  put(folder, name_of(1));
  RecordingFolder recordings(folder.path("."), 300);
  ASSERT_TRUE(recordings.open());
  EXPECT_EQ(recordings.make_room(301).error(), core::Error::kOutOfRange);
  EXPECT_NE(recordings.message().find("301 bytes"), std::string::npos);
  EXPECT_EQ(folder.names().size(), 5U) << "nothing was removed for it";
}

TEST(RecordingFolder, OldOnesGoWhereTheDiskIsFullBeforeTheBoundIsReached) {
  const TemporaryFolder folder;
  put(folder, name_of(1));
  put(folder, name_of(2));
  std::int64_t free = 30;
  RecordingFolder recordings(folder.path("."), 1000, [&free](const std::string&) { return free; });
  ASSERT_TRUE(recordings.open());
  EXPECT_EQ(*recordings.room(), 230);
  ASSERT_TRUE(recordings.make_room(130));
  const auto names = sorted_names(folder);
  ASSERT_EQ(names.size(), 5U);
  EXPECT_TRUE(names[0].starts_with(name_of(2)));

  EXPECT_EQ(recordings.make_room(131).error(), core::Error::kIo);
  EXPECT_NE(recordings.message().find("the disk is full, expected room for 131 bytes"),
            std::string::npos);
  EXPECT_EQ(folder.names().size(), 5U) << "nothing was removed for it";
  free = 2000;
  EXPECT_EQ(*recordings.room(), 1000) << "the bound";
}

TEST(RecordingFolder, RemovesRemainsWhenOpened) {
  const TemporaryFolder folder;
  put(folder, name_of(1));
  folder.write(name_of(2) + ".y4m.321-0.part", "x");
  folder.write(name_of(2) + ".meta.csv.321-0.part", "x");
  folder.write(name_of(3) + ".meta.csv", "x");  // its picture was never put in its place
  folder.write(name_of(3) + ".state", "x");
  folder.write("other.y4m.321-0.part", "x");
  RecordingFolder recordings(folder.path("."), 300);
  ASSERT_TRUE(recordings.open());

  const auto names = sorted_names(folder);
  ASSERT_EQ(names.size(), 6U);
  EXPECT_EQ(names[5], "other.y4m.321-0.part");
  EXPECT_TRUE(names[0].starts_with(name_of(1)) && names[4].starts_with(name_of(1)));
}

TEST(RecordingFolder, ASecondBoxRemovesNothingOfTheFirstAndGetsItWhenThatIsGone) {
  const TemporaryFolder folder;
  RecordingFolder second(folder.path("."), 300);
  {
    RecordingFolder first(folder.path("x/.."), 300);
    std::filesystem::create_directory(folder.path("x"));
    ASSERT_TRUE(first.open());
    ASSERT_TRUE(first.open()) << "its own claim is not in its way";
    folder.write(name_of(1) + ".meta.csv", "x");
    folder.write(name_of(1) + ".y4m.321-0.part", "x");

    EXPECT_EQ(second.open().error(), core::Error::kNotReady);
    EXPECT_EQ(second.message(), folder.path(".") + ": another box records there");
    EXPECT_EQ(
        sorted_names(folder),
        (std::vector<std::string>{name_of(1) + ".meta.csv", name_of(1) + ".y4m.321-0.part", "x"}));
  }
  EXPECT_TRUE(second.open()) << second.message();
  EXPECT_EQ(folder.names(), std::vector<std::string>{"x"}) << "remains, now";
}

TEST(RecordingFolder, TellsThatItIsNotThere) {
  const TemporaryFolder folder;
  RecordingFolder recordings(folder.path("nowhere"), 300);
  EXPECT_EQ(recordings.open().error(), core::Error::kIo);
  EXPECT_TRUE(recordings.message().starts_with(folder.path("nowhere") + ": cannot be read: "));
}

}  // namespace
}  // namespace tubesight::drivers
