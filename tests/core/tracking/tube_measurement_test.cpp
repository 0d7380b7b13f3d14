#include "core/tracking/tube_measurement.h"

#include <gtest/gtest.h>

#include "core/tracking/projection.h"
#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

const std::array<TubeAddress, 9> kSeen{
    {{20, 10}, {21, 10}, {20, 11}, {19, 10}, {20, 9}, {21, 11}, {21, 9}, {19, 9}, {22, 10}}};

template <typename S>
class TubeMeasurementOf : public ::testing::Test {
 protected:
  void make() {
    scene_.make();
    sheet_ = std::make_unique<SyntheticSheet>(*scene_.settings);
  }

  // Whether a tube-end's outline is well inside the picture.
  [[nodiscard]] bool whole(TubeAddress tube) const {
    const auto at = sheet_->image_of(kOverTube, tube);
    return at[0] > 60 && at[0] < 575 && at[1] > 60 && at[1] < 420;
  }

  // Looks for a tube in `frame` with a prediction off by `off_mm` over the sheet.
  [[nodiscard]] Finding look(const Frame& frame, Parity parity, TubeAddress tube,
                             const Vector2<Mm<S>>& off_mm, MeasurementBounds bounds = {}) {
    auto pose = pose_at<S>(*scene_.settings, *sheet_, kOverTube, kTube);
    pose.origin = pose.origin + pose.along(off_mm);
    const auto center = pose.origin + pose.along(scene_.model.lattice.offset(kTube, tube));
    const auto rim =
        project_rim<S>(scene_.model, center, make_rim_spokes<S>(pose, scene_.model.bore_radius_mm));
    const auto predicted = to_pixel<S>(scene_.model, center);
    if (!rim || !predicted) {
      return Finding::kOutside;
    }
    middle_ = rim->middle;
    result_ = {};
    result_.predicted_px = *predicted;
    edges::DynamicThreshold threshold(200);
    return measure_tube<S>(sheet_->view(frame, parity), *rim, bounds, threshold, result_);
  }

  Scene<S> scene_;
  std::unique_ptr<SyntheticSheet> sheet_;
  TubeMeasurement<S> result_{};
  Vector2<Px<S>> middle_{};
};
TYPED_TEST_SUITE(TubeMeasurementOf, Scalars);

TYPED_TEST(TubeMeasurementOf, FindsTheImageOfTheCentreAndNotTheEllipsesCentre) {
  this->make();
  double squares = 0.0;
  double worst_bias = 0.0;
  int count = 0;
  for (const Parity parity : {Parity::kEven, Parity::kOdd}) {
    Frame frame;
    this->sheet_->draw(kOverTube, parity, 1, frame);
    for (const TubeAddress tube : kSeen) {
      if (!this->whole(tube)) {
        continue;
      }
      ASSERT_EQ(this->look(frame, parity, tube, {}), Finding::kMeasured)
          << tube.row << ", " << tube.column;
      const auto truth = this->sheet_->image_of(kOverTube, tube);
      const double error = distance(this->result_.center_px, truth);
      EXPECT_LT(error, 0.1) << tube.row << ", " << tube.column;
      squares += error * error;
      ++count;
      worst_bias = std::max(worst_bias, distance(this->middle_, truth));
    }
  }
  EXPECT_GE(count, 12);
  EXPECT_LT(std::sqrt(squares / count), 0.06);
  EXPECT_GT(worst_bias, 0.5);
}

TYPED_TEST(TubeMeasurementOf, CorrectsAPredictionThatIsOff) {
  this->make();
  Frame frame;
  this->sheet_->draw(kOverTube, Parity::kEven, 1, frame);
  using M = Mm<TypeParam>;
  for (const Vector2<M>& off :
       {Vector2<M>{M(0.8), M(0)}, Vector2<M>{M(0), M(-0.8)}, Vector2<M>{M(-0.6), M(0.6)}}) {
    for (const TubeAddress tube : {TubeAddress{20, 10}, TubeAddress{21, 10}, TubeAddress{20, 11}}) {
      if (!this->whole(tube)) {
        continue;
      }
      ASSERT_EQ(this->look(frame, Parity::kEven, tube, off), Finding::kMeasured);
      EXPECT_LT(distance(this->result_.center_px, this->sheet_->image_of(kOverTube, tube)), 0.15);
      EXPECT_GT(distance(this->result_.predicted_px, this->sheet_->image_of(kOverTube, tube)), 1.0);
    }
  }
}

TYPED_TEST(TubeMeasurementOf, StandsNoiseAndDimLight) {
  this->make();
  this->sheet_->look.gain = 0.5;
  this->sheet_->look.noise = 3.0;
  double squares = 0.0;
  int count = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    Frame frame;
    this->sheet_->draw(kOverTube, Parity::kOdd, seed, frame);
    for (const TubeAddress tube : kSeen) {
      if (this->whole(tube) && this->look(frame, Parity::kOdd, tube, {}) == Finding::kMeasured) {
        const double error =
            distance(this->result_.center_px, this->sheet_->image_of(kOverTube, tube));
        squares += error * error;
        ++count;
      }
    }
  }
  EXPECT_GE(count, 24);
  EXPECT_LT(std::sqrt(squares / count), 0.2);
}

TYPED_TEST(TubeMeasurementOf, TakesTheInnerEdgeOfAFillet) {
  this->scene_.settings->tubesheet.weld = Weld::kFillet;
  this->make();
  Frame frame;
  this->sheet_->draw(kOverTube, Parity::kEven, 1, frame);
  MeasurementBounds bounds;
  bounds.taps = 4;
  int measured = 0;
  for (const TubeAddress tube : kSeen) {
    if (!this->whole(tube)) {
      continue;
    }
    if (this->look(frame, Parity::kEven, tube, {}, bounds) == Finding::kMeasured) {
      ++measured;
      EXPECT_LT(distance(this->result_.center_px, this->sheet_->image_of(kOverTube, tube)), 0.2);
      EXPECT_LT(std::abs(number(this->result_.growth_px)), 1.0);
    }
  }
  EXPECT_GE(measured, 5);
}

TYPED_TEST(TubeMeasurementOf, DisagreesWhereNoRimOfThatSizeIs) {
  this->make();
  this->sheet_->look.flush_plugs = {{20, 10}};
  this->sheet_->look.rolled_plugs = {{21, 10}};
  Frame frame;
  this->sheet_->draw(kOverTube, Parity::kEven, 1, frame);
  ASSERT_TRUE(this->whole({20, 10}));
  EXPECT_EQ(this->look(frame, Parity::kEven, {20, 10}, {}), Finding::kDisagrees) << "sheet";
  ASSERT_TRUE(this->whole({21, 10}));
  EXPECT_EQ(this->look(frame, Parity::kEven, {21, 10}, {}), Finding::kDisagrees) << "a hole";
  EXPECT_EQ(this->look(frame, Parity::kEven, {20, 9}, {Mm<TypeParam>(12.7), Mm<TypeParam>(12.7)}),
            Finding::kDisagrees)
      << "between tubes";
}

TYPED_TEST(TubeMeasurementOf, MeasuresARimThatIsPartlyHidden) {
  this->make();
  const auto at = this->sheet_->image_of(kOverTube, kTube);
  const auto u = static_cast<std::int32_t>(at[0]);
  const auto v = static_cast<std::int32_t>(at[1]);
  // A bar over the rim's lowest part.
  this->sheet_->look.bar_px = {u - 60, v + 18, u + 60, v + 60};
  Frame frame;
  this->sheet_->draw(kOverTube, Parity::kEven, 1, frame);
  if (this->look(frame, Parity::kEven, kTube, {}) == Finding::kMeasured) {
    EXPECT_LT(distance(this->result_.center_px, at), 0.5);
    EXPECT_LT(this->result_.edges, kRimPoints);
  }
}

TYPED_TEST(TubeMeasurementOf, NeverReadsBesideThePicture) {
  // Rims at, across and beyond every border of a picture without a byte to spare (the address
  // sanitizer's part); what is found is near its truth.
  this->scene_.settings->start.window_px = {0, 0, 634, 479};
  this->make();
  Frame frame;
  int looked_at = 0;
  int outside = 0;
  for (const Parity parity : {Parity::kEven, Parity::kOdd, Parity::kProgressive}) {
    this->sheet_->draw(kOverTube, parity, 1, frame);
    for (std::int32_t row = 15; row <= 25; ++row) {
      for (std::int32_t column = 5; column <= 15; ++column) {
        MeasurementBounds bounds;
        bounds.range_px = 9;
        const Finding finding = this->look(frame, parity, {row, column}, {}, bounds);
        ++looked_at;
        outside += finding == Finding::kOutside ? 1 : 0;
        if (finding == Finding::kMeasured) {
          EXPECT_LT(distance(this->result_.center_px,
                             this->sheet_->image_of(kOverTube, TubeAddress{row, column})),
                    0.6);
        }
      }
    }
  }
  EXPECT_GT(outside, looked_at / 4);
  EXPECT_LT(outside, looked_at);
}

}  // namespace
}  // namespace tubesight::core::tracking
