// What the program says and leaves when a recording or a file beside it is wrong.

#include <string>

#include <gtest/gtest.h>

#include "tests/support/recording_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"
#include "tests/system/tiny_replay.h"
#include "tests/system/tiny_session.h"

namespace tubesight::tests {
namespace {

using support::compress_xz;
using support::TemporaryFolder;

TEST(Replay, TakesTheTinyRecordingThatTheOtherTestsSpoil) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());

  const ProgramRun run = replay(folder, "r.y4m");

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(lines_of(folder.read("f.csv")), 1 + 2 * kFrames);
  EXPECT_EQ(folder.read("c.csv"), "field,row,column,u_px,v_px,quality\n");
  EXPECT_EQ(folder.names().size(), 5U);
}

TEST(Replay, UsesTheWholeFramesOfACutRecordingAndSaysSo) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  const std::string whole = recording();
  folder.write("r.y4m", whole.substr(0, whole.size() - 100));

  const ProgramRun run = replay(folder, "r.y4m");

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "r.y4m: cut short: only its first 3 frames are complete\n");
  EXPECT_EQ(lines_of(folder.read("f.csv")), 1 + 2 * 3);
  EXPECT_NE(run.out.find("6 fields"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("(cut short)"), std::string::npos) << run.out;
}

TEST(Replay, UsesTheWholeFramesBeforeAGarbageTailAndSaysSo) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording() + std::string(4096, '\0'));
  folder.write("x.y4m.xz", compress_xz(recording() + "\n"));

  const ProgramRun plain = replay(folder, "r.y4m");
  const std::string fields = folder.read("f.csv");
  const ProgramRun compressed = replay(folder, "x.y4m.xz");

  EXPECT_EQ(plain.status, 0);
  EXPECT_EQ(plain.err,
            "r.y4m: cut short: only its first 4 frames are complete, the 4096 bytes behind them "
            "are no frame\n");
  EXPECT_EQ(lines_of(fields), 1 + 2 * kFrames);
  EXPECT_NE(plain.out.find("(cut short)"), std::string::npos) << plain.out;
  EXPECT_EQ(compressed.status, 0);
  EXPECT_EQ(compressed.err,
            "x.y4m.xz: cut short: only its first 4 frames are complete, the 1 byte behind them is "
            "no frame\n");
  EXPECT_EQ(folder.read("f.csv"), fields);
}

TEST(Replay, SaysWhatIsWrongWithAHeader) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("crlf.y4m", recording(std::string(kTinyHeader) + "\r"));
  folder.write("mono.y4m", recording("YUV4MPEG2 W96 H80 F25:1 It C420jpeg"));

  expect_refused(folder, "crlf.y4m",
                 "crlf.y4m: damaged by a transfer in text mode: a line ends in CR LF, expected LF "
                 "alone");
  expect_refused(folder, "mono.y4m",
                 "mono.y4m: header parameter C is wrong: it says C420, but a FRAME line stands "
                 "where chroma should be, as in Cmono");
}

TEST(Replay, UsesTheWholeFramesOfACutCompressedRecording) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  const std::string whole = compress_xz(recording());
  // Of the end only what says that it is whole is cut away.
  folder.write("r.y4m.xz", whole.substr(0, whole.size() - 20));

  const ProgramRun run = replay(folder, "r.y4m.xz");

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "r.y4m.xz: cut short: only its first 4 frames are complete\n");
  EXPECT_EQ(lines_of(folder.read("f.csv")), 1 + 2 * kFrames);
}

TEST(Replay, RefusesARecordingWithoutAWholeFrame) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording().substr(0, 1000));

  expect_refused(folder, "r.y4m", "r.y4m: cut short within its first frame");
}

TEST(Replay, RefusesARecordingThatIsNotThere) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());

  expect_refused(folder, "r.y4m", "r.y4m: cannot be read: No such file or directory");
}

TEST(Replay, RefusesWhatIsNoRecording) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", "RIFF and so on\n");

  expect_refused(folder, "r.y4m",
                 "r.y4m: not a YUV4MPEG2 file: expected the first line to begin with "
                 "'YUV4MPEG2 '");
}

TEST(Replay, RefusesARecordingOfAnotherSize) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording("YUV4MPEG2 W80 H96 F25:1 It Cmono"));

  expect_refused(folder, "r.y4m",
                 "r.y4m: 80 x 96 pixels, expected 96 x 80 as [camera] of the settings says");
}

TEST(Replay, RefusesHeaderAndSettingsAtOdds) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording("YUV4MPEG2 W96 H80 F25:1 Ib Cmono"));

  expect_refused(folder, "r.y4m",
                 "r.y4m: header says Ib (odd lines first), expected scan = \"even-first\" as "
                 "[camera] of the settings says; where the recording's flag is what is wrong: "
                 "--ignore-scan-flag");
}

TEST(Replay, TakesTheLumaOfAColourRecording) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("grey.y4m", recording());
  folder.write("colour.y4m", recording("YUV4MPEG2 W96 H80 F25:1 It C420jpeg", 2 * 48 * 40));

  const ProgramRun grey =
      run_tubesight(folder, {"replay", "s.toml", "grey.y4m", "--overlay", "grey-overlay.y4m"});
  const ProgramRun colour =
      run_tubesight(folder, {"replay", "s.toml", "colour.y4m", "--overlay", "colour-overlay.y4m"});

  EXPECT_EQ(grey.status, 0);
  EXPECT_EQ(colour.status, 0);
  EXPECT_EQ(folder.read("colour-overlay.y4m"), folder.read("grey-overlay.y4m"));
}

TEST(Replay, RefusesCompressedDataThatIsCorruptAtItsBeginning) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  std::string bytes = compress_xz(recording());
  bytes[8] = static_cast<char>(bytes[8] ^ 1);  // the check sum of the stream's header
  folder.write("r.y4m.xz", bytes);

  expect_refused(folder, "r.y4m.xz", "r.y4m.xz: cannot be read: the xz data is corrupt");
}

TEST(Replay, LeavesNoOutputWhenCompressedDataProvesCorruptAtItsEnd) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  std::string bytes = compress_xz(recording());
  // The check sum of all the data stands before the index and the 12 bytes at the very end.
  const std::size_t at = bytes.size() - 12 - 8 - 4;
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  folder.write("r.y4m.xz", bytes);

  expect_refused(folder, "r.y4m.xz",
                 "r.y4m.xz: cannot be read after 4 frames: the xz data is corrupt");
}

TEST(Replay, RefusesGarbageBetweenFrames) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  std::string bytes = recording();
  const std::size_t third = std::string(kTinyHeader).size() + 1 + 2 * (6 + kTinyFrameBytes);
  folder.write("r.y4m", bytes.replace(third, 5, "FRAUD"));

  expect_refused(folder, "r.y4m",
                 "r.y4m: corrupt after 2 frames: expected a line that begins with 'FRAME'");
}

TEST(Replay, RefusesAnEventOfUnknownKind) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());
  folder.write("r.events.csv", "field,time_s,kind,values\n2,,shout,\n");

  expect_refused(folder, "r.y4m",
                 "r.events.csv:2: kind: 'shout', expected claim, start, lamp, pose, pick, "
                 "acknowledge or pose-result");
}

TEST(Replay, RefusesAMetaFileWithoutARowForAField) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());
  folder.write("r.meta.csv",
               "field,sequence,time_s,status,lamp_permille\n0,0,0.00,good,\n1,1,0.02,good,\n");

  expect_refused(folder, "r.y4m",
                 "r.meta.csv: no row for field 2, expected one for each field of r.y4m");
}

TEST(Replay, RefusesAMetaFileWithThousandsSeparators) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());
  folder.write(
      "r.meta.csv",
      "field,sequence,time_s,status,lamp_permille\n0,0,0.00,good,1,000\n1,1,0.02,good,5\n");

  expect_refused(folder, "r.y4m", "r.meta.csv:2: 6 cells, expected 5");
}

TEST(Replay, SaysWhichEventsCameAfterTheEnd) {
  const TemporaryFolder folder;
  folder.write("s.toml", tiny_session());
  folder.write("r.y4m", recording());
  folder.write("r.events.csv", "field,time_s,kind,values\n7,,claim,\"40,60\"\n8,,claim,\"4,6\"\n");

  const ProgramRun run = replay(folder, "r.y4m");

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err,
            "r.events.csv: the last 1 of 2 events are after the recording's end and were left "
            "out\n");
  EXPECT_NE(run.out.find("claims: 1, 0 confirmed, 0 contradicted, 1 unknown"), std::string::npos)
      << run.out;
}

}  // namespace
}  // namespace tubesight::tests
