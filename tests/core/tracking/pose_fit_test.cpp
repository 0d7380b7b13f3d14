#include "core/tracking/pose_fit.h"

#include <random>
#include <set>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/tracking/tool_point.h"
#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

const ToolPlace kPlace{251.0, 512.0, 55.0, 12.0, 0.7, -0.5};

template <typename S>
class PoseFitOf : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_.make();
    sheet_ = std::make_unique<SyntheticSheet>(*scene_.settings);
  }

  // Centres as the synthetic camera sees them, each with the information of `edges` edge points.
  [[nodiscard]] MeasurementList<S> perfect(std::int32_t reach, double edges = 6.0) const {
    MeasurementList<S> tubes;
    for (std::int32_t row = -reach; row <= reach; ++row) {
      for (std::int32_t column = -reach; column <= reach; ++column) {
        TubeMeasurement<S> tube;
        tube.address = {kTube.row + row, kTube.column + column};
        const auto at = sheet_->image_of(kPlace, tube.address);
        if (at[0] < 20 || at[0] > 615 || at[1] < 20 || at[1] > 400) {
          continue;
        }
        tube.local = scene_.model.lattice.offset(kTube, tube.address);
        tube.center_px = {Px<S>(at[0]), Px<S>(at[1])};
        tube.information_uu = Mm<S>(edges);
        tube.information_vv = Mm<S>(edges);
        static_cast<void>(tubes.try_push_back(tube));
      }
    }
    return tubes;
  }

  [[nodiscard]] SheetPose<S> truth() const {
    return pose_at<S>(*scene_.settings, *sheet_, kPlace, kTube);
  }
  [[nodiscard]] SheetPose<S> off(const Eigen::Vector3d& turn, const Eigen::Vector3d& shift) const {
    SheetPose<S> pose = truth();
    move<S>(pose, vector3<Mm<S>>(turn), vector3<Mm<S>>(shift));
    return pose;
  }
  // Distance of the pose's tool point from the true one, on the sheet, and of its height.
  [[nodiscard]] double tool_error(const SheetPose<S>& pose) const {
    const auto tool = find_tool_point<S>(scene_.model, pose);
    if (!tool) {
      return 1e9;
    }
    const auto axis = sheet_->axis_point(kPlace);
    const auto center = sheet_->center_of(kTube);
    const double over = distance(tool->local, {axis[0] - center[0], axis[1] - center[1]});
    return std::hypot(over, number(tool->height_mm) - kPlace.height_mm);
  }

  Scene<S> scene_;
  std::unique_ptr<SyntheticSheet> sheet_;
};
TYPED_TEST_SUITE(PoseFitOf, Scalars);

TYPED_TEST(PoseFitOf, RecoversThePoseFromPerfectCentres) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    auto tubes = this->perfect(2);
    ASSERT_GE(tubes.size(), 8);
    auto pose = this->off(0.02 * Eigen::Vector3d(any(random), any(random), any(random)),
                          3.0 * Eigen::Vector3d(any(random), any(random), any(random)));
    NormalEquations<TypeParam> equations;

    const auto fit = fit_pose<TypeParam>(this->scene_.model, {}, tubes, equations, pose);

    ASSERT_TRUE(fit.solved);
    EXPECT_EQ(fit.used, tubes.size());
    // The steps end when the same tubes agree twice: what two steps leave of 3 mm is second order.
    EXPECT_LT(number(fit.rms_px), bound<TypeParam>(1e-3, 3e-3, 3e-3));
    EXPECT_LT(this->tool_error(pose), bound<TypeParam>(1e-3, 0.02, 0.01)) << "trial " << trial;
    EXPECT_LT((vector(pose.normal) - vector(this->truth().normal)).norm(),
              bound<TypeParam>(1e-5, 2e-4, 1e-4));
  }
}

TYPED_TEST(PoseFitOf, RejectsTheTubesThatDisagreeAndOnlyThose) {
  auto tubes = this->perfect(2);
  const std::set<std::int32_t> wrong{1, 4, tubes.size() - 1};
  int sign = 1;
  for (const std::int32_t i : wrong) {
    tubes[i].center_px.x += Px<TypeParam>(5.0 * sign);
    tubes[i].center_px.y += Px<TypeParam>(-4.0);
    sign = -sign;
  }
  auto pose = this->off({0.004, -0.003, 0.005}, {0.6, -0.4, 0.8});
  NormalEquations<TypeParam> equations;

  const auto fit = fit_pose<TypeParam>(this->scene_.model, {}, tubes, equations, pose);

  ASSERT_TRUE(fit.solved);
  for (std::int32_t i = 0; i < tubes.size(); ++i) {
    EXPECT_EQ(tubes[i].used, !wrong.contains(i)) << i;
  }
  EXPECT_EQ(fit.used, tubes.size() - 3);
  EXPECT_LT(this->tool_error(pose), bound<TypeParam>(2e-3, 0.02, 0.02));
}

TYPED_TEST(PoseFitOf, DoesWithTwoTubesAndWhatIsKnownBesides) {
  // Two centres give four numbers; the lean comes from the prior, so the true sheet is level here.
  const ToolPlace level{251.0, 512.0, 55.0, 12.0, 0.0, 0.0};
  MeasurementList<TypeParam> tubes;
  for (const TubeAddress address : {TubeAddress{20, 10}, TubeAddress{21, 10}}) {
    TubeMeasurement<TypeParam> tube;
    tube.address = address;
    const auto at = this->sheet_->image_of(level, address);
    tube.local = this->scene_.model.lattice.offset(kTube, address);
    tube.center_px = {Px<TypeParam>(at[0]), Px<TypeParam>(at[1])};
    tube.information_uu = Mm<TypeParam>(6.0);
    tube.information_vv = Mm<TypeParam>(6.0);
    ASSERT_TRUE(tubes.try_push_back(tube));
  }
  auto pose = pose_at<TypeParam>(*this->scene_.settings, *this->sheet_, level, kTube);
  // Moved over the level sheet, as the tool's motion does.
  pose.origin = pose.origin + pose.along({Mm<TypeParam>(1.2), Mm<TypeParam>(-0.8)});
  PosePrior<TypeParam> prior;
  prior.lean_weight = Mm<TypeParam>(0.032);
  prior.turn_weight = Mm<TypeParam>(0.002);
  prior.height_weight = Mm<TypeParam>(0.002);
  NormalEquations<TypeParam> equations;

  const auto fit = fit_pose<TypeParam>(this->scene_.model, prior, tubes, equations, pose);

  ASSERT_TRUE(fit.solved);
  EXPECT_EQ(fit.used, 2);
  const auto tool = find_tool_point<TypeParam>(this->scene_.model, pose);
  ASSERT_TRUE(tool.has_value());
  const auto center = this->sheet_->center_of(kTube);
  EXPECT_LT(distance(tool->local, {251.0 - center[0], 512.0 - center[1]}), 0.1);
  // Two tubes say far less than twenty.
  auto many = this->perfect(2);
  auto other = this->truth();
  const double two = number(tool_point_deviation<TypeParam>(pose, *tool, equations));
  NormalEquations<TypeParam> firm;
  ASSERT_TRUE(fit_pose<TypeParam>(this->scene_.model, prior, many, firm, other).solved);
  EXPECT_GT(two, 2.0 * number(tool_point_deviation<TypeParam>(other, *tool, firm)));
}

TYPED_TEST(PoseFitOf, IsNotSolvedWithoutTubesOrWithOneAlone) {
  MeasurementList<TypeParam> none;
  auto pose = this->truth();
  NormalEquations<TypeParam> equations;
  EXPECT_FALSE(fit_pose<TypeParam>(this->scene_.model, {}, none, equations, pose).solved);

  auto tubes = this->perfect(1);
  tubes.truncate(1);
  EXPECT_FALSE(fit_pose<TypeParam>(this->scene_.model, {}, tubes, equations, pose).solved);
}

// Covariance of the six unknowns from derivatives by central differences of the projection, written
// out: the undistorted picture's pixels of each tube when the pose is moved by a little.
template <typename S>
Eigen::Matrix<double, 6, 6> covariance_by_differences(const Scene<S>& scene,
                                                      const SheetPose<double>& pose,
                                                      const MeasurementList<S>& tubes) {
  const Eigen::Vector2d scale(5.06 * 1.021 * 635.0 / (0.0084 * 768.0), 5.06 / 0.0098);
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  const Eigen::Vector3d origin = vector(pose.origin);
  for (const auto& tube : tubes) {
    const Eigen::Vector3d arm =
        number(tube.local.x) * vector(pose.x_axis) + number(tube.local.y) * vector(pose.y_axis);
    const auto seen = [&](const Eigen::Vector3d& turn, const Eigen::Vector3d& shift) {
      const Eigen::Vector3d p = origin + shift + arm + turn.cross(arm);
      return Eigen::Vector2d(scale.x() * p.x() / p.z(), scale.y() * p.y() / p.z());
    };
    Eigen::Matrix<double, 2, 6> J;
    const double h = 1e-4;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d e = Eigen::Vector3d::Unit(i) * h;
      // An unknown's unit of turn is 1/128 rad.
      J.col(i) = (seen(e / 128.0, {0, 0, 0}) - seen(-e / 128.0, {0, 0, 0})) / (2 * h);
      J.col(3 + i) = (seen({0, 0, 0}, e) - seen({0, 0, 0}, -e)) / (2 * h);
    }
    information += J.transpose() * number(tube.information_uu) * J;
  }
  static_cast<void>(scene);
  return information.inverse();
}

TYPED_TEST(PoseFitOf, LeavesTheCovarianceThatCentralDifferencesGive) {
  auto tubes = this->perfect(2, 4.0);
  auto pose = this->truth();
  NormalEquations<TypeParam> equations;
  ASSERT_TRUE(fit_pose<TypeParam>(this->scene_.model, {}, tubes, equations, pose).solved);

  const auto covariance = covariance_by_differences<TypeParam>(
      this->scene_, pose_at<double>(*this->scene_.settings, *this->sheet_, kPlace, kTube), tubes);

  std::mt19937 random(33);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 26; ++i) {
    PoseVector<TypeParam> row{};
    Eigen::Matrix<double, 6, 1> r = Eigen::Matrix<double, 6, 1>::Zero();
    for (int j = 0; j < 6; ++j) {
      r[j] = i < 6 ? (i == j ? 1.0 : 0.0) : std::round(any(random) * 256.0) / 256.0;
      row[static_cast<std::size_t>(j)] = Mm<TypeParam>(r[j]);
    }
    const double expected = std::sqrt(r.dot(covariance * r));
    EXPECT_NEAR(number(equations.deviation(row)), expected,
                bound<TypeParam>(1e-4, 0.01, 0.01) * expected)
        << "row " << i;
  }
}

TYPED_TEST(PoseFitOf, IsAsUncertainAsNoisyCentresMakeIt) {
  // Centres off by 0.2 px / sqrt(information): the tool point's scatter over many fits.
  constexpr int kTrials = 150;
  const double information = 4.0;
  std::mt19937 random(32);
  std::normal_distribution<double> noise(0.0, 0.2 / std::sqrt(information));
  const auto axis = this->sheet_->axis_point(kPlace);
  const auto center = this->sheet_->center_of(kTube);
  double squares = 0.0;
  double deviation = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    auto tubes = this->perfect(2, information);
    for (auto& tube : tubes) {
      tube.center_px.x += Px<TypeParam>(noise(random));
      tube.center_px.y += Px<TypeParam>(noise(random));
    }
    auto pose = this->truth();
    NormalEquations<TypeParam> equations;
    ASSERT_TRUE(fit_pose<TypeParam>(this->scene_.model, {}, tubes, equations, pose).solved);
    const auto tool = find_tool_point<TypeParam>(this->scene_.model, pose);
    ASSERT_TRUE(tool.has_value());
    const double off = distance(tool->local, {axis[0] - center[0], axis[1] - center[1]});
    squares += off * off;
    deviation += number(tool_point_deviation<TypeParam>(pose, *tool, equations)) / kTrials;
  }
  // 300 numbers: their root mean square is right within 4 %; the lens bends the rest.
  const double scatter = std::sqrt(squares / kTrials);
  EXPECT_LT(deviation, 1.3 * scatter);
  EXPECT_GT(deviation, 0.75 * scatter);
}

}  // namespace
}  // namespace tubesight::core::tracking
