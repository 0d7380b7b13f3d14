#include "board/bench/output/picture_folder.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/files/picture_reader.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

namespace fs = std::filesystem;

/// Two pixels, black and white.
struct TwoPixels {
  std::vector<std::uint8_t> bytes = {0, 0, 0, 255, 255, 255};
  core::RgbImageView view() { return {bytes.data(), 2, 1, 6}; }
};

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(PictureFolder, HoldsOnePictureAFieldOnceCommitted) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path("deep/pictures");
  TwoPixels picture;
  {
    PictureFolder sink(out);
    ASSERT_TRUE(sink.open({}, true));
    ASSERT_TRUE(sink.add(0, picture.view()));
    ASSERT_TRUE(sink.add(123, picture.view()));
    ASSERT_TRUE(sink.commit());
  }

  EXPECT_EQ(names_in(out), (std::vector<std::string>{"field-000000.png", "field-000123.png"}));
  drivers::GreyPicture read;
  std::string message;
  ASSERT_TRUE(drivers::read_grey_picture(out + "/field-000123.png", read, message)) << message;
  EXPECT_EQ(read.width_px, 2);
  EXPECT_EQ(read.pixels, (std::vector<std::uint8_t>{0, 255}));
}

TEST(PictureFolder, LeavesNothingWithoutCommit) {
  const support::TemporaryFolder folder;
  TwoPixels picture;
  {
    PictureFolder sink(folder.path("pictures"));
    ASSERT_TRUE(sink.open({}, true));
    ASSERT_TRUE(sink.add(0, picture.view()));
  }

  EXPECT_TRUE(folder.names().empty());
}

TEST(PictureFolder, ReplacesThePicturesOfAnEarlierReplayAndNothingElse) {
  const support::TemporaryFolder folder;
  fs::create_directory(folder.path("pictures"));
  folder.write("pictures/field-000007.png", "old");
  folder.write("pictures/field-7.png", "somebody's");
  folder.write("pictures/notes.txt", "mine");
  TwoPixels picture;
  PictureFolder sink(folder.path("pictures"));
  ASSERT_TRUE(sink.open({}, true));
  ASSERT_TRUE(sink.add(2, picture.view()));

  ASSERT_TRUE(sink.commit());

  EXPECT_EQ(names_in(folder.path("pictures")),
            (std::vector<std::string>{"field-000002.png", "field-7.png", "notes.txt"}));
}

TEST(PictureFolder, KeepsThePicturesOfAnEarlierReplayWithoutCommit) {
  const support::TemporaryFolder folder;
  fs::create_directory(folder.path("pictures"));
  folder.write("pictures/field-000007.png", "old");
  TwoPixels picture;
  {
    PictureFolder sink(folder.path("pictures"));
    ASSERT_TRUE(sink.open({}, true));
    ASSERT_TRUE(sink.add(2, picture.view()));
  }

  EXPECT_EQ(names_in(folder.path("pictures")), (std::vector<std::string>{"field-000007.png"}));
}

TEST(PictureFolder, SaysThatAFileStandsInItsPlace) {
  const support::TemporaryFolder folder;
  const std::string out = folder.write("pictures", "a file");
  PictureFolder sink(out);

  const auto opened = sink.open({}, true);

  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error(), core::Error::kIo);
  EXPECT_TRUE(sink.message().starts_with(out + ": cannot be made a folder: ")) << sink.message();
  EXPECT_EQ(folder.read("pictures"), "a file");
}

}  // namespace
}  // namespace tubesight::board
