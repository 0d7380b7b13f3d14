#include "core/picture/arc_edge.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::core::picture {
namespace {

constexpr std::int32_t kSide = 60;

// What the default expects; other blurs make an error that all rims share.
constexpr double kBlur_px = ArcEdgeOptions{}.blur_px;

/// A straight edge through a point, dark to bright along the normal, blurred by a Gaussian.
class EdgePicture {
 public:
  EdgePicture(double u, double v, double angle_rad, double dark, double bright, double blur_px)
      : pixels_(static_cast<std::size_t>(kSide * kSide)) {
    for (std::int32_t y = 0; y < kSide; ++y) {
      for (std::int32_t x = 0; x < kSide; ++x) {
        const double distance = (x - u) * std::cos(angle_rad) + (y - v) * std::sin(angle_rad);
        const double share = 0.5 * std::erfc(-distance / blur_px / std::numbers::sqrt2);
        pixels_[static_cast<std::size_t>(y * kSide + x)] =
            static_cast<std::uint16_t>(std::lround(256.0 * (dark + (bright - dark) * share)));
      }
    }
  }
  [[nodiscard]] AveragedPicture view() const { return {pixels_.data(), kSide, kSide}; }

 private:
  std::vector<std::uint16_t> pixels_;
};

/// An arc that expects the edge `off_px` farther in than it is.
OutlineArc arc_at(double u, double v, double angle_rad, double off_px) {
  const double nu = std::cos(angle_rad);
  const double nv = std::sin(angle_rad);
  return {u - off_px * nu, v - off_px * nv, nu, nv, 2.5, 0.0, 0.0};
}

class EdgeMethods : public ::testing::TestWithParam<EdgeMethod> {};

TEST_P(EdgeMethods, PlaceAStraightEdgeInEveryDirection) {
  ArcEdgeOptions options;
  options.method = GetParam();
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 24.0;
    const double u = 30.0 + 0.37 * std::cos(1.0 * i);
    const double v = 30.0 + 0.41 * std::sin(2.0 * i);
    const double off = 1.2 * std::sin(3.0 * i);
    const EdgePicture picture(u, v, angle, 10.0, 150.0, options.blur_px);

    const ArcEdge edge = find_arc_edge(picture.view(), arc_at(u, v, angle, off), options);

    ASSERT_EQ(edge.refusal, ArcRefusal::kNone) << i;
    // The other two see the pixels' places: an upright edge has all of them 1 px apart.
    EXPECT_NEAR(edge.offset_px, off, GetParam() == EdgeMethod::kBlurredStep ? 0.004 : 0.3) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, EdgeMethods,
                         ::testing::Values(EdgeMethod::kBlurredStep, EdgeMethod::kMidLevel,
                                           EdgeMethod::kMoment));

TEST(FindArcEdge, FollowsTheOutlinesBend) {
  // A circle of 12 px radius about (30, 30), seen at its right end.
  std::vector<std::uint16_t> pixels(static_cast<std::size_t>(kSide * kSide));
  for (std::int32_t y = 0; y < kSide; ++y) {
    for (std::int32_t x = 0; x < kSide; ++x) {
      const double distance = std::hypot(x - 30.0, y - 30.0) - 12.0;
      const double share = 0.5 * std::erfc(-distance / kBlur_px / std::numbers::sqrt2);
      pixels[static_cast<std::size_t>(y * kSide + x)] =
          static_cast<std::uint16_t>(std::lround(256.0 * (10.0 + 100.0 * share)));
    }
  }
  const OutlineArc arc{42.3, 30.0, 1.0, 0.0, 2.5, 0.0, -1.0 / 24.6};

  const ArcEdge edge = find_arc_edge({pixels.data(), kSide, kSide}, arc, {});

  ASSERT_EQ(edge.refusal, ArcRefusal::kNone);
  EXPECT_NEAR(edge.offset_px, -0.3, 0.01);
  EXPECT_NEAR(edge.dark, 10.0, 1.0);
  EXPECT_NEAR(edge.bright, 110.0, 1.0);
}

TEST(FindArcEdge, TakesTheInnerRiseOfANarrowRim) {
  // A bright rim 3 px wide whose outside is in shadow, then the sheet: a fillet weld.
  std::vector<std::uint16_t> pixels(static_cast<std::size_t>(kSide * kSide));
  for (std::int32_t y = 0; y < kSide; ++y) {
    for (std::int32_t x = 0; x < kSide; ++x) {
      const auto step = [&](double at) {
        return 0.5 * std::erfc(-(x - at) / kBlur_px / std::numbers::sqrt2);
      };
      const double grey = 10.0 + 190.0 * step(30.25) - 160.0 * step(33.25) + 80.0 * step(36.5);
      pixels[static_cast<std::size_t>(y * kSide + x)] =
          static_cast<std::uint16_t>(std::lround(256.0 * grey));
    }
  }

  const ArcEdge edge =
      find_arc_edge({pixels.data(), kSide, kSide}, arc_at(31.0, 30.0, 0.0, 0.0), {});

  ASSERT_EQ(edge.refusal, ArcRefusal::kNone);
  EXPECT_NEAR(edge.offset_px, -0.75, 0.02);
}

TEST(FindArcEdge, TrustsASaturatedRimLess) {
  const EdgePicture honest(30.0, 30.0, 0.0, 10.0, 220.0, kBlur_px);
  const EdgePicture saturated(30.0, 30.0, 0.0, 10.0, 250.0, kBlur_px);
  const OutlineArc arc = arc_at(30.0, 30.0, 0.0, 0.0);

  const ArcEdge sure = find_arc_edge(honest.view(), arc, {});
  const ArcEdge unsure = find_arc_edge(saturated.view(), arc, {});

  EXPECT_LT(sure.sigma_px, 0.05);
  EXPECT_GE(unsure.sigma_px, 0.3);
}

TEST(FindArcEdge, RefusesWhatIsNoEdge) {
  const EdgePicture flat(30.0, 30.0, 0.0, 80.0, 80.0, kBlur_px);
  const EdgePicture falling(30.0, 30.0, 0.0, 80.0, 10.0, kBlur_px);
  const OutlineArc arc = arc_at(30.0, 30.0, 0.0, 0.0);

  EXPECT_EQ(find_arc_edge(flat.view(), arc, {}).refusal, ArcRefusal::kNoRise);
  EXPECT_EQ(find_arc_edge(falling.view(), arc, {}).refusal, ArcRefusal::kNoRise);
  EXPECT_EQ(find_arc_edge(flat.view(), arc_at(2.0, 30.0, 0.0, 0.0), {}).refusal,
            ArcRefusal::kOutside);
}

}  // namespace
}  // namespace tubesight::core::picture
