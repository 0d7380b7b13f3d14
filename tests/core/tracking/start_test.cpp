#include "core/tracking/start.h"

#include <gtest/gtest.h>

#include "core/tracking/tool_point.h"
#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

const ToolPlace kPlace{251.0, 510.0, 60.0, 5.0, 0.5, -0.4};

template <typename S>
class StartOf : public ::testing::Test {
 protected:
  // Draws what `drawn` says, and has the settings say what `told` does to them.
  template <typename Told>
  void make(Told told) {
    SyntheticSheet sheet(*scene_.settings);
    sheet.draw(kPlace, Parity::kEven, 1, frame_);
    view_ = sheet.view(frame_, Parity::kEven);
    sheet_ = std::make_unique<SyntheticSheet>(sheet);
    told(*scene_.settings);
    scene_.make();
  }
  void make() {
    make([](SessionSettings&) {});
  }

  struct Click {
    TubeAddress told;
    std::array<double, 2> at;
  };
  [[nodiscard]] Click on(TubeAddress tube) const { return {tube, sheet_->image_of(kPlace, tube)}; }
  [[nodiscard]] StartRefusal start(const std::vector<Click>& clicks) {
    StartClickList list;
    for (const Click& click : clicks) {
      const ImagePoint at = make_image_point(click.at);
      EXPECT_TRUE(list.try_push_back({click.told, at.u_q16, at.v_q16}));
    }
    pose_ = {};
    const StartAnswer answer =
        find_start_pose<S>(scene_.model, *scene_.map, view_, list, search_, light_, pose_);
    blamed_ = answer.click;
    return answer.refusal;
  }

  Scene<S> scene_;
  std::unique_ptr<SyntheticSheet> sheet_;
  Frame frame_;
  FieldView view_;
  ClickSearch search_ = ClickSearch::kBisected;
  LightLevels light_{};
  std::int32_t blamed_ = -1;
  SheetPose<S> pose_{};
};
TYPED_TEST_SUITE(StartOf, Scalars);

TYPED_TEST(StartOf, GivesTheRoughPoseFromClicksUpTo60PercentOff) {
  this->make();
  // The tube-ends are some 40 px in radius across and 30 px down.
  for (int i = 0; i < 8; ++i) {
    auto clicks = std::vector{this->on({20, 10}), this->on({21, 10}), this->on({20, 11})};
    for (std::size_t j = 0; j < clicks.size(); ++j) {
      const double angle = i * 0.785398 + static_cast<double>(j);
      clicks[j].at[0] += 12.0 * std::cos(angle);
      clicks[j].at[1] += 10.0 * std::sin(angle);
    }

    ASSERT_EQ(this->start(clicks), StartRefusal::kNone) << i;

    // Ellipse centres and a level sheet: right to some two millimetres.
    const auto tool = find_tool_point<TypeParam>(this->scene_.model, this->pose_);
    ASSERT_TRUE(tool.has_value());
    const auto axis = this->sheet_->axis_point(kPlace);
    const auto center = this->sheet_->center_of(this->pose_.anchor);
    EXPECT_LT(distance(tool->local, {axis[0] - center[0], axis[1] - center[1]}), 3.0) << i;
    EXPECT_NEAR(number(tool->height_mm), 60.0, 6.0) << i;
  }
}

TYPED_TEST(StartOf, FindsTheSameByCirclesInASpoiltPicture) {
  this->make();
  this->search_ = ClickSearch::kRound;
  const auto clicks = std::vector{this->on({20, 10}), this->on({21, 10}), this->on({20, 11})};
  ASSERT_EQ(this->start(clicks), StartRefusal::kNone);
  // Midway between 12 and 140.
  EXPECT_NEAR(this->light_.region_threshold, 76, 6);
  for (std::size_t i = 0; i < this->frame_.size(); i += 31) {
    this->frame_[i] = 255;
  }
  ASSERT_EQ(this->start(clicks), StartRefusal::kNone);
  const auto tool = find_tool_point<TypeParam>(this->scene_.model, this->pose_);
  ASSERT_TRUE(tool.has_value());
  const auto axis = this->sheet_->axis_point(kPlace);
  const auto center = this->sheet_->center_of(this->pose_.anchor);
  EXPECT_LT(distance(tool->local, {axis[0] - center[0], axis[1] - center[1]}), 3.0);
}

TYPED_TEST(StartOf, FindsATubeEndWhoseClickIsUnderABrightSpot) {
  this->make();
  this->search_ = ClickSearch::kRound;
  const auto clicks = std::vector{this->on({20, 10}), this->on({21, 10}), this->on({20, 11})};
  const auto width = this->scene_.settings->camera.width_px;
  for (std::int32_t v = -14; v <= 14; ++v) {
    for (std::int32_t u = -8; u <= 8; ++u) {
      const auto at = clicks[1].at;
      this->frame_[static_cast<std::size_t>((static_cast<std::int32_t>(at[1]) + v) * width +
                                            static_cast<std::int32_t>(at[0]) + u)] = 255;
    }
  }
  EXPECT_EQ(this->start(clicks), StartRefusal::kNone);
}

TYPED_TEST(StartOf, KeepsTheThresholdThatTheSettingsSet) {
  this->make([](SessionSettings& settings) { settings.edges.region_threshold = 50; });
  this->search_ = ClickSearch::kRound;
  this->light_ = first_light<TypeParam>(this->scene_.model);
  ASSERT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), this->on({20, 11})}),
            StartRefusal::kNone);
  EXPECT_EQ(this->light_.region_threshold, 50);
}

TYPED_TEST(StartOf, TellsAClickOnTheSheetByCircles) {
  this->make();
  this->search_ = ClickSearch::kRound;
  for (const auto& [x, y] :
       {std::pair{10.5, 20.5}, {10.5, 20.0}, {10.0, 20.5}, {11.0, 20.5}, {9.5, 20.1}}) {
    const auto at = this->sheet_->image_of(kPlace, {x * 25.4, y * 25.4, 0.0});
    EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), {{20, 11}, at}}),
              StartRefusal::kNoTubeThere)
        << x << ", " << y;
    EXPECT_EQ(this->blamed_, 2);
  }
}

TYPED_TEST(StartOf, TakesUpToEightClicks) {
  this->make();
  std::vector<typename StartOf<TypeParam>::Click> clicks;
  for (const TubeAddress tube : {TubeAddress{20, 10}, TubeAddress{21, 10}, TubeAddress{20, 11},
                                 TubeAddress{21, 11}, TubeAddress{20, 9}}) {
    clicks.push_back(this->on(tube));
  }
  EXPECT_EQ(this->start(clicks), StartRefusal::kNone);
}

TYPED_TEST(StartOf, TakesClicksOnTubeEndsThatTheSearchWindowCuts) {
  // The window bounds what is tracked; clicks may be anywhere in the picture.
  this->make([](SessionSettings& settings) { settings.start.window_px = {290, 150, 400, 230}; });
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), this->on({20, 11})}),
            StartRefusal::kNone);
}

TYPED_TEST(StartOf, IsRefusedWithTooFewClicks) {
  this->make();
  EXPECT_EQ(this->start({}), StartRefusal::kTooFew);
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10})}), StartRefusal::kTooFew);
}

TYPED_TEST(StartOf, IsRefusedByAClickOnTheSheet) {
  this->make();
  // In the middle between four tube-ends neither line nor column meets one.
  const auto web = this->sheet_->image_of(kPlace, {10.5 * 25.4, 20.5 * 25.4, 0.0});
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), {{20, 11}, web}}),
            StartRefusal::kNoTubeThere);
  // Anywhere else on the sheet there is some refusal.
  for (const auto& [x, y] : {std::pair{10.5, 20.0}, {10.0, 20.5}, {11.0, 20.5}, {9.5, 20.1}}) {
    const auto at = this->sheet_->image_of(kPlace, {x * 25.4, y * 25.4, 0.0});
    EXPECT_NE(this->start({this->on({20, 10}), this->on({21, 10}), {{20, 11}, at}}),
              StartRefusal::kNone)
        << x << ", " << y;
  }
}

TYPED_TEST(StartOf, IsRefusedWhenOneTubeEndIsClickedTwice) {
  this->make();
  auto again = this->on({20, 10});
  again.told = {20, 11};
  again.at[0] += 8.0;
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), again}),
            StartRefusal::kSameTubeTwice);
}

TYPED_TEST(StartOf, IsRefusedWhenTheAddressesContradictTheLattice) {
  this->make();
  auto wrong = this->on({20, 11});
  wrong.told = {20, 12};
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), wrong}), StartRefusal::kAddresses);
  wrong.told = {21, 11};
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), wrong}), StartRefusal::kAddresses);
}

TYPED_TEST(StartOf, IsRefusedWhenTheAddressesContradictTheHandedness) {
  // Rows and columns exchanged, and rows counted the other way.
  this->make();
  auto a = this->on({21, 10});
  auto b = this->on({20, 11});
  std::swap(a.told, b.told);
  EXPECT_EQ(this->start({this->on({20, 10}), a, b}), StartRefusal::kAddresses);
  auto c = this->on({21, 10});
  c.told = {19, 10};
  EXPECT_EQ(this->start({this->on({20, 10}), c, this->on({20, 11})}), StartRefusal::kAddresses);
}

TYPED_TEST(StartOf, TakesLeftHandedStepsAndRefusesTheirMirror) {
  // As drawn the rows run the other way than in the settings of the other tests.
  this->scene_.settings->tubesheet.row_step_mm = {0.0, -25.4};
  this->make();
  const auto clicks = std::vector{this->on({-20, 10}), this->on({-21, 10}), this->on({-20, 11})};
  EXPECT_EQ(this->start(clicks), StartRefusal::kNone);
  auto mirrored = clicks;
  mirrored[1].told = {-19, 10};
  EXPECT_EQ(this->start(mirrored), StartRefusal::kAddresses);
}

TYPED_TEST(StartOf, IsRefusedForAnAddressThatDoesNotExist) {
  this->make([](SessionSettings& settings) {
    static_cast<void>(settings.tubesheet.missing.try_push_back({20, 11}));
  });
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), this->on({20, 11})}),
            StartRefusal::kAddresses);
  auto far = this->on({20, 9});
  far.told = {20, 9000};
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), far}), StartRefusal::kAddresses);
}

TYPED_TEST(StartOf, IsRefusedWhenTheDistancesFitNoToolBelowTheSheet) {
  // The sheet is 112 mm from the projection point along the guidetube, the tip 52 mm. A pitch told
  // as 6 mm would put the sheet 26 mm away: 26 mm behind the tip.
  this->make([](SessionSettings& settings) {
    settings.tubesheet.row_step_mm = {0.0, 6.0};
    settings.tubesheet.column_step_mm = {6.0, 0.0};
  });
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), this->on({20, 11})}),
            StartRefusal::kHeight);
}

TYPED_TEST(StartOf, IsRefusedWhenTheDistancesFitATooHighSheet) {
  // A pitch told as 80 mm: 353 mm away, 300 mm above the tip.
  this->make([](SessionSettings& settings) {
    settings.tubesheet.row_step_mm = {0.0, 80.0};
    settings.tubesheet.column_step_mm = {80.0, 0.0};
  });
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), this->on({20, 11})}),
            StartRefusal::kHeight);
}

TYPED_TEST(StartOf, IsRefusedWhenTheTubeEndsAreNotAsLargeAsTheBore) {
  this->make([](SessionSettings& settings) { settings.tubesheet.bore_mm = 12.0; });
  EXPECT_EQ(this->start({this->on({20, 10}), this->on({21, 10}), this->on({20, 11})}),
            StartRefusal::kSize);
}

TYPED_TEST(StartOf, LeavesThePoseAloneWhenRefused) {
  this->make();
  EXPECT_EQ(this->start({this->on({20, 10})}), StartRefusal::kTooFew);
  EXPECT_TRUE(this->pose_.origin == Vector3<Mm<TypeParam>>{});
}

}  // namespace
}  // namespace tubesight::core::tracking
