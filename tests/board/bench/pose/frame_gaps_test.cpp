#include "board/bench/pose/frame_gaps.h"

#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "core/base/settings.h"
#include "tests/support/recording_text.h"
#include "tests/support/synthetic_sheet.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

using support::TemporaryFolder;

/// What a meta file says of a field.
struct Told {
  int sequence;
  double time_s;
  const char* status;
};

class FrameGapsTest : public ::testing::Test {
 protected:
  FrameGapsTest() {
    tests::make_synthetic_settings(*settings_);
    settings_->camera.width_px = 96;
    settings_->camera.height_px = 80;
    write("It", 30);
  }

  void write(const std::string& scan, int rate) {
    folder_.write("r.y4m", support::recording_text("YUV4MPEG2 W96 H80 F" + std::to_string(rate) +
                                                       ":1 " + scan + " Cmono",
                                                   6, 96 * 80));
  }

  /// A meta file of 60 fields a second, changed by `change`.
  void write_meta(const std::function<void(int field, Told&)>& change) {
    std::string meta = "field,sequence,time_s,status,lamp_permille\n";
    for (int field = 0; field < 12; ++field) {
      Told told{field, field / 60.0, "good"};
      change(field, told);
      meta += std::to_string(field) + "," + std::to_string(told.sequence) + "," +
              std::to_string(told.time_s) + "," + told.status + ",\n";
    }
    folder_.write("r.meta.csv", meta);
  }

  [[nodiscard]] FrameGaps find(std::int64_t first = 1, std::int64_t last = 4) const {
    return find_frame_gaps(*settings_, folder_.path("r.y4m"), first, last);
  }

  void expect_refused(const std::string& why) const {
    const FrameGaps gaps = find();
    EXPECT_EQ(gaps.status, ExitStatus::kJobFailed);
    EXPECT_EQ(gaps.message.find(why), 0U) << gaps.message;
  }

  TemporaryFolder folder_;
  std::unique_ptr<core::SessionSettings> settings_ = std::make_unique<core::SessionSettings>();
};

TEST_F(FrameGapsTest, FramesOneAfterTheOtherHaveNone) {
  EXPECT_EQ(find().status, ExitStatus::kDone) << find().message;
  EXPECT_EQ(find(0, 5).status, ExitStatus::kDone);

  write_meta([](int, Told& told) { told.sequence = 7 + 2 * told.sequence; });
  EXPECT_EQ(find().status, ExitStatus::kDone) << "a camera that numbers by two";
}

TEST_F(FrameGapsTest, OutsideTheFramesDoNotCount) {
  write_meta([](int field, Told& told) {
    told.time_s += field >= 10 ? 5.0 : 0.0;
    told.sequence += field >= 10 ? 300 : 0;
    told.status = field == 1 ? "damaged" : "good";
  });

  EXPECT_EQ(find().status, ExitStatus::kDone) << find().message;
}

TEST_F(FrameGapsTest, OfTimeAreFound) {
  write_meta([](int field, Told& told) { told.time_s += field >= 6 ? 1.0 : 0.0; });
  expect_refused("field 6 comes so long after");
}

TEST_F(FrameGapsTest, OfNumbersAloneAreFound) {
  write_meta([](int field, Told& told) { told.sequence += field >= 5 ? 60 : 0; });
  expect_refused("field 5 comes so long after");
}

TEST_F(FrameGapsTest, DamagedAndMissingFieldsAreOnes) {
  write_meta([](int field, Told& told) { told.status = field == 9 ? "damaged" : "good"; });
  expect_refused("field 9 is damaged or missing");
}

TEST_F(FrameGapsTest, OfASlowCameraAreTooLong) {
  // A field each tenth of a second: 30 mm at 300 mm/s, over a step of 25.4 mm.
  write("It", 5);
  expect_refused("field 3 comes so long after");

  settings_->motion.max_speed_mm_s = 100.0;
  EXPECT_EQ(find().status, ExitStatus::kDone) << find().message;
}

TEST_F(FrameGapsTest, OfProgressiveFramesAreAWholeFrameLong) {
  settings_->camera.scan = core::Scan::kProgressive;
  write("Ip", 30);
  EXPECT_EQ(find().status, ExitStatus::kDone) << find().message;

  write("Ip", 12);
  expect_refused("field 4 comes so long after");
}

TEST_F(FrameGapsTest, OfARecordingThatCannotBeReadAreWrongInput) {
  const FrameGaps behind = find(3, 6);
  const FrameGaps none = find_frame_gaps(*settings_, folder_.path("none.y4m"), 0, 1);

  EXPECT_EQ(behind.status, ExitStatus::kWrongInput);
  EXPECT_EQ(none.status, ExitStatus::kWrongInput);
  EXPECT_EQ(none.message.find(folder_.path("none.y4m")), 0U) << none.message;
}

}  // namespace
}  // namespace tubesight::board
