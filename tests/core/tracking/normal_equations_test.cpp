#include "core/tracking/normal_equations.h"

#include <random>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

template <typename S>
class NormalEquationsOf : public ::testing::Test {};
TYPED_TEST_SUITE(NormalEquationsOf, Scalars);

template <typename S>
PoseVector<S> row_of(const Vector6& v) {
  PoseVector<S> row{};
  for (int i = 0; i < 6; ++i) {
    row[static_cast<std::size_t>(i)] = Mm<S>(v[i]);
  }
  return row;
}

// Steps of 1/1024: the same numbers in all kinds of arithmetic.
double stepped(double value) { return std::round(value * 1024.0) / 1024.0; }

Vector6 random_row(std::mt19937& random, double scale) {
  std::uniform_real_distribution<double> any(-scale, scale);
  Vector6 row;
  for (int i = 0; i < 6; ++i) {
    row[i] = stepped(any(random));
  }
  return row;
}

template <typename S>
struct System {
  NormalEquations<S> equations;
  Matrix6 matrix = Matrix6::Zero();
  Vector6 value = Vector6::Zero();

  System() { equations.clear(); }

  void add(const Vector6& row, double v, double weight) {
    equations.add(row_of<S>(row), Mm<S>(v), Mm<S>(weight));
    matrix += weight * row * row.transpose();
    value += weight * v * row;
  }
};

template <typename S>
double error_of(const NormalEquations<S>& equations, const Vector6& expected) {
  const PoseVector<S> x = equations.solve();
  double worst = 0.0;
  for (int i = 0; i < 6; ++i) {
    worst = std::max(worst, std::abs(number(x[static_cast<std::size_t>(i)]) - expected[i]));
  }
  return worst;
}

TYPED_TEST(NormalEquationsOf, TakesOneUnknownAloneAsItsRow) {
  std::mt19937 random(22);
  System<TypeParam> by_row;
  System<TypeParam> alone;
  for (int i = 0; i < 20; ++i) {
    const Vector6 row = random_row(random, 4.0);
    by_row.add(row, 0.25, 1.5);
    alone.add(row, 0.25, 1.5);
  }
  for (int unknown = 0; unknown < 6; ++unknown) {
    const double value = stepped(0.3 * unknown - 0.7);
    by_row.add(Vector6::Unit(unknown), value, 2.25);
    alone.equations.add(unknown, Mm<TypeParam>(value), Mm<TypeParam>(2.25));
  }
  ASSERT_TRUE(by_row.equations.factor());
  ASSERT_TRUE(alone.equations.factor());
  EXPECT_EQ(by_row.equations.solve(), alone.equations.solve());
}

TYPED_TEST(NormalEquationsOf, SolvesAsEigenDoes) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int trial = 0; trial < 100; ++trial) {
    System<TypeParam> system;
    for (int i = 0; i < 40; ++i) {
      system.add(random_row(random, 4.0), stepped(any(random)), 0.5 + (i % 4) * 0.5);
    }
    ASSERT_TRUE(system.equations.factor()) << trial;
    const Vector6 expected = system.matrix.ldlt().solve(system.value);
    EXPECT_LT(error_of(system.equations, expected), bound<TypeParam>(1e-12, 1e-5, 1e-5)) << trial;
  }
}

TYPED_TEST(NormalEquationsOf, StandsUnknownsOfVeryDifferentSizes) {
  // Rows as a camera gives them: some 0.5 px for 1/128 rad of one turn, 60 px for another.
  std::mt19937 random(22);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  Vector6 scale;
  scale << 64.0, 20.0, 0.5, 5.0, 5.0, 0.25;
  for (int trial = 0; trial < 50; ++trial) {
    System<TypeParam> system;
    Vector6 truth;
    for (int i = 0; i < 6; ++i) {
      truth[i] = stepped(any(random)) / 4.0;
    }
    for (int i = 0; i < 60; ++i) {
      const Vector6 row = (random_row(random, 1.0).array() * scale.array()).matrix();
      system.add(row, stepped(row.dot(truth)), 4.0);
    }
    ASSERT_TRUE(system.equations.factor()) << trial;
    const Vector6 expected = system.matrix.ldlt().solve(system.value);
    EXPECT_LT(error_of(system.equations, expected), bound<TypeParam>(1e-10, 1e-4, 1e-3)) << trial;
  }
}

TYPED_TEST(NormalEquationsOf, KeepsInRangeUpToTheStatedBounds) {
  // 200 rows of weight 16 with elements up to 64: sums of 200 * 16 * 4096 = 1.3e7.
  std::mt19937 random(23);
  System<TypeParam> system;
  static_cast<void>(take_overflow_flag());
  for (int i = 0; i < 200; ++i) {
    system.add(random_row(random, 64.0), stepped(0.25 + (i % 7) * 0.125), 16.0);
  }
  ASSERT_TRUE(system.equations.factor());
  const Vector6 expected = system.matrix.ldlt().solve(system.value);
  EXPECT_LT(error_of(system.equations, expected), bound<TypeParam>(1e-12, 1e-5, 1e-5));
  EXPECT_FALSE(take_overflow_flag());
}

TYPED_TEST(NormalEquationsOf, WeighsPairsByTheirInformation) {
  std::mt19937 random(24);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  NormalEquations<TypeParam> equations;
  equations.clear();
  Matrix6 matrix = Matrix6::Zero();
  Vector6 value = Vector6::Zero();
  for (int i = 0; i < 20; ++i) {
    const Vector6 u = random_row(random, 4.0);
    const Vector6 v = random_row(random, 4.0);
    Eigen::Matrix2d information;
    information << 6.0, -1.5, -1.5, 3.0;
    const Eigen::Vector2d seen(stepped(any(random)), stepped(any(random)));
    equations.add({row_of<TypeParam>(u), row_of<TypeParam>(v), Mm<TypeParam>(seen[0]),
                   Mm<TypeParam>(seen[1]), Mm<TypeParam>(6.0), Mm<TypeParam>(-1.5),
                   Mm<TypeParam>(3.0)});
    Eigen::Matrix<double, 2, 6> rows;
    rows.row(0) = u.transpose();
    rows.row(1) = v.transpose();
    matrix += rows.transpose() * information * rows;
    value += rows.transpose() * information * seen;
  }
  ASSERT_TRUE(equations.factor());
  const Vector6 expected = matrix.ldlt().solve(value);
  EXPECT_LT(error_of(equations, expected), bound<TypeParam>(1e-12, 1e-5, 1e-5));
}

TYPED_TEST(NormalEquationsOf, TellsTheDeviationOfAnyCombination) {
  std::mt19937 random(25);
  System<TypeParam> system;
  for (int i = 0; i < 30; ++i) {
    system.add(random_row(random, 2.0), 0.0, 1.0);
  }
  ASSERT_TRUE(system.equations.factor());
  const Matrix6 covariance = system.matrix.inverse();
  for (int i = 0; i < 20; ++i) {
    const Vector6 row = random_row(random, 8.0);
    const double expected = std::sqrt(row.dot(covariance * row));
    EXPECT_NEAR(number(system.equations.deviation(row_of<TypeParam>(row))), expected,
                bound<TypeParam>(1e-12, 1e-5, 1e-4) * (1.0 + expected));
  }
}

TYPED_TEST(NormalEquationsOf, DetectsWhatIsNotDetermined) {
  {
    NormalEquations<TypeParam> none;
    none.clear();
    EXPECT_FALSE(none.factor()) << "no rows";
  }
  std::mt19937 random(26);
  {
    System<TypeParam> five;
    for (int i = 0; i < 5; ++i) {
      five.add(random_row(random, 4.0), 1.0, 1.0);
    }
    EXPECT_FALSE(five.equations.factor()) << "five rows for six unknowns";
  }
  System<TypeParam> dependent;
  for (int i = 0; i < 40; ++i) {
    Vector6 row = random_row(random, 4.0);
    row[5] = row[1] / 2.0 - row[3];  // the sixth unknown does what two others do
    dependent.add(row, 1.0, 1.0);
  }
  EXPECT_FALSE(dependent.equations.factor());
}

TYPED_TEST(NormalEquationsOf, ForgetsWhenCleared) {
  std::mt19937 random(27);
  System<TypeParam> system;
  system.add(random_row(random, 4.0), 100.0, 16.0);
  system.equations.clear();
  system.matrix.setZero();
  system.value.setZero();
  for (int i = 0; i < 6; ++i) {
    Vector6 row = Vector6::Zero();
    row[i] = 2.0;
    system.add(row, 1.0, 1.0);
  }
  ASSERT_TRUE(system.equations.factor());
  const PoseVector<TypeParam> x = system.equations.solve();
  for (const auto& element : x) {
    EXPECT_NEAR(number(element), 0.5, 1e-5);  // 2 x = 1
  }
}

}  // namespace
}  // namespace tubesight::core::tracking
