#include "board/bench/output/output_paths.h"

#include <array>
#include <filesystem>

#include <gtest/gtest.h>

#include "board/bench/pose/pose_options.h"
#include "board/bench/replay/replay_options.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

ReplayOptions reading(const support::TemporaryFolder& folder) {
  ReplayOptions options;
  options.session = folder.write("s.toml", "x");
  options.recording = folder.write("r.y4m", "x");
  return options;
}

TEST(OutputPaths, AcceptsPlacesOfTheirOwn) {
  const support::TemporaryFolder folder;
  ReplayOptions options = reading(folder);
  options.fields = folder.path("f.csv");
  options.centers = folder.path("c.csv");
  options.overlay = folder.path("pictures");

  EXPECT_EQ(find_output_conflict(options), "");
}

TEST(OutputPaths, RefusesTwoOutputsInOnePlaceHoweverItIsSpelt) {
  const support::TemporaryFolder folder;
  ReplayOptions options = reading(folder);
  options.fields = folder.path("o.csv");
  options.centers = folder.path("./o.csv");

  EXPECT_EQ(find_output_conflict(options),
            "--centers: '" + options.centers + "' is also --fields, expected a place of its own");
}

TEST(OutputPaths, RefusesEveryFileThatIsRead) {
  const support::TemporaryFolder folder;
  const ReplayOptions options = reading(folder);
  for (const char* const name : {"s.toml", "r.y4m", "r.meta.csv", "r.events.csv"}) {
    ReplayOptions spoilt = options;
    spoilt.fields = folder.path(name);

    EXPECT_NE(find_output_conflict(spoilt), "") << name;
  }
}

TEST(OutputPaths, SeesThroughLinks) {
  const support::TemporaryFolder folder;
  ReplayOptions options = reading(folder);
  std::filesystem::create_symlink(options.recording, folder.path("link.csv"));
  options.fields = folder.path("link.csv");

  EXPECT_NE(find_output_conflict(options), "");
}

TEST(OutputPaths, LetsDevicesBeShared) {
  const support::TemporaryFolder folder;
  ReplayOptions options = reading(folder);
  options.fields = "/dev/null";
  options.centers = "/dev/null";

  EXPECT_EQ(find_output_conflict(options), "");
}

TEST(OutputPaths, LetsOneOutputHaveStandardOutputWhateverIsRead) {
  const std::array inputs = {NamedPath{"the recording", "-"}};
  const std::array one = {NamedPath{"--fields", "-"}};
  const std::array two = {NamedPath{"--fields", "-"}, NamedPath{"--centers", "-"}};

  EXPECT_EQ(find_clash(inputs, one), "");
  EXPECT_EQ(find_clash(inputs, two),
            "--centers: '-' is also --fields, expected a place of its own");
}

TEST(OutputPaths, KnowsNamesOfFiles) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("a.png"));

  EXPECT_TRUE(is_named_as_file("o.JPG"));
  EXPECT_TRUE(is_named_as_file("b/o.y4m.xz"));
  EXPECT_FALSE(is_named_as_file("run.1"));
  EXPECT_FALSE(is_named_as_file("o.png/"));
  EXPECT_FALSE(is_named_as_file("png"));
  EXPECT_FALSE(is_named_as_file(folder.path("a.png")));  // a folder is there
  EXPECT_EQ(ending_of("a.b/C.Y4M.XZ"), ".y4m.xz");
}

TEST(OutputPaths, RefusesACompressedVideo) {
  ReplayOptions options;
  options.overlay = "o.y4m.xz";

  EXPECT_NE(
      find_output_conflict(options).find("expected a folder for PNG pictures, or a name that"),
      std::string::npos);
}

}  // namespace
}  // namespace tubesight::board
