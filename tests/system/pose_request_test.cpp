// Pose requests of the robot in a replay.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/files/picture_reader.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/pose_stills.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

/// Replays eight frames of the still with these events.
ProgramRun replay_with(const TemporaryFolder& folder, const std::string& events,
                       const std::vector<std::string>& further = {}) {
  drivers::GreyPicture still;
  std::string message;
  EXPECT_TRUE(drivers::read_grey_picture(kSquare + "still-0-0.png", still, message).has_value());
  const std::string frame = "FRAME\n" + std::string(still.pixels.begin(), still.pixels.end());
  std::string recording = "YUV4MPEG2 W635 H480 F30:1 It Cmono\n";
  for (int i = 0; i < 8; ++i) {
    recording += frame;
  }
  folder.write("r.y4m", recording);
  folder.write("r.events.csv", "field,time_s,kind,values\n" + events);
  std::vector<std::string> all = {"replay", kSquare + "session.toml", "r.y4m", "--poses", "p.csv"};
  all.insert(all.end(), further.begin(), further.end());
  return run_tubesight(folder, all);
}

TEST(PoseRequests, OfAReplayAreAnsweredFromTheFieldsAfterThem) {
  const TemporaryFolder folder;

  const ProgramRun run = replay_with(folder, "2,,pose,\n4,,pose,\n");

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("pose at 0.067 s refused: busy: "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("mm off row 7 column 41\n"), std::string::npos) << run.out;
  EXPECT_EQ(Row(folder.path("p.csv"), 0).text("image"), "r.y4m:2");
  expect_right(folder.path("p.csv"), kSquare, 0.010, 0.010, 0.010);
}

TEST(PoseRequests, WithWhichTheRobotToldItsPoseBecomePairs) {
  const TemporaryFolder folder;

  const ProgramRun run = replay_with(folder, "1,,pose,\"1.5,-2,3,10,0,0\"\n", {"--pairs", "b.csv"});

  ASSERT_EQ(run.status, 0) << run.err;
  const std::string text = folder.read("b.csv");
  const Row pose(folder.path("p.csv"), 0);
  EXPECT_NE(text.find(",use\np1,1.5000,-2.0000,3.0000,10.00000,0.00000,0.00000," +
                      pose.text("tool_x_mm") + "," + pose.text("tool_y_mm") + "," +
                      pose.text("tool_z_mm") + "," + pose.text("tool_alpha_deg") + ","),
            std::string::npos)
      << text;
  // One place alone is no base, but it is read.
  const ProgramRun base = run_tubesight(folder, {"calibrate", "base", "b.csv"});
  EXPECT_NE(base.err.find("fewer than three pairs"), std::string::npos) << base.err;

  EXPECT_EQ(replay_with(folder, "1,,pose,\n", {"--pairs", "none.csv"}).status, 0);
  EXPECT_TRUE(folder.read("none.csv").starts_with("name,robot_x_mm,")) << "no row";
  EXPECT_EQ(replay_with(folder, "1,,pose,\n", {"--pairs", "p.csv"}).status, 2) << "twice";
}

TEST(PoseRequests, OfAMovingToolAreRefused) {
  const TemporaryFolder folder;
  const std::string recording = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/";
  folder.write("r.y4m.xz", text_of(recording + "recording.y4m.xz"));
  folder.write("r.events.csv", "field,time_s,kind,values\n20,,pose,\n");

  const ProgramRun run = run_tubesight(folder, {"replay", recording + "session.toml", "r.y4m.xz"});

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("refused: moving: the tool moves"), std::string::npos) << run.out;
}

TEST(PoseRequests, WhoseResultsAreRecordedAreNotComputedAgain) {
  const TemporaryFolder folder;

  const ProgramRun run = replay_with(folder, "2,,pose,\n6,,pose-result,weak\n");

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("refused: weak: "), std::string::npos) << run.out;
  EXPECT_EQ(folder.read("p.csv").find('\n'), folder.read("p.csv").size() - 1);
}

TEST(PoseRequests, ThatTheRecordingsEndCutsOffAreTold) {
  const TemporaryFolder folder;

  const ProgramRun run = replay_with(folder, "14,,pose,\n");

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err,
            "r.y4m: the pose request before field 14 got no answer: the recording ended before "
            "it was ready\n");
}

}  // namespace
}  // namespace tubesight::tests
