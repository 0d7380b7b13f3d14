#include "drivers/replay/replay_frame_grabber.h"

#include <gtest/gtest.h>

#include "tests/hal/frame_grabber_contract.h"
#include "tests/support/recording_text.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Parity;
using core::Scan;
using support::recording_text;
using support::TemporaryFolder;

constexpr std::chrono::milliseconds kTimeout{0};
constexpr const char* kHeader = "YUV4MPEG2 W4 H3 F25:1 It Cmono";

core::CameraSettings camera_of(std::int32_t width_px, std::int32_t height_px, Scan scan) {
  core::CameraSettings camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.scan = scan;
  return camera;
}

/// Starts on a recording that is refused; gives the messages.
Messages refused(const std::string& path, const core::CameraSettings& camera, Error error) {
  ReplayFrameGrabber grabber(camera, path);
  const auto started = grabber.start();
  EXPECT_FALSE(started);
  if (!started) {
    EXPECT_EQ(started.error(), error);
  }
  return grabber.messages();
}

/// What is expected of a field: its number, parity, first pixel and line step.
struct Expected {
  std::int64_t number;
  Parity parity;
  int first_pixel;
  std::int32_t lines;
};

void expect_field(ReplayFrameGrabber& grabber, const Expected& expected) {
  const auto lease = grabber.grab_for(kTimeout);
  ASSERT_TRUE(lease);
  EXPECT_EQ(grabber.field_number(), expected.number);
  EXPECT_EQ(lease->field().parity, expected.parity);
  EXPECT_EQ(lease->field().pixels.pixels[0], expected.first_pixel);
  EXPECT_EQ(lease->field().pixels.lines, expected.lines);
  EXPECT_EQ(lease->field().status, core::FieldStatus::kGood);
}

TEST(ReplayFrameGrabber, GivesTheEvenLinesFirst) {
  const TemporaryFolder folder;
  // 4 x 3 pixels: frame f line v begins with 10 f + 4 v.
  const std::string path = folder.write("a.y4m", recording_text(kHeader, 2, 12));
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kEvenFirst), path);

  ASSERT_TRUE(grabber.start());
  expect_field(grabber, {0, Parity::kEven, 0, 2});
  expect_field(grabber, {1, Parity::kOdd, 4, 1});
  expect_field(grabber, {2, Parity::kEven, 10, 2});
  EXPECT_EQ(grabber.frame().line(2)[3], 21);
  expect_field(grabber, {3, Parity::kOdd, 14, 1});
  const auto end = grabber.grab_for(kTimeout);

  ASSERT_FALSE(end);
  EXPECT_EQ(end.error(), Error::kEndOfData);
  EXPECT_EQ(grabber.frames_read(), 2);
  EXPECT_EQ(grabber.messages(), Messages{});
}

TEST(ReplayFrameGrabber, GivesTheOddLinesFirst) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.y4m", recording_text("YUV4MPEG2 W4 H3 F25:1 Ib Cmono", 1, 12));
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kOddFirst), path);

  ASSERT_TRUE(grabber.start());
  expect_field(grabber, {0, Parity::kOdd, 4, 1});
  expect_field(grabber, {1, Parity::kEven, 0, 2});
}

TEST(ReplayFrameGrabber, NumbersProgressiveFramesByTwos) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text("YUV4MPEG2 W4 H3 F25:1", 2, 12, 8));
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kProgressive), path);

  ASSERT_TRUE(grabber.start());
  expect_field(grabber, {0, Parity::kProgressive, 0, 3});
  expect_field(grabber, {2, Parity::kProgressive, 10, 3});
  EXPECT_EQ(grabber.grab_for(kTimeout).error(), Error::kEndOfData);
}

TEST(ReplayFrameGrabber, CountsSequenceAndTimeByItself) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text(kHeader, 2, 12));
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kEvenFirst), path);
  ASSERT_TRUE(grabber.start());
  for (int field = 0; field < 4; ++field) {
    const auto lease = grabber.grab_for(kTimeout);
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease->field().sequence, field);
    EXPECT_EQ(lease->field().mid_exposure.count(), 20'000'000 * field);
    EXPECT_EQ(lease->field().number, field);
    EXPECT_EQ(lease->field().lamp_permille, core::kFullLamp_permille) << "nobody dims";
  }
}

TEST(ReplayFrameGrabber, TakesWhatTheMetaFileSays) {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "a.y4m.xz", support::compress_xz(recording_text("YUV4MPEG2 W4 H3 It Cmono", 1, 12)));
  folder.write("a.meta.csv",
               "field,sequence,time_s,status,lamp_permille\n0,5,1.5,good,300\n1,8,1.75,damaged,\n");
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kEvenFirst), path);

  ASSERT_TRUE(grabber.start());
  {
    const auto first = grabber.grab_for(kTimeout);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->field().sequence, 5);
    EXPECT_EQ(first->field().mid_exposure.count(), 1'500'000'000);
    EXPECT_EQ(first->field().lamp_permille, 300);
  }
  {
    const auto second = grabber.grab_for(kTimeout);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->field().sequence, 8);
    EXPECT_EQ(second->field().status, core::FieldStatus::kDamaged);
    EXPECT_EQ(second->field().lamp_permille, core::kFullLamp_permille) << "not told";
  }
  EXPECT_EQ(grabber.grab_for(kTimeout).error(), Error::kEndOfData);
}

TEST(ReplayFrameGrabber, DeliversNoPixelsOfAMissingField) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text(kHeader, 1, 12));
  folder.write("a.meta.csv",
               "field,sequence,time_s,status,lamp_permille\n0,65535,0,good,\n1,,0.02,missing,\n");
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kEvenFirst), path);

  ASSERT_TRUE(grabber.start());
  expect_field(grabber, {0, Parity::kEven, 0, 2});
  const auto missing = grabber.grab_for(kTimeout);

  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->field().status, core::FieldStatus::kMissing);
  EXPECT_EQ(missing->field().pixels.pixels, nullptr);
  EXPECT_EQ(missing->field().pixels.lines, 0);
  EXPECT_EQ(missing->field().parity, Parity::kOdd);
  EXPECT_EQ(missing->field().mid_exposure.count(), 20'000'000);
}

TEST(ReplayFrameGrabber, WantsAMetaRowForEachFieldAndNoOthers) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text(kHeader, 1, 12));
  const std::string head = "field,sequence,time_s,status,lamp_permille\n0,0,0,good,1\n";
  folder.write("a.meta.csv", head);
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kEvenFirst), path);
  ASSERT_TRUE(grabber.start());
  ASSERT_TRUE(grabber.grab_for(kTimeout));
  EXPECT_EQ(grabber.grab_for(kTimeout).error(), Error::kInvalidArgument);
  EXPECT_EQ(grabber.messages(),
            Messages{folder.path("a.meta.csv") +
                     ": no row for field 1, expected one for each field of " + path});

  folder.write("a.meta.csv", head + "1,1,1,good,1\n2,2,2,good,1\n");
  ReplayFrameGrabber again(camera_of(4, 3, Scan::kEvenFirst), path);
  ASSERT_TRUE(again.start());
  ASSERT_TRUE(again.grab_for(kTimeout));
  ASSERT_TRUE(again.grab_for(kTimeout));
  EXPECT_EQ(again.grab_for(kTimeout).error(), Error::kInvalidArgument);
  EXPECT_EQ(again.messages(),
            Messages{folder.path("a.meta.csv") +
                     ":4: field: 2, expected at most 1, the last field of " + path});
}

TEST(ReplayFrameGrabber, RefusesAnotherSize) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text(kHeader, 1, 12));

  EXPECT_EQ(refused(path, camera_of(635, 480, Scan::kEvenFirst), Error::kInvalidArgument),
            Messages{path + ": 4 x 3 pixels, expected 635 x 480 as [camera] of the settings says"});
}

TEST(ReplayFrameGrabber, RefusesInterlacingAtOddsWithTheSettings) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text(kHeader, 1, 12));

  EXPECT_EQ(refused(path, camera_of(4, 3, Scan::kOddFirst), Error::kInvalidArgument),
            Messages{path + ": header says It (even lines first), expected scan = \"odd-first\" as "
                            "[camera] of the settings says"});
  EXPECT_EQ(refused(path, camera_of(4, 3, Scan::kProgressive), Error::kInvalidArgument),
            Messages{path + ": header says It (even lines first), expected scan = \"progressive\" "
                            "as [camera] of the settings says"});
}

TEST(ReplayFrameGrabber, RefusesARecordingWithoutTimesOrFrames) {
  const TemporaryFolder folder;
  const core::CameraSettings camera = camera_of(4, 3, Scan::kEvenFirst);
  const std::string timeless =
      folder.write("a.y4m", recording_text("YUV4MPEG2 W4 H3 Cmono", 1, 12));
  const std::string empty = folder.write("b.y4m", recording_text(kHeader, 0, 12));
  const std::string cut = folder.write("c.y4m", recording_text(kHeader, 1, 12).substr(0, 40));

  EXPECT_EQ(refused(timeless, camera, Error::kInvalidArgument),
            Messages{timeless +
                     ": header says no frame rate, expected F<number>:<number> there or "
                     "times in " +
                     folder.path("a.meta.csv")});
  EXPECT_EQ(refused(empty, camera, Error::kInvalidArgument),
            Messages{empty + ": holds no frame, expected at least one"});
  EXPECT_EQ(refused(cut, camera, Error::kDataLoss),
            Messages{cut + ": cut short within its first frame"});
  EXPECT_EQ(refused(folder.path("none.y4m"), camera, Error::kIo),
            Messages{folder.path("none.y4m") + ": cannot be read: No such file or directory"});
}

TEST(ReplayFrameGrabber, UsesTheCompleteFramesOfACutRecording) {
  const TemporaryFolder folder;
  const std::string whole = recording_text(kHeader, 3, 12);
  const std::string path = folder.write("a.y4m", whole.substr(0, whole.size() - 1));
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kEvenFirst), path);
  ASSERT_TRUE(grabber.start());
  for (int field = 0; field < 4; ++field) {
    ASSERT_TRUE(grabber.grab_for(kTimeout));
  }

  EXPECT_EQ(grabber.grab_for(kTimeout).error(), Error::kDataLoss);
  EXPECT_EQ(grabber.messages(),
            Messages{path + ": cut short: only its first 2 frames are complete"});
  EXPECT_EQ(grabber.grab_for(kTimeout).error(), Error::kDataLoss) << "it stays";
}

TEST(ReplayFrameGrabber, RefusesAWrongMetaFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text(kHeader, 1, 12));
  folder.write("a.meta.csv", "field,time\n");

  EXPECT_EQ(refused(path, camera_of(4, 3, Scan::kEvenFirst), Error::kInvalidArgument),
            Messages{folder.path("a.meta.csv") +
                     ":1: wrong header, expected field,sequence,time_s,status,lamp_permille"});
}

TEST(ReplayFrameGrabber, StartsAgainFromTheBeginning) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.y4m", recording_text(kHeader, 1, 12));
  ReplayFrameGrabber grabber(camera_of(4, 3, Scan::kEvenFirst), path);
  ASSERT_TRUE(grabber.start());
  ASSERT_TRUE(grabber.grab_for(kTimeout));
  grabber.stop();

  ASSERT_TRUE(grabber.start());
  expect_field(grabber, {0, Parity::kEven, 0, 2});
}

/// A recording in memory for the suite that every FrameGrabber passes.
class ReplayMaker {
 public:
  hal::FrameGrabber& grabber() { return grabber_; }

 private:
  std::string text_ = recording_text(kHeader, 2, 12);
  ReplayFrameGrabber grabber_{camera_of(4, 3, Scan::kEvenFirst), support::source_of(text_),
                              "memory", ""};
};

}  // namespace
}  // namespace tubesight::drivers

namespace tubesight::support {

INSTANTIATE_TYPED_TEST_SUITE_P(Replay, FrameGrabberContract, drivers::ReplayMaker);

}  // namespace tubesight::support
