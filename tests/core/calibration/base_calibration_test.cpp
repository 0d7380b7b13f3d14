#include "core/calibration/base_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "tests/core/calibration/base_pairs_drawn.h"

namespace tubesight::core::calibration {
namespace {

/// Pairs and what comes of them; a hundred kilobytes, so on the heap.
struct Bench {
  BasePairs pairs;
  BaseCalibration result;
  PairOutcomes outcomes;

  BaseRefusal run(const BaseKnowledge& knowledge = {}) {
    const auto places = generator_places();
    calibrate_base(pairs, knowledge, places, result, outcomes);
    return result.refusal;
  }
};

std::unique_ptr<Bench> drawn(const std::vector<Eigen::Vector2d>& places, const PairDraw& draw,
                             std::uint32_t seed = 1) {
  auto bench = std::make_unique<Bench>();
  draw_pairs(places, draw, seed, bench->pairs);
  return bench;
}

double place_error(const Bench& bench, const PairDraw& draw) {
  return (bench.result.fit.pose.T_sheet_base.translation_mm() - draw.T_sheet_base.translation_mm())
      .norm();
}
double turn_error(const Bench& bench, const PairDraw& draw) {
  return (bench.result.fit.pose.T_sheet_base.rotation() - draw.T_sheet_base.rotation()).norm();
}

PairDraw noisy() {
  PairDraw draw;
  draw.across_mm = 0.4;
  draw.along_mm = 0.8;
  draw.turn_rad = 5e-4;
  return draw;
}

TEST(BaseCalibration, FindsTheBaseThatPairsWereMadeWith) {
  const PairDraw draw;
  const auto bench = drawn(eight_places(), draw);

  ASSERT_EQ(bench->run(), BaseRefusal::kNone);

  EXPECT_LT(place_error(*bench, draw), 1e-6);
  EXPECT_LT(turn_error(*bench, draw), 1e-9);
  EXPECT_LT((bench->result.fit.pose.X - turned_by(25.0, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(bench->result.values(3), 35.0, 1e-6);
  EXPECT_NEAR(bench->result.values(4), 0.3, 1e-6);
  EXPECT_NEAR(bench->result.values(5), -0.2, 1e-6);
  EXPECT_EQ(bench->result.used, 8);
}

TEST(BaseCalibration, FindsItByPlacesAlone) {
  PairDraw draw;
  draw.turned = false;
  const auto bench = drawn(eight_places(), draw);

  ASSERT_EQ(bench->run(), BaseRefusal::kNone);

  EXPECT_LT(place_error(*bench, draw), 1e-6);
  EXPECT_LT(turn_error(*bench, draw), 1e-9);
}

TEST(BaseCalibration, FindsALevelBaseEitherWayUpByPlacesAlone) {
  for (const double gamma_deg : {0.0, 180.0}) {
    PairDraw draw;
    draw.turned = false;
    draw.T_sheet_base = {turned_by(-70.0, 0.0, gamma_deg), {310.0, -140.0, -1003.0}};
    // Two of them off the line by 40 mm: a line alone is the same from above and from below.
    const auto bench = drawn({{-500.0, 0.0}, {0.0, 40.0}, {500.0, 0.0}, {200.0, 0.0}}, draw);

    ASSERT_EQ(bench->run({true, false, false}), BaseRefusal::kNone) << gamma_deg;

    EXPECT_LT(place_error(*bench, draw), 1e-6) << gamma_deg;
    EXPECT_LT(turn_error(*bench, draw), 1e-9) << gamma_deg;
    EXPECT_EQ(bench->result.covariance(4, 4), 0.0) << "known beforehand";
  }
}

TEST(BaseCalibration, DoesNotDependOnTheOrderOfPairs) {
  auto first = drawn(eight_places(), noisy());
  // One wrong tube named: the search for outliers takes part, too.
  first->pairs[3].T_sheet_tool = {
      first->pairs[3].T_sheet_tool.rotation(),
      first->pairs[3].T_sheet_tool.translation_mm() + Eigen::Vector3d(25.4, 0.0, 0.0)};
  ASSERT_EQ(first->run(), BaseRefusal::kNone);
  std::vector<std::int32_t> order = {0, 1, 2, 3, 4, 5, 6, 7};
  std::mt19937 source(4);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(order.begin(), order.end(), source);
    auto other = std::make_unique<Bench>();
    for (const std::int32_t i : order) {
      ASSERT_TRUE(other->pairs.try_push_back(first->pairs[i]));
    }

    ASSERT_EQ(other->run(), BaseRefusal::kNone);

    EXPECT_EQ(
        std::memcmp(other->result.values.data(), first->result.values.data(), 6 * sizeof(double)),
        0);
    EXPECT_EQ(std::memcmp(other->result.covariance.data(), first->result.covariance.data(),
                          36 * sizeof(double)),
              0);
    for (std::size_t k = 0; k < order.size(); ++k) {
      EXPECT_EQ(other->outcomes[static_cast<std::int32_t>(k)].outlier, order[k] == 3);
    }
  }
}

TEST(BaseCalibration, OfMoreThanTwentyPairsDoesNotDependOnTheirOrderEither) {
  const auto first = drawn(generator_places(), noisy());
  ASSERT_EQ(first->run(), BaseRefusal::kNone);
  auto other = std::make_unique<Bench>();
  for (std::int32_t i = first->pairs.size() - 1; i >= 0; --i) {
    ASSERT_TRUE(other->pairs.try_push_back(first->pairs[i]));
  }

  ASSERT_EQ(other->run(), BaseRefusal::kNone);

  EXPECT_EQ(
      std::memcmp(other->result.values.data(), first->result.values.data(), 6 * sizeof(double)), 0);
}

TEST(BaseCalibration, NamesPairsThatAreWrong) {
  const auto good = drawn(eight_places(), noisy(), 7);
  ASSERT_EQ(good->run(), BaseRefusal::kNone);
  EXPECT_EQ(good->result.outliers, 0);
  auto bench = drawn(eight_places(), noisy(), 7);
  const auto move = [&](std::int32_t i, const Eigen::Matrix3d& turn, double x_mm) {
    const auto& pose = bench->pairs[i].T_sheet_tool;
    bench->pairs[i].T_sheet_tool = {turn * pose.rotation(),
                                    pose.translation_mm() + Eigen::Vector3d(x_mm, 0.0, 0.0)};
  };
  move(1, Eigen::Matrix3d::Identity(), 25.4);  // its neighbour named
  move(5, turned_by(90.0, 0.0, 0.0), 0.0);     // the sheet clicked a quarter of a turn off

  ASSERT_EQ(bench->run(), BaseRefusal::kNone);

  for (std::int32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(bench->outcomes[i].outlier, i == 1 || i == 5) << i;
  }
  EXPECT_NEAR(bench->outcomes[1].place_mm.x(), 25.4, 2.5);
  EXPECT_EQ(bench->result.used, 6);
}

TEST(BaseCalibration, LeavesOutWhatIsOnlyToBeCompared) {
  auto bench = drawn(eight_places(), PairDraw{});
  bench->pairs[2].use = false;
  bench->pairs[2].T_sheet_tool = {
      bench->pairs[2].T_sheet_tool.rotation(),
      bench->pairs[2].T_sheet_tool.translation_mm() + Eigen::Vector3d(3.0, 0.0, 0.0)};

  ASSERT_EQ(bench->run(), BaseRefusal::kNone);

  EXPECT_EQ(bench->result.used, 7);
  EXPECT_FALSE(bench->outcomes[2].outlier);
  EXPECT_NEAR(bench->outcomes[2].place_mm.x(), 3.0, 1e-6);
}

TEST(BaseCalibration, PromisesTheErrorThatItHas) {
  const PairDraw draw = noisy();
  const BaseKnowledge knowledge;
  double nees = 0.0;
  double across2 = 0.0;
  double promised2 = 0.0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto bench = drawn(eight_places(), draw, static_cast<std::uint32_t>(100 + trial));
    ASSERT_EQ(bench->run(knowledge), BaseRefusal::kNone) << trial;
    const BaseFit& fit = bench->result.fit;
    math::Vector6d error;
    error.head<3>() = draw.T_sheet_base.translation_mm() - fit.pose.T_sheet_base.translation_mm();
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(draw.T_sheet_base.rotation() *
                                                 fit.pose.T_sheet_base.rotation().transpose()));
    error.tail<3>() = turn.angle() * turn.axis();
    math::Cholesky<6> factor;
    ASSERT_TRUE(factor.factor(fit.covariance));
    nees += error.dot(factor.solve(error)) / 6.0 / kTrials;
    const Eigen::Vector2d corner(800.0, 800.0);
    const Eigen::Vector3d place(corner.x(), corner.y(), -30.0);
    const Eigen::Vector3d off =
        draw.T_sheet_base * (fit.pose.T_sheet_base.inverse() * place) - place;
    across2 += off.head<2>().squaredNorm();
    promised2 += std::pow(deviation_at(bench->result, corner).across_mm, 2);
  }
  EXPECT_GT(nees, 0.75);
  EXPECT_LT(nees, 1.25);
  EXPECT_NEAR(std::sqrt(across2 / promised2), 1.0, 0.15);
}

TEST(BaseCalibration, RefusesPairsThatDoNotTellTheBase) {
  const PairDraw draw;
  EXPECT_EQ(drawn({{0.0, 0.0}, {500.0, 0.0}}, draw)->run(), BaseRefusal::kTooFew);
  EXPECT_EQ(drawn({{0.0, 0.0}, {5.0, 0.0}, {0.0, 5.0}}, draw)->run(), BaseRefusal::kOnePlace);
  EXPECT_EQ(drawn({{0.0, 0.0}, {8.0, 0.0}, {0.0, 8.0}}, noisy())->run(), BaseRefusal::kOnePlace)
      << "whatever the noise makes of distances";
  PairDraw places = draw;
  places.turned = false;
  const std::vector<Eigen::Vector2d> line = {
      {0.0, 0.0}, {300.0, 300.0}, {600.0, 600.0}, {-300.0, -300.0}};
  EXPECT_EQ(drawn(line, places)->run(), BaseRefusal::kCollinear);
  PairDraw level = places;
  level.T_sheet_base = {turned_by(35.0, 0.0, 0.0), {310.0, -140.0, -1003.0}};
  EXPECT_EQ(drawn(line, level)->run({true, false, false}), BaseRefusal::kCollinear)
      << "which way up is not told";
  EXPECT_EQ(drawn(line, draw)->run(), BaseRefusal::kNone) << "rotations tell the lean";
}

TEST(BaseCalibration, RefusesPairsThatContradictEachOther) {
  // Of four pairs one that is wrong cannot be told from the others.
  auto bench = drawn({{-500.0, -500.0}, {500.0, -500.0}, {500.0, 500.0}, {-500.0, 500.0}}, noisy());
  bench->pairs[0].T_sheet_tool = {
      bench->pairs[0].T_sheet_tool.rotation(),
      bench->pairs[0].T_sheet_tool.translation_mm() + Eigen::Vector3d(25.4, 0.0, 0.0)};
  EXPECT_EQ(bench->run(), BaseRefusal::kContradiction);

  auto wild = drawn(eight_places(), noisy());
  std::mt19937 source(2);
  std::normal_distribution<double> normal(0.0, 15.0);
  for (BasePair& pair : wild->pairs) {
    pair.T_sheet_tool = {
        pair.T_sheet_tool.rotation(),
        pair.T_sheet_tool.translation_mm() + Eigen::Vector3d(normal(source), normal(source), 0.0)};
  }
  EXPECT_EQ(wild->run(), BaseRefusal::kContradiction);
}

TEST(BaseCalibration, RefusesRotationsThatContradictThePlaces) {
  // The robot's tool axis points out of the sheet where vision's points into it.
  auto bench = drawn(eight_places(), noisy());
  for (BasePair& pair : bench->pairs) {
    pair.T_base_tool = {pair.T_base_tool.rotation() * turned_by(0.0, 0.0, 180.0),
                        pair.T_base_tool.translation_mm()};
  }
  EXPECT_EQ(bench->run(), BaseRefusal::kTurnContradiction);
}

TEST(BaseCalibration, RefusesAnotherUnit) {
  auto bench = drawn(eight_places(), PairDraw{});
  for (BasePair& pair : bench->pairs) {
    pair.T_base_tool = {pair.T_base_tool.rotation(), pair.T_base_tool.translation_mm() / 25.4};
  }
  EXPECT_EQ(bench->run(), BaseRefusal::kOtherUnit);
  EXPECT_NEAR(bench->result.scale, 25.4, 1e-6);
}

TEST(BaseCalibration, RefusesALevelBaseThatLeans) {
  PairDraw draw = noisy();
  draw.T_sheet_base = {turned_by(35.0, 1.0, 0.0), {310.0, -140.0, -1003.0}};
  const auto bench = drawn(eight_places(), draw);
  EXPECT_EQ(bench->run({true, false, false}), BaseRefusal::kNotLevel);
  EXPECT_NEAR(bench->result.lean_rad, std::numbers::pi / 180.0, 0.002);

  draw.T_sheet_base = {turned_by(35.0, 0.0, 0.0), {310.0, -140.0, -1003.0}};
  const auto level = drawn(eight_places(), draw);
  ASSERT_EQ(level->run({true, false, false}), BaseRefusal::kNone);
  EXPECT_EQ(level->result.values(4), 0.0);
  EXPECT_EQ(level->result.values(5), 0.0);
}

TEST(BaseCalibration, RefusesABaseThatLeavesTheToolUnknown) {
  // Three places within 60 mm, and a generator of 1.6 m.
  PairDraw draw = noisy();
  draw.turned = false;
  const auto bench = drawn({{0.0, 0.0}, {60.0, 0.0}, {0.0, 60.0}}, draw);
  EXPECT_EQ(bench->run(), BaseRefusal::kVague);
}

TEST(BaseCalibration, KnowsThatTheToolIsKnown) {
  PairDraw draw;
  const auto wrong = drawn(eight_places(), draw);
  EXPECT_EQ(wrong->run({false, true, false}), BaseRefusal::kTurnContradiction)
      << "X turns by 25 degrees";

  draw.turn_deg = 0.0;
  const auto bench = drawn(eight_places(), draw);
  ASSERT_EQ(bench->run({false, true, false}), BaseRefusal::kNone);
  EXPECT_LT(turn_error(*bench, draw), 1e-9);
  EXPECT_EQ(bench->result.fit.turn_sigma_rad, 0.0);
}

TEST(BaseCalibration, TellsTheNextPlaceThatHelpsMost) {
  // All pairs stand to the left; far on the right another tells most.
  const auto bench =
      drawn({{-700.0, -300.0}, {-500.0, 300.0}, {-600.0, 0.0}, {-400.0, -200.0}, {-450.0, 100.0}},
            noisy());
  ASSERT_EQ(bench->run(), BaseRefusal::kNone);
  const auto places = generator_places();

  const NextPlace next = next_place(bench->result, {}, true, places, places);

  EXPECT_GT(next.at_mm.x(), 500.0);
  EXPECT_LT(next.mean.across_mm, bench->result.mean.across_mm);
  // It is what the calibration promises when that pair is there.
  auto more = std::make_unique<Bench>();
  more->pairs = bench->pairs;
  BasePair pair;
  pair.T_sheet_tool = {bench->result.R_sheet_tool,
                       {next.at_mm.x(), next.at_mm.y(), bench->result.height_mm}};
  pair.T_base_tool = bench->result.fit.pose.T_sheet_base.inverse() * pair.T_sheet_tool;
  pair.T_base_tool = {pair.T_base_tool.rotation() * bench->result.fit.pose.X.transpose(),
                      pair.T_base_tool.translation_mm()};
  ASSERT_TRUE(more->pairs.try_push_back(pair));
  ASSERT_EQ(more->run(), BaseRefusal::kNone);
  EXPECT_NEAR(more->result.mean.across_mm, next.mean.across_mm, 0.2 * next.mean.across_mm);
}

}  // namespace
}  // namespace tubesight::core::calibration
