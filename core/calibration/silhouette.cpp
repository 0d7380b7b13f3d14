#include "core/calibration/silhouette.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace tubesight::core::calibration {
namespace {

using picture::AveragedPicture;

constexpr double kLeastStep = 10.0;  // grey levels across an edge
constexpr double kAgree_px = 1.0;    // of points of one edge
constexpr double kLeastSigma_px = 0.1;
constexpr std::int32_t kMostReach_px = 64;
constexpr std::int32_t kLeastPoints = 6;

/// A cylinder before a camera.
class Outline {
 public:
  Outline(const camera::CameraModel<double>& camera,
          const Transform<frames::Camera, frames::Tool>& T, const GuidetubeShape& shape,
          std::int32_t width_px, std::int32_t height_px)
      : camera_(camera),
        T_(T),
        radius_mm_(0.5 * shape.diameter_mm),
        length_mm_(shape.length_mm),
        width_px_(width_px),
        height_px_(height_px) {}

  /// The image of a point; empty outside the picture.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& tool_mm) const {
    const Eigen::Vector3d p = T_ * tool_mm;
    if (!(p.z() > 1.0)) {
      return std::nullopt;
    }
    const auto at = camera_.to_pixel({p.x() / p.z(), p.y() / p.z()});
    if (!at || at->x < 0.0 || at->y < 0.0 || at->x > width_px_ - 1.0 || at->y > height_px_ - 1.0) {
      return std::nullopt;
    }
    return Eigen::Vector2d(at->x, at->y);
  }

  [[nodiscard]] Eigen::Vector3d on_side(double angle_rad, double z_mm) const {
    return {radius_mm_ * std::cos(angle_rad), radius_mm_ * std::sin(angle_rad), z_mm};
  }

  /// The line along the cylinder at an angle, from the tip down as far as it is in the picture.
  void side(double angle_rad, SilhouetteEdge& edge) const {
    constexpr int kSteps = 256;
    double lowest_mm = 1.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double z_mm = -length_mm_ * i / kSteps;
      if (pixel(on_side(angle_rad, z_mm))) {
        lowest_mm = z_mm;
      } else if (lowest_mm <= 0.0) {
        break;
      }
    }
    for (std::int32_t i = 0; lowest_mm < 0.0 && i < kSilhouettePoints; ++i) {
      add(on_side(angle_rad, lowest_mm * i / (kSilhouettePoints - 1.0)), edge);
    }
  }

  /// The rim of the tip from one angle to another.
  void tip(double from_rad, double to_rad, SilhouetteEdge& edge) const {
    for (std::int32_t i = 0; i < kSilhouettePoints; ++i) {
      const double share = i / (kSilhouettePoints - 1.0);
      add(on_side(from_rad + share * (to_rad - from_rad), 0.0), edge);
    }
  }

 private:
  void add(const Eigen::Vector3d& tool_mm, SilhouetteEdge& edge) const {
    if (const auto at = pixel(tool_mm)) {
      static_cast<void>(edge.points_px.try_push_back(*at));
    }
  }

  const camera::CameraModel<double>& camera_;
  Transform<frames::Camera, frames::Tool> T_;
  double radius_mm_;
  double length_mm_;
  double width_px_;
  double height_px_;
};

bool in_picture(const AveragedPicture& picture, const Eigen::Vector2d& at) {
  return at.x() >= 0.0 && at.y() >= 0.0 && at.x() <= picture.width_px - 1.0 &&
         at.y() <= picture.height_px - 1.0;
}

double grey(const AveragedPicture& picture, const Eigen::Vector2d& at) {
  const auto u = static_cast<std::int32_t>(std::floor(at.x()));
  const auto v = static_cast<std::int32_t>(std::floor(at.y()));
  if (u < 0 || v < 0 || u + 1 >= picture.width_px || v + 1 >= picture.height_px) {
    return -1.0;
  }
  const double du = at.x() - u;
  const double dv = at.y() - v;
  const double sum = (1.0 - dv) * ((1.0 - du) * picture.at(u, v) + du * picture.at(u + 1, v)) +
                     dv * ((1.0 - du) * picture.at(u, v + 1) + du * picture.at(u + 1, v + 1));
  return sum / picture::kGreyScale;
}

/// The steepest place across an edge at a point, along the unit vector `across`, px from it; empty
/// where no step of enough grey levels is.
std::optional<double> steepest(const AveragedPicture& picture, const Eigen::Vector2d& at,
                               const Eigen::Vector2d& across, double reach_px) {
  constexpr std::int32_t kHalf = 3;  // a step is taken over so many pixels either side
  const auto reach =
      std::min(kMostReach_px, static_cast<std::int32_t>(std::lround(reach_px))) + kHalf;
  const Eigen::Vector2d along(-across.y(), across.x());
  std::array<double, 2 * (kMostReach_px + kHalf) + 1> levels{};
  for (std::int32_t i = -reach; i <= reach; ++i) {
    double sum = 0.0;
    for (const double beside : {-2.0, 0.0, 2.0}) {
      const double level = grey(picture, at + i * across + beside * along);
      if (level < 0.0) {
        sum = -1e9;
      }
      sum += level;
    }
    levels[static_cast<std::size_t>(i + reach)] = sum / 3.0;
  }
  const auto slope = [&](std::int32_t i) {
    const auto level = [&](std::int32_t k) { return levels[static_cast<std::size_t>(k + reach)]; };
    // Differences over 1 and 2 pixels either side: the blur of an edge, little noise.
    const double step = (level(i + 1) - level(i - 1)) + (level(i + 2) - level(i - 2));
    return std::min({level(i - 2), level(i + 2), level(i - 1), level(i + 1)}) < 0.0
               ? 0.0
               : std::abs(step) / 2.0;
  };
  std::int32_t best = 0;
  double most = 0.0;
  for (std::int32_t i = -reach + kHalf; i <= reach - kHalf; ++i) {
    if (slope(i) > most) {
      most = slope(i);
      best = i;
    }
  }
  if (most < kLeastStep || best == -reach + kHalf || best == reach - kHalf) {
    return std::nullopt;
  }
  const double before = slope(best - 1);
  const double after = slope(best + 1);
  const double bend = before - 2.0 * most + after;
  const double part = bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
  return best + std::clamp(part, -0.5, 0.5);
}

/// Shifts along an edge that agree: shift = middle + turn * place, place from -1 to 1.
struct Agreement {
  std::int32_t points = 0;
  double middle_px = 0.0;
  double turn_px = 0.0;
  double sigma_px = 0.0;
};

struct Found {
  double place = 0.0;
  double shift_px = 0.0;
};
using FoundList = StaticVector<Found, kSilhouettePoints>;

/// The line through two of the shifts that most of the others lie on, then least squares.
Agreement agreement_of(const FoundList& found) {
  const auto near = [&](const Agreement& line, const Found& one) {
    return std::abs(one.shift_px - line.middle_px - line.turn_px * one.place) < kAgree_px;
  };
  Agreement best;
  for (std::int32_t i = 0; i < found.size(); ++i) {
    for (std::int32_t k = 0; k < i; ++k) {
      const double apart = found[i].place - found[k].place;
      Agreement line;
      if (std::abs(apart) < 0.3) {
        continue;
      }
      line.turn_px = (found[i].shift_px - found[k].shift_px) / apart;
      line.middle_px = found[i].shift_px - line.turn_px * found[i].place;
      for (const Found& one : found) {
        line.points += near(line, one) ? 1 : 0;
      }
      best = line.points > best.points ? line : best;
    }
  }
  double n = 0.0;
  double t = 0.0;
  double tt = 0.0;
  double s = 0.0;
  double st = 0.0;
  for (const Found& one : found) {
    if (near(best, one)) {
      n += 1.0;
      t += one.place;
      tt += one.place * one.place;
      s += one.shift_px;
      st += one.shift_px * one.place;
    }
  }
  const double determinant = n * tt - t * t;
  if (n < 3.0 || !(determinant > 1e-6)) {
    best.points = 0;
    return best;
  }
  Agreement fit;
  fit.points = static_cast<std::int32_t>(n);
  fit.turn_px = (n * st - t * s) / determinant;
  fit.middle_px = (s - fit.turn_px * t) / n;
  double square = 0.0;
  for (const Found& one : found) {
    if (near(best, one)) {
      const double off = one.shift_px - fit.middle_px - fit.turn_px * one.place;
      square += off * off;
    }
  }
  fit.sigma_px = std::max(kLeastSigma_px, std::sqrt(square / std::max(1.0, n - 2.0)));
  return fit;
}

/// The unit vector across an edge at point i: the way along it, turned to the left (up, for a way
/// to the right).
Eigen::Vector2d across_at(const SilhouetteEdge& edge, std::int32_t i) {
  const std::int32_t last = edge.points_px.size() - 1;
  const Eigen::Vector2d way =
      edge.points_px[std::min(i + 1, last)] - edge.points_px[std::max(i - 1, 0)];
  return Eigen::Vector2d(way.y(), -way.x()).normalized();
}

void measure(const AveragedPicture& picture, double reach_px, double outwards,
             SilhouetteEdge& edge) {
  const std::int32_t count = edge.points_px.size();
  if (count < kLeastPoints) {
    return;
  }
  FoundList found;
  const auto place_of = [&](std::int32_t i) { return 2.0 * i / (count - 1.0) - 1.0; };
  for (std::int32_t i = 0; i < count; ++i) {
    const Eigen::Vector2d across = outwards * across_at(edge, i);
    if (const auto shift = steepest(picture, edge.points_px[i], across, reach_px)) {
      static_cast<void>(found.try_push_back({place_of(i), *shift}));
    }
  }
  const Agreement line = agreement_of(found);
  if (line.points < kLeastPoints || 2 * line.points < count) {
    return;
  }
  decltype(edge.points_px) moved;
  for (std::int32_t i = 0; i < count; ++i) {
    const Eigen::Vector2d at = edge.points_px[i] + (line.middle_px + line.turn_px * place_of(i)) *
                                                       outwards * across_at(edge, i);
    if (in_picture(picture, at)) {
      static_cast<void>(moved.try_push_back(at));
    }
  }
  if (moved.size() < kLeastPoints) {
    return;
  }
  edge.points_px = moved;
  edge.measured = true;
  edge.sigma_px = line.sigma_px;
  edge.shift_px = line.middle_px;
}

}  // namespace

Silhouette computed_silhouette(const camera::CameraModel<double>& camera,
                               const Transform<frames::Camera, frames::Tool>& T_camera_tool,
                               const GuidetubeShape& shape, std::int32_t width_px,
                               std::int32_t height_px) {
  Silhouette result;
  const Outline outline(camera, T_camera_tool, shape, width_px, height_px);
  const Eigen::Vector3d eye = T_camera_tool.inverse().translation_mm();
  const double distance_mm = eye.head<2>().norm();
  const double radius_mm = 0.5 * shape.diameter_mm;
  if (!(distance_mm > radius_mm)) {
    return result;
  }
  const double towards = std::atan2(eye.y(), eye.x());
  const double half = std::acos(radius_mm / distance_mm);
  const Eigen::Vector3d axis = T_camera_tool.rotation().col(2);
  const Eigen::Vector3d tip = T_camera_tool.translation_mm();
  const Eigen::Vector3d to_first = T_camera_tool.rotation() * outline.on_side(towards + half, 0.0);
  const Eigen::Vector3d right = tip.cross(axis);  // looking at the tip with the axis upwards
  const bool first_is_right = to_first.dot(right) > 0.0;
  const double left_rad = first_is_right ? towards - half : towards + half;
  const double right_rad = first_is_right ? towards + half : towards - half;
  outline.side(left_rad, result.edges[static_cast<std::size_t>(SilhouettePart::kLeft)]);
  outline.side(right_rad, result.edges[static_cast<std::size_t>(SilhouettePart::kRight)]);
  // Seen from below the tip its near rim is the outline, from above it the far one.
  double to = right_rad;
  if (eye.z() > 0.0) {
    to += right_rad > left_rad ? -2.0 * std::numbers::pi : 2.0 * std::numbers::pi;
  }
  outline.tip(left_rad, to, result.edges[static_cast<std::size_t>(SilhouettePart::kTip)]);
  return result;
}

void measure_silhouette(const AveragedPicture& picture, double reach_px, Silhouette& silhouette) {
  // Sides run from the tip down and the tip's rim from left to right: across_at() points to the
  // right on both sides and upwards on the tip, with the tip upwards.
  measure(picture, reach_px, -1.0,
          silhouette.edges[static_cast<std::size_t>(SilhouettePart::kLeft)]);
  measure(picture, reach_px, 1.0, silhouette.edges[static_cast<std::size_t>(SilhouettePart::kTip)]);
  measure(picture, reach_px, 1.0,
          silhouette.edges[static_cast<std::size_t>(SilhouettePart::kRight)]);
}

std::int32_t points_hidden(const Silhouette& silhouette, const picture::Rim& rim,
                           double margin_px) {
  const auto beyond = [&](SilhouettePart part, double outwards, const Eigen::Vector2d& at) {
    const SilhouetteEdge& edge = silhouette.edge(part);
    double inside = -1e9;
    double nearest = 1e18;
    for (std::int32_t i = 0; i < edge.points_px.size(); ++i) {
      const Eigen::Vector2d off = at - edge.points_px[i];
      if (off.squaredNorm() < nearest) {
        nearest = off.squaredNorm();
        inside = -outwards * off.dot(across_at(edge, i));
      }
    }
    return inside;
  };
  std::int32_t hidden = 0;
  for (const picture::RimPoint& point : rim.points) {
    const Eigen::Vector2d at(point.u_px, point.v_px);
    hidden += beyond(SilhouettePart::kLeft, -1.0, at) > margin_px &&
                      beyond(SilhouettePart::kRight, 1.0, at) > margin_px &&
                      beyond(SilhouettePart::kTip, 1.0, at) > margin_px
                  ? 1
                  : 0;
  }
  return hidden;
}

}  // namespace tubesight::core::calibration
