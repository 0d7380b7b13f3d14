#include "core/pose/pose_seed.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/pose/ellipse_fit.h"
#include "core/pose/n_point.h"
#include "core/pose/three_point.h"

namespace tubesight::core::pose {
namespace {

// Centres whose spread across their line is below this share of that along it lie on a line.
constexpr double kCollinearShare = 1e-2;
// With fewer pairs than this, or a worse fit, the homography may hang on few of them: four points,
// three of them on a line, leave it open. Then three points propose too, and all are polished.
constexpr std::int32_t kEnoughPairs = 6;
constexpr double kGoodRms_px = 3.0;

void collect_pairs(const PoseModel& model, const RimList& rims, PlanePointBuffer& points,
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
// farthest, and the point farthest from their line.
std::array<PointPair, 3> wide_triangle(const PointPairList& pairs) {
  const auto farthest = [&pairs](auto distance) {
    return *std::max_element(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) {
      return distance(a) < distance(b);
    });
  };
  const auto from = [](const PointPair& point) {
    return [&point](const PointPair& other) { return (other.object_mm - point.object_mm).norm(); };
  };
  const PointPair first = farthest(from(pairs[0]));
  const PointPair second = farthest(from(first));
  const Eigen::Vector3d along = second.object_mm - first.object_mm;
  const PointPair third = farthest([&](const PointPair& point) {
    return along.cross(point.object_mm - first.object_mm).norm();
  });
  return {first, second, third};
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

PoseRefusal find_seeds(const PoseModel& model, const RimList& rims, std::int32_t min_tubes,
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
  for (const auto& T : solve_three_points(wide_triangle(seeds.pairs))) {
    static_cast<void>(seeds.candidates.try_push_back({T, 0.0}));
  }
  polish(seeds);
  std::sort(seeds.candidates.begin(), seeds.candidates.end(),
            [](const PoseCandidate& a, const PoseCandidate& b) { return a.rms < b.rms; });
  return seeds.candidates.empty() ? PoseRefusal::kAddressesContradict : PoseRefusal::kNone;
}

}  // namespace tubesight::core::pose
