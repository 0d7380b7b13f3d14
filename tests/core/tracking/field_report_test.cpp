#include "core/tracking/field_report.h"

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

template <typename S>
class FieldReport : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_.make();
    sheet_ = std::make_unique<SyntheticSheet>(*scene_.settings);
    place_.pose = pose_at<S>(*scene_.settings, *sheet_, kOverTube, kTube);
  }
  [[nodiscard]] static TubeMeasurement<S> tube(std::int32_t column, std::int32_t edges,
                                               double rms_px, bool used = true) {
    TubeMeasurement<S> tube;
    tube.address = {20, column};
    tube.center_px = {Px<S>(300.5), Px<S>(200.0 + column)};
    tube.edges = edges;
    tube.rms_px = Px<S>(rms_px);
    tube.used = used;
    return tube;
  }

  Scene<S> scene_;
  std::unique_ptr<SyntheticSheet> sheet_;
  Place<S> place_{};
  Sighting sighting_{};
  TubeSightingList tubes_;
};
TYPED_TEST_SUITE(FieldReport, Scalars);

TYPED_TEST(FieldReport, FindsTheNearestTubeAndTheWayToItsEdge) {
  // 0.4 and 0.6 steps of 25.4 mm along the columns.
  this->place_.tool.local = {Mm<TypeParam>(10.16), Mm<TypeParam>{}};
  auto nearest = find_nearest_tube<TypeParam>(this->scene_.model, this->place_);
  EXPECT_EQ(nearest.address, kTube);
  EXPECT_NEAR(number(nearest.off.x), 10.16, 1e-4);
  EXPECT_NEAR(number(nearest.to_edge_mm), 2.54, 1e-3);

  this->place_.tool.local.x = Mm<TypeParam>(15.24);
  nearest = find_nearest_tube<TypeParam>(this->scene_.model, this->place_);
  EXPECT_EQ(nearest.address, (TubeAddress{20, 11}));
  EXPECT_NEAR(number(nearest.off.x), -10.16, 1e-4);
  EXPECT_NEAR(number(nearest.to_edge_mm), 2.54, 1e-3);
}

TYPED_TEST(FieldReport, TellsTubesByQualityAndPlugs) {
  FieldRecord<TypeParam> record;
  ASSERT_TRUE(record.measured.try_push_back(this->tube(10, kRimPoints, 0.0)));
  ASSERT_TRUE(record.measured.try_push_back(this->tube(11, kRimPoints, 0.5)));
  ASSERT_TRUE(record.measured.try_push_back(this->tube(12, kRimPoints / 2, 0.0, false)));
  ASSERT_TRUE(record.plugs_seen.try_push_back({{20, 13}, {Px<TypeParam>(9.0), {}}}));
  PrimaryTube primary;
  primary.choose<TypeParam>(record.measured, {Px<TypeParam>(300.0), Px<TypeParam>(211.0)});

  report_tubes<TypeParam>(record, primary, this->sighting_, this->tubes_);

  ASSERT_EQ(this->tubes_.size(), 4);
  EXPECT_EQ(this->tubes_[0].quality_permyriad, 10000) << "a perfect rim";
  EXPECT_EQ(this->tubes_[0].center_px.u_q16, 300 * 65536 + 32768);
  EXPECT_EQ(this->tubes_[1].quality_permyriad, 5000) << "half a pixel of spread";
  EXPECT_EQ(this->tubes_[2].quality_permyriad, 0) << "rejected from the fit";
  EXPECT_TRUE(this->tubes_[3].plug);
  EXPECT_EQ(this->tubes_[3].address, (TubeAddress{20, 13}));
  EXPECT_EQ(this->sighting_.tracked, 2);
  EXPECT_TRUE(this->sighting_.primary_known);
  EXPECT_EQ(this->sighting_.primary, (TubeAddress{20, 11}));
  EXPECT_EQ(this->sighting_.primary_px.v_q16, 211 * 65536);
}

TYPED_TEST(FieldReport, TellsNoPrimaryThatThisFieldDoesNotShow) {
  PrimaryTube primary;
  const std::array<TubeMeasurement<TypeParam>, 1> before{this->tube(10, kRimPoints, 0.0)};
  primary.choose<TypeParam>(before, {});
  report_tubes<TypeParam>(FieldRecord<TypeParam>{}, primary, this->sighting_, this->tubes_);
  EXPECT_FALSE(this->sighting_.primary_known);
  EXPECT_EQ(this->tubes_.size(), 0);
}

TYPED_TEST(FieldReport, TellsTheAxisInMicrometresAndPixels) {
  const auto tool = find_tool_point<TypeParam>(this->scene_.model, this->place_.pose);
  ASSERT_TRUE(tool.has_value());
  this->place_.tool = *tool;
  Motion<TypeParam> motion;
  motion.known = true;
  motion.interval_s = Unit<TypeParam>(0.02);
  motion.velocity_mm_s = {Mm<TypeParam>(12.5), Mm<TypeParam>(-3.0)};

  report_axis<TypeParam>(this->scene_.model, this->place_, motion, this->sighting_);

  EXPECT_TRUE(this->sighting_.axis_known);
  EXPECT_NEAR(this->sighting_.height_um_q8 / 256.0, 60000.0, 2.0);
  const auto at = this->sheet_->image_of(kOverTube, kTube);  // the axis goes through its centre
  EXPECT_NEAR(this->sighting_.axis_px.u_q16 / 65536.0, at[0], 0.01);
  EXPECT_NEAR(this->sighting_.axis_px.v_q16 / 65536.0, at[1], 0.01);
  EXPECT_TRUE(this->sighting_.velocity_known);
  EXPECT_EQ(this->sighting_.velocity_um_s[0], 12500);
  EXPECT_EQ(this->sighting_.velocity_um_s[1], -3000);
  EXPECT_NEAR(this->sighting_.velocity_span_us, 20000, 10);
}

TYPED_TEST(FieldReport, TellsTheMarginInTenThousandths) {
  report_margin(Mm<TypeParam>(4.25), this->sighting_);
  EXPECT_TRUE(this->sighting_.margin_known);
  EXPECT_EQ(this->sighting_.margin_permyriad, 42500);
}

TYPED_TEST(FieldReport, NamesTheToolsTubeAndVouchesOnlyForAJudgedFieldWithinTheLimit) {
  using M = Mm<TypeParam>;
  NearestTube<TypeParam> nearest;
  nearest.address = kTube;
  nearest.off = {M(3.0), M(-4.0)};
  const auto report = [&](bool judged, double within_mm) {
    this->scene_.model.aligned_within_mm = M(within_mm);
    this->sighting_ = {};
    this->sighting_.judged = judged;
    report_tool<TypeParam>(this->scene_.model, this->place_.pose, nearest, this->sighting_);
  };

  report(true, 5.5);
  EXPECT_TRUE(this->sighting_.tool_known);
  EXPECT_EQ(this->sighting_.tool, kTube);
  EXPECT_EQ(this->sighting_.offset_um_q8, 5000 * 256);
  EXPECT_EQ(this->sighting_.displacement_um_q8[0], 3000 * 256);
  EXPECT_EQ(this->sighting_.displacement_um_q8[1], -4000 * 256);
  const auto at = this->sheet_->image_of(kOverTube, kTube);
  EXPECT_NEAR(this->sighting_.tool_px.u_q16 / 65536.0, at[0], 0.01);
  EXPECT_TRUE(this->sighting_.aligned);

  report(true, 4.5);
  EXPECT_FALSE(this->sighting_.aligned) << "too far off";
  report(false, 5.5);
  EXPECT_FALSE(this->sighting_.aligned) << "a prediction is not vouched for";
  EXPECT_TRUE(this->sighting_.tool_known);
}

}  // namespace
}  // namespace tubesight::core::tracking
