#include "core/pose/pose_seed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "core/pose/ellipse_fit.h"
#include "core/pose/n_point.h"
#include "core/pose/three_point.h"

namespace tubesight::core::pose {
namespace {

using CameraSheet = Transform<frames::Camera, frames::Sheet>;

// Centres whose spread across their line is below this share of that along it lie on a line.
constexpr double kCollinearShare = 1e-2;
// With fewer pairs than this, or a worse fit, the homography may hang on few of them: four points,
// three of them on a line, leave it open. Then three points propose too, and all are polished.
constexpr std::int32_t kEnoughPairs = 6;
constexpr double kGoodRms_px = 3.0;

void collect_pairs(const PoseModel& model, const picture::RimList& rims, PlanePointBuffer& points,
                   PoseSeeds& seeds) {
  seeds.pairs.clear();
  seeds.circles.clear();
  seeds.candidates.clear();
  for (std::int32_t i = 0; i < rims.size(); ++i) {
    const Result<Conic> conic = fit_ellipse_quickly(points.of(i));
    if (!conic) {
      continue;
    }
    const Eigen::Vector2d center = model.center_mm(rims[i].address);
    const PointPair pair{Eigen::Vector3d(center.x(), center.y(), 0.0), center_of(*conic),
                         0.1 / model.camera.parameters().scale_px.x};
    static_cast<void>(seeds.pairs.try_push_back(pair));
    static_cast<void>(seeds.circles.try_push_back({*conic, center}));
  }
}

bool on_one_line(const PointPairList& pairs) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const PointPair& pair : pairs) {
    mean += pair.object_mm.head<2>() / static_cast<double>(pairs.size());
  }
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const PointPair& pair : pairs) {
    const Eigen::Vector2d off = pair.object_mm.head<2>() - mean;
    scatter += off * off.transpose();
  }
  // determinant / trace^2 is near the ratio of the squared spreads.
  const double trace = scatter.trace();
  const double determinant = scatter(0, 0) * scatter(1, 1) - scatter(0, 1) * scatter(1, 0);
  return !(determinant > kCollinearShare * kCollinearShare * trace * trace);
}

// The widest triangle, roughly: the two points farthest apart as seen from the first one's
// farthest, and the point farthest from their line. Indices of pairs.
std::array<std::int32_t, 3> wide_triangle(const PointPairList& pairs) {
  const auto farthest = [&pairs](auto distance) {
    std::int32_t best = 0;
    for (std::int32_t i = 1; i < pairs.size(); ++i) {
      best = distance(pairs[i]) > distance(pairs[best]) ? i : best;
    }
    return best;
  };
  const auto from = [&pairs](std::int32_t point) {
    return [&pairs, point](const PointPair& other) {
      return (other.object_mm - pairs[point].object_mm).norm();
    };
  };
  const std::int32_t first = farthest(from(0));
  const std::int32_t second = farthest(from(first));
  const Eigen::Vector3d origin = pairs[first].object_mm;
  const Eigen::Vector3d along = pairs[second].object_mm - origin;
  const std::int32_t third = farthest(
      [&](const PointPair& point) { return along.cross(point.object_mm - origin).norm(); });
  return {first, second, third};
}

// Adds a pose unless one is there that puts the triangle's first corner and the axes alike.
void propose(const CameraSheet& T, const PointPair& corner, PoseSeeds& seeds) {
  constexpr double kAlike_mm = 1.0;
  constexpr double kAlikeTurn = 0.01;
  for (const PoseCandidate& other : seeds.candidates) {
    const CameraSheet& known = other.T_camera_sheet;
    if ((known * corner.object_mm - T * corner.object_mm).norm() < kAlike_mm &&
        (known.rotation() - T.rotation()).norm() < kAlikeTurn) {
      return;
    }
  }
  static_cast<void>(seeds.candidates.try_push_back({T, 0.0}));
}

// The pose of points whose plane has a known normal (unit, away from the camera): the rays met with
// it, turned and scaled onto the object. Always one; none when a ray runs along the plane.
std::optional<CameraSheet> pose_in_plane(std::span<const PointPair> pairs,
                                         const Eigen::Vector3d& normal) {
  const auto count = static_cast<double>(pairs.size());
  const Eigen::Vector3d first = normal.unitOrthogonal();
  const Eigen::Vector3d second = normal.cross(first);
  Eigen::Vector3d seen_mean = Eigen::Vector3d::Zero();
  Eigen::Vector2d object_mean = Eigen::Vector2d::Zero();
  for (const PointPair& pair : pairs) {
    const double depth = normal.dot(pair.plane.homogeneous());
    if (!(depth > 0.05)) {
      return std::nullopt;
    }
    seen_mean += pair.plane.homogeneous() / (depth * count);
    object_mean += pair.object_mm.head<2>() / count;
  }
  // Seen is (c, -s; s, c) object in the plane's axes.
  double c = 0.0;
  double s = 0.0;
  double spread = 0.0;
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d ray = pair.plane.homogeneous();
    const Eigen::Vector3d off = ray / normal.dot(ray) - seen_mean;
    const Eigen::Vector2d object = pair.object_mm.head<2>() - object_mean;
    const double x = first.dot(off);
    const double y = second.dot(off);
    c += object.x() * x + object.y() * y;
    s += object.x() * y - object.y() * x;
    spread += object.squaredNorm();
  }
  const double scale = std::hypot(c, s) / spread;
  if (!(scale > 1e-9)) {
    return std::nullopt;
  }
  Eigen::Matrix3d R;
  R.col(0) = (c * first + s * second) / (scale * spread);
  R.col(1) = (c * second - s * first) / (scale * spread);
  R.col(2) = normal;
  return CameraSheet(R, seen_mean / scale - R.leftCols<2>() * object_mean);
}

// From three tube-ends. Three points alone have up to four solutions; but ellipses' centres are off
// by their eccentricity, and where two solutions are close to each other that leaves neither. So an
// ellipse's own two planes come first: in each the centres are right, and there is one pose.
void propose_from_three(PoseSeeds& seeds) {
  const std::array<std::int32_t, 3> corners = wide_triangle(seeds.pairs);
  const std::array<PointPair, 3> as_seen = {seeds.pairs[corners[0]], seeds.pairs[corners[1]],
                                            seeds.pairs[corners[2]]};
  NPointOptions options;
  options.max_steps = 10;
  for (const std::int32_t index : corners) {
    for (const Eigen::Vector3d& either : circle_normals(seeds.circles[index].conic)) {
      const Eigen::Vector3d normal = either.z() < 0.0 ? Eigen::Vector3d(-either) : either;
      std::array<PointPair, 3> triangle = as_seen;
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[i].plane = center_by_normal(seeds.circles[corners[i]].conic, normal);
      }
      if (const auto start = pose_in_plane(triangle, normal)) {
        const auto pose = solve_n_point(triangle, *start, options);
        propose(pose ? pose->T_camera_sheet : *start, triangle[0], seeds);
      }
    }
  }
  for (const CameraSheet& T : solve_three_points(as_seen)) {
    propose(T, as_seen[0], seeds);
  }
}

void polish(PoseSeeds& seeds) {
  NPointOptions options;
  options.max_steps = 10;
  std::int32_t kept = 0;
  for (const PoseCandidate& candidate : seeds.candidates) {
    const auto pose = solve_n_point(seeds.pairs.view(), candidate.T_camera_sheet, options);
    if (pose) {
      seeds.candidates[kept++] = {pose->T_camera_sheet, pose->rms};
    }
  }
  seeds.candidates.truncate(kept);
}

}  // namespace

PoseRefusal find_seeds(const PoseModel& model, const picture::RimList& rims, std::int32_t min_tubes,
                       PlanePointBuffer& points, PoseSeeds& seeds) {
  collect_pairs(model, rims, points, seeds);
  if (seeds.pairs.size() < min_tubes) {
    return PoseRefusal::kTooFewTubes;
  }
  if (on_one_line(seeds.pairs)) {
    return PoseRefusal::kCollinear;
  }
  const double scale_px = model.camera.parameters().scale_px.x;
  if (const Result<PlanarPoses> planar = planar_poses(seeds.pairs.view())) {
    for (const PoseCandidate& candidate : planar->candidates) {
      static_cast<void>(seeds.candidates.try_push_back(candidate));
    }
    if (seeds.pairs.size() >= kEnoughPairs && planar->candidates[0].rms * scale_px < kGoodRms_px) {
      return PoseRefusal::kNone;
    }
  }
  propose_from_three(seeds);
  if (seeds.pairs.size() > 3) {
    polish(seeds);
  }
  std::sort(seeds.candidates.begin(), seeds.candidates.end(),
            [](const PoseCandidate& a, const PoseCandidate& b) { return a.rms < b.rms; });
  return seeds.candidates.empty() ? PoseRefusal::kAddressesContradict : PoseRefusal::kNone;
}

}  // namespace tubesight::core::pose
