// What `replay` writes for machines, and where.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/made_video.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/csv_rows.h"
#include "tests/system/program.h"
#include "tests/system/tiny_replay.h"
#include "tests/system/tiny_session.h"

namespace tubesight::tests {
namespace {

using support::run_ffmpeg;
using support::TemporaryFolder;

/// A folder with a session and a recording that shows no tube-ends: the start is refused.
struct Tiny {
  Tiny() {
    folder.write("s.toml", tiny_session());
    folder.write("r.y4m", recording());
  }
  [[nodiscard]] ProgramRun replay(std::vector<std::string> more) const {
    more.insert(more.begin(), {"replay", "s.toml", "r.y4m"});
    return run_tubesight(folder, more);
  }
  TemporaryFolder folder;
};

TEST(ReplayOutputs, GoToStandardOutputAndTheSummaryThenToStandardError) {
  const Tiny tiny;
  ASSERT_EQ(tiny.replay({"--fields", "f.csv"}).status, 0);

  const ProgramRun run = tiny.replay({"--fields", "-"});

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, tiny.folder.read("f.csv"));
  EXPECT_TRUE(run.err.starts_with("r.y4m: 8 fields of 96 x 80 pixels")) << run.err;
  EXPECT_EQ(tiny.folder.names().size(), 3U);
}

TEST(ReplayOutputs, ShareStandardOutputWithNoOther) {
  const Tiny tiny;

  const ProgramRun run = tiny.replay({"--fields", "-", "--summary", "-"});

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "--summary: '-' is also --fields, expected a place of its own\n");
  EXPECT_EQ(run.out, "");
}

TEST(ReplayOutputs, NeedAName) {
  const Tiny tiny;
  for (const char* const option :
       {"--fields", "--centers", "--overlay", "--poses", "--pairs", "--replies", "--summary"}) {
    const ProgramRun run = tiny.replay({option, ""});

    EXPECT_EQ(run.status, 2) << option;
    EXPECT_NE(run.err.find(std::string(option) + ": its value is empty, expected "),
              std::string::npos)
        << run.err;
  }
}

TEST(ReplayOutputs, TellMachinesWhatTheSummaryTells) {
  const Tiny tiny;

  const ProgramRun run = tiny.replay({"--summary", "s.json", "-q"});

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out + run.err, "");
  const std::string json = tiny.folder.read("s.json");
  for (const char* const line :
       {"{\n  \"format\": 1,\n  \"recording\": \"r.y4m\",\n  \"width_px\": 96,\n",
        "  \"interlaced\": true,\n  \"cut_short\": false,\n  \"fields\": 8,\n",
        "  \"begin_s\": 0.000000,\n  \"end_s\": 0.160000,\n",
        "\"waiting\": {\"fields\": 8, \"time_s\": 0.160000}",
        "{\"at_s\": 0.000000, \"taken\": false, \"reason\": \"no-tube-there\"}",
        "  \"largest_speed_mm_s\": null,\n", "  \"visits\": []\n}\n"}) {
    EXPECT_NE(json.find(line), std::string::npos) << line << "\nin\n" << json;
  }
}

TEST(ReplayOutputs, HaveARowAnAnswer) {
  const Tiny tiny;
  tiny.folder.write("r.events.csv",
                    "field,time_s,kind,values\n2,,claim,\"40,60\"\n4,,pick,\"48,40\"\n");

  const ProgramRun run = tiny.replay({"--replies", "r.csv"});

  EXPECT_EQ(run.status, 0) << run.err;
  const auto rows = read_rows(tiny.folder.read("r.csv"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("kind"), "start");
  EXPECT_EQ(rows[0].at("verdict"), "refused");
  EXPECT_EQ(rows[0].at("reason"), "no-tube-there");
  EXPECT_EQ(rows[0].at("origin"), "operator");
  EXPECT_EQ(rows[1].at("kind"), "claim");
  EXPECT_EQ(rows[1].at("verdict"), "unknown");
  EXPECT_EQ(rows[1].at("claimed_row"), "40");
  EXPECT_EQ(rows[1].at("claimed_column"), "60");
  EXPECT_EQ(rows[1].at("row"), "");
  EXPECT_EQ(rows[2].at("kind"), "pick");
  EXPECT_EQ(rows[2].at("reason"), "not-tracking");
  EXPECT_EQ(rows[2].at("field"), "4");
}

TEST(ReplayOutputs, EndWithThreeWhereTrackingWasAskedForAndNeverStarted) {
  const Tiny tiny;

  const ProgramRun run = tiny.replay({"--must-track", "--fields", "f.csv"});

  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.err, "r.y4m: never started, expected a start that is taken, for --must-track\n");
  EXPECT_EQ(lines_of(tiny.folder.read("f.csv")), 9);  // all was written all the same
}

TEST(ReplayOverlay, IsEncodedByItsName) {
  const Tiny tiny;

  const ProgramRun run = tiny.replay({"--overlay", "o.mp4"});

  ASSERT_EQ(run.status, 0) << run.err;
  run_ffmpeg(tiny.folder, "-i o.mp4 -fps_mode passthrough -f yuv4mpegpipe -pix_fmt yuv420p o2.y4m");
  const std::string video = tiny.folder.read("o2.y4m");
  EXPECT_TRUE(video.starts_with("YUV4MPEG2 W96 ")) << video.substr(0, 60);
  EXPECT_NE(video.find(" F50:1 "), std::string::npos);
  std::size_t frames = 0;
  for (std::size_t at = 0; (at = video.find("FRAME\n", at)) != std::string::npos; ++at) {
    ++frames;
  }
  EXPECT_EQ(frames, 8U);
}

TEST(ReplayOverlay, IsAVideoWhateverTheCaseOfItsName) {
  const Tiny tiny;

  ASSERT_EQ(tiny.replay({"--overlay", "o.Y4M"}).status, 0);

  EXPECT_TRUE(tiny.folder.read("o.Y4M").starts_with("YUV4MPEG2 "));
}

TEST(ReplayOverlay, IsNoFolderWithTheNameOfAFile) {
  const Tiny tiny;
  for (const char* const name : {"o.png", "o.JPG", "o.avi", "o.csv", "o.y4m.xz"}) {
    const ProgramRun run = tiny.replay({"--overlay", name});

    EXPECT_EQ(run.status, 2) << name;
    EXPECT_EQ(run.err, std::string("--overlay: '") + name +
                           "' is named as a file of another kind, expected a folder for PNG "
                           "pictures, or a name that ends in .mp4, .mkv, .mov or .y4m\n");
  }
  const ProgramRun run = tiny.replay({"--overlay", "-"});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(tiny.folder.names().size(), 2U);
}

TEST(ReplayOverlay, GoesIntoAFolderWithADotAllTheSame) {
  const Tiny tiny;

  EXPECT_EQ(tiny.replay({"--overlay", "run.1"}).status, 0);
}

TEST(LookOverlay, IsPngOrRefused) {
  const Tiny tiny;

  const ProgramRun run = run_tubesight(tiny.folder, {"look", "r.y4m", "--overlay", "o.jpg"});

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "--overlay: 'o.jpg' is not named as a PNG picture, expected a name that ends in "
            ".png\n");
}

TEST(PoseOverlay, IsPngOrRefused) {
  const Tiny tiny;

  const ProgramRun run =
      run_tubesight(tiny.folder, {"pose", "s.toml", "r.y4m", "--overlay", "o.jpg"});

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "--overlay: 'o.jpg' is not named as a PNG picture, expected a name that ends in "
            ".png\n");
}

}  // namespace
}  // namespace tubesight::tests
