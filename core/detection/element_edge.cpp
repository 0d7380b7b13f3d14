#include "core/detection/element_edge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>

#include "core/base/static_vector.h"
#include "core/picture/rim_in_shade.h"
#include "core/pose/ellipse_fit.h"

namespace tubesight::core::detection {
namespace {

// Of the shorter half axis: pieces of an outline are straight and parallel enough up to this.
constexpr double kPieceShare = 0.35;
constexpr double kLeastPiece_px = 2.0;
constexpr double kMostPiece_px = 5.0;
constexpr std::int32_t kFewestPieces = 16;

// This share of them must be on an edge.
constexpr double kLeastEdge = 0.4;
constexpr double kLeastKnown = 0.3;  // where its form is known
// Less than this does not tell an ellipse's form.
constexpr double kWholeEdge = 0.7;

// The weight of an edge's point: it is off by some half a pixel where light and shadow are uneven.
constexpr double kOfPoint = 4.0;

// What counts as bright inside: this share of the way from dark to what is around.
constexpr double kNearlyAround = 0.8;

// The inside is no brighter than this share of what is around, both above the darkest inside.
constexpr double kMostInside = 0.75;

void draw_outline(const Ellipse& ellipse, picture::RimOutline& outline) {
  const Eigen::Vector2d axes = half_axes(ellipse);
  const double length = std::numbers::pi * (axes.x() + axes.y());
  const double piece = std::clamp(kPieceShare * axes.y(), kLeastPiece_px, kMostPiece_px);
  const auto count = static_cast<std::size_t>(
      std::clamp<double>(length / piece, kFewestPieces, picture::kMaxRimPoints));
  const Eigen::Matrix2d root = root_of(ellipse.shape_px2);
  std::array<Eigen::Vector2d, picture::kMaxRimPoints> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    points[i] = ellipse.center_px + root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  picture::outline_through(std::span<const Eigen::Vector2d>(points).first(count), ellipse.center_px,
                           outline);
}

Ellipse ellipse_of(const pose::Conic& conic) {
  const Eigen::Matrix2d form = conic.topLeftCorner<2, 2>();
  const Eigen::Matrix2d inverse = form.inverse();
  Ellipse ellipse;
  ellipse.center_px = -inverse * conic.topRightCorner<2, 1>();
  const double level =
      conic(2, 2) + Eigen::Vector2d(conic.topRightCorner<2, 1>()).dot(ellipse.center_px);
  ellipse.shape_px2 = -level * inverse;
  return ellipse;
}

// An edge in dim light rises by this share of the darkest's distance from what is around, at least
// by so many grey levels; above the most the light is good enough not to ask.
constexpr double kRiseShare = 0.25;
constexpr double kLeastRise = 2.0;
constexpr double kMostRise = 6.0;

picture::RimMeasureOptions options_for(const Ellipse& expected, const ElementSearch& search,
                                       const Levels& levels) {
  const double half = half_axes(expected).y();
  picture::RimMeasureOptions options;
  options.edge.search_px = search.reach_px;
  options.edge.inner_px = std::min(options.edge.inner_px, 0.6 * half);
  options.edge.outer_px = std::min(options.edge.outer_px, 0.5 * search.room_px);
  options.edge.least_contrast =
      std::clamp(kRiseShare * (levels.around - levels.black), kLeastRise, kMostRise);
  options.least_half_px = 3.0;
  options.least_share = search.form_known ? kLeastKnown : kLeastEdge;
  return options;
}

}  // namespace

double level_at(const picture::AveragedPicture& picture, const Eigen::Vector2d& at) {
  const auto u = static_cast<std::int32_t>(at.x() + 0.5);
  const auto v = static_cast<std::int32_t>(at.y() + 0.5);
  const std::int32_t left = std::max(0, u - 1);
  const std::int32_t right = std::min(picture.width_px - 1, u + 1);
  const std::int32_t sum = picture.at(u, v) + picture.at(left, v) + picture.at(right, v) +
                           picture.at(u, std::max(0, v - 1)) +
                           picture.at(u, std::min(picture.height_px - 1, v + 1));
  return sum * (0.2 / picture::kGreyScale);
}

Levels measure_levels(const picture::AveragedPicture& picture, const Ellipse& ellipse) {
  constexpr std::array kInside = {0.2, 0.45, 0.7};
  constexpr std::array kAround = {1.15, 1.35};
  constexpr std::size_t kWays = 32;
  StaticVector<double, kInside.size() * kWays> inside;
  StaticVector<double, kAround.size() * kWays> around;
  const Eigen::Matrix2d root = root_of(ellipse.shape_px2);
  for (std::size_t i = 0; i < kWays; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kWays;
    const Eigen::Vector2d way = root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const auto sample = [&](double share, auto& levels) {
      const Eigen::Vector2d at = ellipse.center_px + share * way;
      if (at.minCoeff() >= 0.0 && at.x() <= picture.width_px - 1.0 &&
          at.y() <= picture.height_px - 1.0) {
        static_cast<void>(levels.try_push_back(level_at(picture, at)));
      }
    };
    for (const double share : kInside) {
      sample(share, inside);
    }
    for (const double share : kAround) {
      sample(share, around);
    }
  }
  Levels levels;
  // The lamp shines into a bore from one side: of its inside the darkest quarter is taken.
  const std::int32_t quarter = inside.size() / 4;
  if (quarter > 0 && !around.empty()) {
    std::nth_element(inside.begin(), inside.begin() + quarter, inside.end());
    levels.black = std::accumulate(inside.begin(), inside.begin() + quarter, 0.0) / quarter;
    double* const middle = around.begin() + around.size() / 2;
    std::nth_element(around.begin(), middle, around.end());
    levels.around = *middle;
    const std::int32_t most = inside.size() * 6 / 7;
    std::nth_element(inside.begin(), inside.begin() + most, inside.end());
    levels.bright = inside[most];
    const double bright = levels.black + kNearlyAround * (levels.around - levels.black);
    levels.bright_share =
        static_cast<double>(std::count_if(inside.begin(), inside.end(),
                                          [&](double level) { return level > bright; })) /
        inside.size();
  }
  return levels;
}

namespace {

/// The outline expected, moved and grown towards the points; as much as these tell of either.
Ellipse move_outline(const Ellipse& expected, std::span<const pose::PlanePoint> points) {
  // What the picture tells of a place expected: a few hundredths of its size, and a pixel.
  const double half = half_axes(expected).y();
  const double shift_px = 1.0 + 0.05 * half;
  const double growth_px = 0.3 + 0.05 * half;
  Eigen::Matrix3d normal = Eigen::Vector3d(1.0 / (growth_px * growth_px),
                                           1.0 / (shift_px * shift_px), 1.0 / (shift_px * shift_px))
                               .asDiagonal();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const Eigen::Matrix2d inverse = expected.shape_px2.inverse();
  for (const pose::PlanePoint& point : points) {
    const Eigen::Vector2d off = Eigen::Vector2d(point.x, point.y) - expected.center_px;
    const Eigen::Vector2d gradient = inverse * off;
    const double outwards = 0.5 * (off.dot(gradient) - 1.0) / gradient.norm();
    const Eigen::Vector2d across = gradient.normalized();
    const Eigen::Vector3d row(1.0, across.x(), across.y());
    normal += row * row.transpose() * kOfPoint;
    right += row * outwards * kOfPoint;
  }
  const Eigen::Vector3d change = normal.inverse() * right;
  const double growth = 1.0 + change(0) / std::sqrt(std::sqrt(expected.shape_px2.determinant()));
  return {expected.center_px + change.tail<2>(), growth * growth * expected.shape_px2};
}

}  // namespace

bool measure_element(const picture::AveragedPicture& picture, const Ellipse& expected,
                     const ElementSearch& search, ElementScratch& scratch, ElementEdge& edge) {
  draw_outline(expected, scratch.outline);
  picture::RimDarkness darkness;
  if (search.black_grey > 0.0) {
    darkness = {search.black_grey, kMostInside};
  }
  const picture::RimFinding finding = picture::measure_rim_in_shade(
      picture, scratch.outline, options_for(expected, search, measure_levels(picture, expected)),
      darkness, scratch.rim);
  if (finding != picture::RimFinding::kMeasured && finding != picture::RimFinding::kPartly) {
    return false;
  }
  std::size_t count = 0;
  for (const picture::RimPoint& point : scratch.rim.points) {
    pose::PlanePoint& to = scratch.points[count++];
    to = {};
    to.x = point.u_px;
    to.y = point.v_px;
    to.x_u = 1.0;
    to.y_v = 1.0;
    to.normal_u = point.normal_u;
    to.normal_v = point.normal_v;
    to.weight = 1.0 / (point.sigma_px * point.sigma_px);
  }
  edge.share = static_cast<double>(count) / scratch.outline.arcs.size();
  if (search.form_known && edge.share < kWholeEdge) {
    edge.ellipse =
        move_outline(expected, std::span<const pose::PlanePoint>(scratch.points).first(count));
    return true;
  }
  pose::EllipseOptions how;
  how.robust_rounds = 1;  // measure_rim() has left out what does not belong
  const auto fit = pose::fit_ellipse(std::span<pose::PlanePoint>(scratch.points).first(count), how);
  if (!fit) {
    return false;
  }
  edge.ellipse = ellipse_of(fit->conic);
  edge.rms_px = fit->rms_px;
  const double area =
      std::sqrt(edge.ellipse.shape_px2.determinant() / expected.shape_px2.determinant());
  return area > 0.6 && area < 1.6;
}

}  // namespace tubesight::core::detection
