// Videos that are none of ours, parts of a recording, and standard input.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/files/y4m_reader.h"
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

const std::string kFolder = std::string(TUBESIGHT_TEST_DATA_DIR) + "/recordings/square_flush/";
constexpr int kTaken = 12;  // frames

/// The first frames of the shipped recording.
std::string first_frames() {
  drivers::Y4mReader reader;
  EXPECT_TRUE(reader.open(kFolder + "recording.y4m.xz")) << reader.message();
  std::string text = "YUV4MPEG2 W635 H480 F30:1 It A1:1 Cmono\n";
  std::vector<std::uint8_t> luma(static_cast<std::size_t>(reader.header().luma_bytes()));
  for (int frame = 0; frame < kTaken; ++frame) {
    EXPECT_TRUE(reader.read_frame(luma));
    text += "FRAME\n";
    text.append(reinterpret_cast<const char*>(luma.data()), luma.size());
  }
  return text;
}

/// Replays by the shipped session; gives what stands in --fields.
std::string fields_of(const TemporaryFolder& folder, const std::string& recording,
                      const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"replay", kFolder + "session.toml", recording, "--fields",
                                        "f.csv"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramRun run = run_tubesight(folder, arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return folder.read("f.csv");
}

TEST(ReplayVideo, SeesInALosslessVideoWhatItSeesInTheRecording) {
  const TemporaryFolder folder;
  folder.write("r.y4m", first_frames());
  run_ffmpeg(folder, "-i r.y4m -c:v ffv1 r.mkv");

  const std::string expected = fields_of(folder, "r.y4m");

  EXPECT_EQ(fields_of(folder, "r.mkv"), expected);
  EXPECT_EQ(lines_of(expected), 1 + 2 * kTaken);
  EXPECT_NE(expected.find(",tracking,"), std::string::npos);
}

TEST(ReplayVideo, SeesInACompressedOneWhatItsOwnConversionShows) {
  const TemporaryFolder folder;
  folder.write("r.y4m", first_frames());
  run_ffmpeg(folder, "-i r.y4m -c:v libx264 -crf 18 -flags +ildct -x264opts tff=1 r.mp4");
  run_ffmpeg(folder, "-i r.mp4 -pix_fmt gray -strict -1 converted.y4m");

  EXPECT_EQ(fields_of(folder, "r.mp4"), fields_of(folder, "converted.y4m"));
}

TEST(ReplayVideo, NamesTheWayOutWhereTheScanFlagIsWrong) {
  const TemporaryFolder folder;
  folder.write("r.y4m", first_frames());
  run_ffmpeg(folder, "-i r.y4m -vf setfield=prog -c:v ffv1 r.mkv");

  const ProgramRun run = run_tubesight(folder, {"replay", kFolder + "session.toml", "r.mkv"});

  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "r.mkv: header says Ip (progressive), expected scan = \"even-first\" as [camera] of "
            "the settings says; where the recording's flag is what is wrong: --ignore-scan-flag\n");
  EXPECT_EQ(fields_of(folder, "r.mkv", {"--ignore-scan-flag"}), fields_of(folder, "r.y4m"));
}

TEST(ReplayVideo, SaysInOneLineWhatIsWrong) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.mp4", "no video");

  expect_refused(folder, "r.mp4",
                 "r.mp4: cannot be read: ffmpeg: Invalid data found when processing input");
}

TEST(ReplayVideo, ReadsStandardInput) {
  const TemporaryFolder folder;
  folder.write("r.y4m", first_frames());
  const std::string expected = fields_of(folder, "r.y4m");

  const ProgramRun run = run_tubesight(
      folder, {"replay", kFolder + "session.toml", "-", "--fields", "f.csv"}, "r.y4m");

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(folder.read("f.csv"), expected);
  EXPECT_TRUE(run.out.starts_with("standard input: 24 fields of 635 x 480 pixels"));
}

TEST(ReplayVideo, GivesPartOfARecordingItsOwnNumbersAndTimes) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());  // 4 frames, 25 a second

  const ProgramRun run = run_tubesight(
      folder, {"replay", "s.toml", "r.y4m", "--fields", "f.csv", "--from", "0.04", "--to", "0.10"});

  ASSERT_EQ(run.status, 0) << run.err;
  const auto rows = read_rows(folder.read("f.csv"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].at("field"), "2");
  EXPECT_EQ(rows[0].at("time_s"), "0.040000");
  EXPECT_EQ(rows[3].at("field"), "5");
  EXPECT_EQ(run.err,
            "s.toml: start: taken to be clicked in the first field from --from on, and earlier "
            "events are left out\n");
}

TEST(ReplayVideo, LeavesEventsBeforeThePartOut) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());
  folder.write("r.events.csv",
               "field,time_s,kind,values\n1,,claim,\"40,60\"\n3,,claim,\"41,60\"\n");

  const ProgramRun run =
      run_tubesight(folder, {"replay", "s.toml", "r.y4m", "--replies", "r.csv", "--from", "0.04"});

  ASSERT_EQ(run.status, 0) << run.err;
  int claims = 0;
  for (const auto& row : read_rows(folder.read("r.csv"))) {
    if (row.at("kind") == "claim") {
      ++claims;
      EXPECT_EQ(row.at("claimed_row"), "41");
      EXPECT_EQ(row.at("verdict"), "unknown");
    }
  }
  EXPECT_EQ(claims, 1);
}

TEST(ReplayVideo, TakesEveryNthFrameAtItsOwnTime) {
  const TemporaryFolder folder;
  std::string session = tiny_session() + "[motion]\nmax_speed_mm_s = 20\n";
  folder.write("s.toml", session);
  folder.write("r.y4m", recording());

  const ProgramRun run =
      run_tubesight(folder, {"replay", "s.toml", "r.y4m", "--fields", "f.csv", "--every", "3"});

  ASSERT_EQ(run.status, 0) << run.err;
  const auto rows = read_rows(folder.read("f.csv"));
  ASSERT_EQ(rows.size(), 2U);  // the earlier fields of frames 0 and 3
  EXPECT_EQ(rows[1].at("field"), "6");
  EXPECT_EQ(rows[1].at("time_s"), "0.120000");
  EXPECT_EQ(rows[1].at("parity"), "even");
}

TEST(ReplayVideo, SaysWhenFramesLeftOutAreTooManyForTheMotion) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());

  const ProgramRun run = run_tubesight(folder, {"replay", "s.toml", "r.y4m", "--every", "3"});

  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("8.333 fields a second are too few"), std::string::npos) << run.err;
}

TEST(ReplayVideo, RefusesAPartThatHasNoField) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());

  const ProgramRun after =
      run_tubesight(folder, {"replay", "s.toml", "r.y4m", "--from", "9", "--fields", "f.csv"});
  const ProgramRun swapped =
      run_tubesight(folder, {"replay", "s.toml", "r.y4m", "--from", "3", "--to", "1"});

  EXPECT_EQ(after.status, 2);
  EXPECT_NE(after.err.find("r.y4m: has no field there, expected some from --from to --to\n"),
            std::string::npos);
  EXPECT_EQ(swapped.status, 2);
  EXPECT_EQ(swapped.err, "--from: is after --to, expected it before\n");
  EXPECT_EQ(folder.names().size(), 2U);
}

TEST(ReplayVideo, TellsHowTheRecordingIsReadWhenAsked) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());

  const ProgramRun run = run_tubesight(folder, {"replay", "s.toml", "r.y4m", "-v"});

  EXPECT_EQ(
      run.err,
      "s.toml: read\nr.y4m: 96 x 80 pixels, 8 bits, even lines first, 25.000 frames a second, "
      "read by itself, taken as interlaced, no meta file, 0 events\n");
}

TEST(ReplayVideo, EndsWithThreeWhereTrackingWasAskedForAndLost) {
  const TemporaryFolder folder;
  std::string video = first_frames();
  for (int frame = 0; frame < 2 * kTaken; ++frame) {  // the lamp goes out
    video += "FRAME\n" + std::string(std::size_t{635} * 480, '\x10');
  }
  folder.write("r.y4m", video);
  const std::vector<std::string> replay = {
      "replay", kFolder + "session.toml", "r.y4m", "--fields", "f.csv", "--must-track"};

  const ProgramRun run = run_tubesight(folder, replay);

  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_TRUE(run.err.starts_with("r.y4m: lost at ")) << run.err;
  EXPECT_TRUE(run.err.ends_with(", expected to be tracked to its end, for --must-track\n"))
      << run.err;
  const std::string fields = folder.read("f.csv");  // all was written all the same
  EXPECT_EQ(lines_of(fields), 1 + 6 * kTaken);
  EXPECT_NE(fields.find(",tracking,"), std::string::npos);
  EXPECT_NE(fields.find(",lost,"), std::string::npos);
  folder.write("r.y4m", first_frames());
  EXPECT_EQ(run_tubesight(folder, replay).status, 0);
}

/// Clicks into the shipped recording's first frame.
const std::string kClicks = kFolder + "session.toml";

TEST(PoseVideo, NamesTheWayOutWhereTheScanFlagIsWrong) {
  const TemporaryFolder folder;
  folder.write("r.y4m", first_frames());
  run_ffmpeg(folder, "-i r.y4m -vf setfield=prog -c:v ffv1 r.mkv");
  const auto pose = [&](const std::string& recording, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"pose", kClicks, recording, "--csv", "p.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tubesight(folder, arguments);
  };
  const std::string said =
      "r.mkv: header says Ip (progressive), expected scan = \"even-first\" as [camera] of the "
      "settings says; where the recording's flag is what is wrong: --ignore-scan-flag\n";

  // The first frame, and one that is tracked to.
  for (const char* const frame : {"0", "5"}) {
    const ProgramRun refused = pose("r.mkv", {"--frames", frame});
    EXPECT_EQ(refused.status, 2) << frame;
    EXPECT_EQ(refused.err, said) << frame;
    const int status = pose("r.y4m", {"--frames", frame}).status;
    const ProgramRun taken = pose("r.mkv", {"--frames", frame, "--ignore-scan-flag"});
    EXPECT_EQ(taken.status, status) << taken.err;
    EXPECT_EQ(taken.err.find("header says"), std::string::npos) << taken.err;
  }
}

TEST(CalibrateVideo, TakesTheScanFlagForWrongWhenTold) {
  const TemporaryFolder folder;
  folder.write("r.y4m", first_frames());
  run_ffmpeg(folder, "-i r.y4m -vf setfield=prog -c:v ffv1 r.mkv");
  const std::vector<std::string> tool = {"calibrate", "tool", kClicks, "--dock", "40,60", "r.mkv"};

  const ProgramRun refused = run_tubesight(folder, tool);
  std::vector<std::string> more = tool;
  more.push_back("--ignore-scan-flag");
  const ProgramRun taken = run_tubesight(folder, more);

  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--ignore-scan-flag"), std::string::npos) << refused.err;
  EXPECT_EQ(taken.err.find("header says"), std::string::npos) << taken.err;
  const ProgramRun misplaced =
      run_tubesight(folder, {"calibrate", "base", "b.csv", "--ignore-scan-flag"});
  EXPECT_EQ(misplaced.err,
            "--ignore-scan-flag: of a camera or a tool alone, expected one of these\n");
}

TEST(Look, ReadsStillsOfOtherKinds) {
  const TemporaryFolder folder;
  folder.write("r.y4m", first_frames());
  run_ffmpeg(folder, "-i r.y4m -frames:v 1 p.png");
  const ProgramRun expected = run_tubesight(folder, {"look", "p.png", "--csv", "expected.csv"});
  ASSERT_EQ(expected.status, 0) << expected.err;
  for (const char* const kind : {"p.tiff", "-pix_fmt gray16be deep.png"}) {
    SCOPED_TRACE(kind);
    run_ffmpeg(folder, std::string("-i p.png ") + kind);
    const std::string name = std::string(kind).substr(std::string(kind).rfind(' ') + 1);

    const ProgramRun run = run_tubesight(folder, {"look", name, "--csv", "l.csv"});

    EXPECT_EQ(run.status, 0) << run.err;
    std::string rows = folder.read("l.csv");
    for (std::size_t at = 0; (at = rows.find(name, at)) != std::string::npos; at += 5) {
      rows.replace(at, name.size(), "p.png");
    }
    EXPECT_EQ(rows, folder.read("expected.csv"));
  }
  // Of these the values are rounded on the way.
  run_ffmpeg(folder, "-i p.png -q:v 2 p.jpg");
  run_ffmpeg(folder, "-i p.png p.bmp");
  EXPECT_EQ(run_tubesight(folder, {"look", "p.jpg"}).status, 0);
  EXPECT_EQ(run_tubesight(folder, {"look", "p.bmp"}).status, 0);
}

}  // namespace
}  // namespace tubesight::tests
