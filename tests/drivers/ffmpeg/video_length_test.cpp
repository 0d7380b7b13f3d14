#include "drivers/ffmpeg/video_length.h"

#include <gtest/gtest.h>

#include "tests/support/environment_variable.h"
#include "tests/support/made_video.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

TEST(VideoLength, IsWhatTheContainerSays) {
  const support::TemporaryFolder folder;
  support::run_ffmpeg(folder, "-f lavfi -i testsrc=size=64x48:rate=25 -t 3.2 v.mp4");

  const auto length_s = video_length_s(folder.path("v.mp4"));

  ASSERT_TRUE(length_s);
  EXPECT_NEAR(*length_s, 3.2, 1e-3);
}

TEST(VideoLength, IsNotKnownOfWhatIsNoVideo) {
  const support::TemporaryFolder folder;
  folder.write("v.mp4", "no video");

  EXPECT_FALSE(video_length_s(folder.path("v.mp4")));
  EXPECT_FALSE(video_length_s(folder.path("none.mp4")));
}

TEST(VideoLength, IsNotKnownWithoutTheProgram) {
  const support::TemporaryFolder folder;
  support::run_ffmpeg(folder, "-f lavfi -i testsrc=size=64x48:rate=25 -t 1 v.mp4");
  const support::EnvironmentVariable path("PATH", folder.path("").c_str());

  EXPECT_FALSE(video_length_s(folder.path("v.mp4")));
}

}  // namespace
}  // namespace tubesight::drivers
