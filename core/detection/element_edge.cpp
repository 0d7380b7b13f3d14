#include "core/detection/element_edge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "core/picture/rim_measurement.h"
#include "core/pose/ellipse_fit.h"

namespace tubesight::core::detection {
namespace {

// Of the shorter half axis: pieces of an outline are straight and parallel enough up to this.
constexpr double kPieceShare = 0.35;
constexpr double kLeastPiece_px = 2.0;
constexpr double kMostPiece_px = 5.0;
constexpr std::int32_t kFewestPieces = 16;

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

picture::RimMeasureOptions options_for(const Ellipse& expected, const ElementSearch& search) {
  const double half = half_axes(expected).y();
  picture::RimMeasureOptions options;
  options.edge.search_px = search.reach_px;
  options.edge.inner_px = std::min(options.edge.inner_px, 0.6 * half);
  options.edge.outer_px = std::min(options.edge.outer_px, 0.5 * search.room_px);
  options.least_half_px = 3.0;
  options.least_share = 0.4;
  return options;
}

}  // namespace

bool measure_element(const picture::AveragedPicture& picture, const Ellipse& expected,
                     const ElementSearch& search, ElementScratch& scratch, ElementEdge& edge) {
  draw_outline(expected, scratch.outline);
  const picture::RimFinding finding =
      picture::measure_rim(picture, scratch.outline, options_for(expected, search), scratch.rim);
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
  pose::EllipseOptions how;
  how.robust_rounds = 1;  // measure_rim() has left out what does not belong
  const auto fit = pose::fit_ellipse(std::span<pose::PlanePoint>(scratch.points).first(count), how);
  if (!fit) {
    return false;
  }
  edge.ellipse = ellipse_of(fit->conic);
  edge.share = static_cast<double>(count) / scratch.outline.arcs.size();
  edge.rms_px = fit->rms_px;
  const double area =
      std::sqrt(edge.ellipse.shape_px2.determinant() / expected.shape_px2.determinant());
  return area > 0.6 && area < 1.6;
}

}  // namespace tubesight::core::detection
