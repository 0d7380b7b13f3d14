#include "core/tracking/picture_light.h"

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

class PictureLightOf : public ::testing::TestWithParam<Parity> {
 protected:
  PictureLightOf() { tests::make_synthetic_settings(*settings_); }

  [[nodiscard]] PictureLight judged(double gain, double offset, double noise = 0.0) {
    SyntheticSheet sheet(*settings_);
    sheet.look.gain = gain;
    sheet.look.offset = offset;
    sheet.look.noise = noise;
    Frame frame;
    sheet.draw(kOverTube, GetParam(), 1, frame);
    return judge_light(sheet.view(frame, GetParam()), {40, 36, 595, 330});
  }

  std::unique_ptr<SessionSettings> settings_ = std::make_unique<SessionSettings>();
};

INSTANTIATE_TEST_SUITE_P(AllFields, PictureLightOf,
                         ::testing::Values(Parity::kEven, Parity::kOdd, Parity::kProgressive));

TEST_P(PictureLightOf, IsUsableFromHalfToTwiceTheUsualLight) {
  EXPECT_EQ(judged(1.0, 0.0), PictureLight::kUsable);
  EXPECT_EQ(judged(0.5, 0.0, 2.0), PictureLight::kUsable);
  EXPECT_EQ(judged(2.0, 0.0, 4.0), PictureLight::kUsable);
}

TEST_P(PictureLightOf, IsDarkWhenNothingIsSeen) {
  EXPECT_EQ(judged(0.0, 0.0), PictureLight::kDark);
  EXPECT_EQ(judged(0.0, 8.0, 3.0), PictureLight::kDark);
  EXPECT_EQ(judged(0.05, 4.0, 1.0), PictureLight::kDark);
}

TEST_P(PictureLightOf, IsWashedOutWhenAllIsSaturated) {
  EXPECT_EQ(judged(0.0, 255.0), PictureLight::kWashedOut);
  EXPECT_EQ(judged(1.0, 245.0), PictureLight::kWashedOut);
}

TEST_P(PictureLightOf, LooksAtTheWindowAlone) {
  Frame frame(635 * 480, 5);
  const SyntheticSheet sheet(*settings_);
  for (std::size_t v = 0; v < 30; ++v) {
    std::fill_n(frame.begin() + static_cast<std::ptrdiff_t>(v * 635), 635, std::uint8_t{200});
  }
  EXPECT_EQ(judge_light(sheet.view(frame, GetParam()), {40, 36, 595, 330}), PictureLight::kDark);
}

TEST_P(PictureLightOf, StaysWithinThePictureWithAnyWindow) {
  const Frame frame(635 * 480, 100);
  const SyntheticSheet sheet(*settings_);
  EXPECT_EQ(judge_light(sheet.view(frame, GetParam()), {0, 0, 634, 479}), PictureLight::kUsable);
  EXPECT_EQ(judge_light(sheet.view(frame, GetParam()), {-500, -500, 2000, 2000}),
            PictureLight::kUsable);
}

}  // namespace
}  // namespace tubesight::core::tracking
