#include "board/bench/pose/still_tubes.h"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/board/bench/pose/moving_recording.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

using support::TemporaryFolder;
using tests::moving_place;

class StillTubesTest : public ::testing::Test {
 protected:
  StillTubesTest() {
    tests::make_synthetic_settings(*settings_);
    const tests::SyntheticSheet sheet(*settings_);
    for (const core::TubeAddress tube :
         {core::TubeAddress{40, 60}, core::TubeAddress{41, 60}, core::TubeAddress{40, 61}}) {
      const auto at = sheet.image_of(moving_place(0), tube);
      clicks_.push_back({tube, at[0], at[1]});
    }
    folder_.write("r.y4m", tests::moving_recording());
  }

  [[nodiscard]] StillTubes make(bool only_start = false) const {
    return {*settings_, {clicks_, {0, true}, only_start}};
  }
  [[nodiscard]] Still frame(std::int64_t number) const { return {folder_.path("r.y4m"), number}; }

  TemporaryFolder folder_;
  std::unique_ptr<core::SessionSettings> settings_ = std::make_unique<core::SessionSettings>();
  PictureStarts clicks_;
};

void expect_clicks(const TubesFound& found, const PictureStarts& clicks) {
  ASSERT_EQ(found.status, ExitStatus::kDone) << found.message;
  ASSERT_EQ(found.places.size(), clicks.size());
  for (std::size_t i = 0; i < clicks.size(); ++i) {
    EXPECT_EQ(found.places[i].address, clicks[i].address);
    EXPECT_EQ(found.places[i].u_px, clicks[i].u_px);
    EXPECT_EQ(found.places[i].v_px, clicks[i].v_px);
  }
  EXPECT_FALSE(found.tool);
}

TEST_F(StillTubesTest, OfPicturesAndOfTheFrameOfTheClicksAreTheClicks) {
  StillTubes tubes = make();
  const std::vector<Still> pictures = {{"none-0.png"}, {"none-1.png"}};

  expect_clicks(tubes.find(pictures), clicks_);
  expect_clicks(tubes.find({{frame(0)}}), clicks_);
}

TEST_F(StillTubesTest, OfAnotherFrameAreTracked) {
  StillTubes tubes = make();
  const std::vector<Still> still = {frame(10)};

  const TubesFound found = tubes.find(still);

  // 52.5 mm on: two tubes.
  ASSERT_EQ(found.status, ExitStatus::kDone) << found.message;
  ASSERT_TRUE(found.tool);
  EXPECT_EQ(*found.tool, (core::TubeAddress{40, 62}));
  EXPECT_EQ(found.places.size(), 12U);
}

TEST_F(StillTubesTest, OfTheStartAloneAreThoseNamedWhileAllAreInView) {
  settings_->start.window_px = {200, 36, 470, 330};
  StillTubes tubes = make(true);
  const std::vector<Still> near = {frame(1)};
  const std::vector<Still> far = {frame(11)};

  const TubesFound found = tubes.find(near);
  const TubesFound gone = tubes.find(far);

  ASSERT_EQ(found.status, ExitStatus::kDone) << found.message;
  ASSERT_EQ(found.places.size(), 3U);
  EXPECT_EQ(found.places[2].address, (core::TubeAddress{40, 61}));
  EXPECT_EQ(gone.status, ExitStatus::kJobFailed);
  EXPECT_NE(gone.message.find("of the start is not seen in the search window"), std::string::npos)
      << gone.message;
}

TEST_F(StillTubesTest, OfFramesThatAreNotNeighboursMustBeTheSame) {
  StillTubes tubes = make();
  const std::vector<Still> stills = {frame(0), frame(10)};

  const TubesFound found = tubes.find(stills);

  EXPECT_EQ(found.status, ExitStatus::kJobFailed);
  EXPECT_NE(found.message.find("frame 10: no pose: it shows other tubes than "), std::string::npos)
      << found.message;
}

}  // namespace
}  // namespace tubesight::board
