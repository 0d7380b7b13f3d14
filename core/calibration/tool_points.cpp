#include "core/calibration/tool_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/calibration/angle_slope.h"
#include "core/math/rotation.h"
#include "core/math/small_matrix.h"
#include "core/pose/n_point.h"
#include "core/pose/three_point.h"

namespace tubesight::core::calibration {
namespace {

using pose::PointPair;
/// The solvers speak of a sheet; here the object is the tool.
using Pose = Transform<frames::Camera, frames::Sheet>;
using PairList = StaticVector<PointPair, kMaxToolPoints>;

constexpr double kExpected_px = 0.1;  // a point found with care
constexpr double kPriorMisses = 4.0;
constexpr double kNear_px = 3.0;      // of the pose of three points, which has their errors
constexpr double kMiss_px = 1.5;      // what a point adds to a pose that leaves it out
constexpr double kLeastOff_px = 0.5;  // nearer points are never left out
constexpr double kMostRms_px = 2.0;   // of points that are any
constexpr double kPoor_px = 0.3;      // worth a look in the mirror
constexpr double kMostSigma_mm = 1.0;
constexpr double kRivalRatio = 2.0;
constexpr double kFlat = 0.01;
constexpr std::int32_t kMostTriples = 3000;
constexpr std::int32_t kKept = 6;  // poses of three points that are fitted to all

/// One reading of the points, as they are or mirrored.
class PointFit {
 public:
  PointFit(const camera::CameraModel<double>& camera, const ToolPointList& points, double mirror)
      : camera_(camera), points_(points) {
    const double sigma = kExpected_px / camera.parameters().scale_px.x;
    for (const ToolPoint& point : points) {
      const auto plane = camera.to_plane({point.seen_px.x(), point.seen_px.y()});
      const Eigen::Vector3d place(mirror * point.place_mm.x(), point.place_mm.y(),
                                  point.place_mm.z());
      static_cast<void>(pairs_.try_push_back({place, {plane.x, plane.y}, sigma}));
    }
  }

  struct Candidate {
    Pose pose;
    math::Matrix6d covariance = math::Matrix6d::Zero();
    double rms_px = std::numeric_limits<double>::max();
    double cost = std::numeric_limits<double>::max();  ///< squares, each held at that of a miss
    std::int32_t used = 0;
    std::array<bool, kMaxToolPoints> uses{};
  };

  /// The pose that fits the points best; false where none has half of them. `rival` is the best of
  /// those that differ.
  bool find(Candidate& best, Candidate& rival) {
    collect();
    for (std::int32_t i = 0; i < kept_.size(); ++i) {
      Candidate next;
      if (!refine(kept_[i].pose, next)) {
        continue;
      }
      if (better(next, best)) {
        std::swap(next, best);
      }
      if (next.used > 0 && !same(next, best) && better(next, rival)) {
        rival = next;
      }
    }
    if (same(rival, best)) {
      rival = {};
    }
    return 2 * best.used >= points_.size() && best.used >= 4;
  }

  /// From where the pose puts point i to where it is seen; huge behind the camera.
  [[nodiscard]] Eigen::Vector2d off_px(const Pose& pose, std::int32_t i) const {
    const Eigen::Vector3d p = pose * pairs_[i].object_mm;
    const double far = 1e6;
    if (!(p.z() > 1.0)) {
      return {far, far};
    }
    const auto pixel = camera_.to_pixel({p.x() / p.z(), p.y() / p.z()});
    return pixel ? points_[i].seen_px - Eigen::Vector2d(pixel->x, pixel->y)
                 : Eigen::Vector2d(far, far);
  }

 private:
  struct Kept {
    Pose pose;
    double score = 0.0;
  };

  [[nodiscard]] static bool better(const Candidate& a, const Candidate& b) {
    return a.cost < b.cost;
  }
  [[nodiscard]] static bool same(const Candidate& a, const Candidate& b) {
    return (a.pose.rotation() - b.pose.rotation()).norm() < 0.02;
  }

  void collect() {
    kept_.clear();
    const std::int32_t n = pairs_.size();
    const std::int32_t triples = n * (n - 1) * (n - 2) / 6;
    const std::int32_t stride = std::max(1, triples / kMostTriples);
    std::int32_t number = 0;
    for (std::int32_t i = 0; i < n; ++i) {
      for (std::int32_t j = 0; j < i; ++j) {
        for (std::int32_t k = 0; k < j; ++k) {
          if (number++ % stride == 0) {
            take({pairs_[i], pairs_[j], pairs_[k]});
          }
        }
      }
    }
  }

  void take(const std::array<PointPair, 3>& three) {
    for (const Pose& pose : pose::solve_three_points(three)) {
      double score = 0.0;  // less is better: each point at most 1
      for (std::int32_t i = 0; i < pairs_.size(); ++i) {
        score += std::min(1.0, off_px(pose, i).squaredNorm() / (kNear_px * kNear_px));
      }
      keep({pose, score});
    }
  }

  /// The best of each direction: poses that differ by less than some degrees become one.
  void keep(const Kept& next) {
    for (std::int32_t i = 0; i < kept_.size(); ++i) {
      if ((kept_[i].pose.rotation() - next.pose.rotation()).norm() < 0.1) {
        if (next.score < kept_[i].score) {
          kept_[i] = next;
        }
        return;
      }
    }
    if (kept_.try_push_back(next)) {
      return;
    }
    std::int32_t worst = 0;
    for (std::int32_t i = 1; i < kept_.size(); ++i) {
      worst = kept_[i].score > kept_[worst].score ? i : worst;
    }
    if (next.score < kept_[worst].score) {
      kept_[worst] = next;
    }
  }

  /// Least squares over the points near a pose, which are chosen anew until they stay.
  bool refine(const Pose& start, Candidate& result) {
    result.pose = start;
    double limit = first_limit(start);
    for (int round = 0; round < 8; ++round) {
      PairList chosen;
      std::array<bool, kMaxToolPoints> uses{};
      for (std::int32_t i = 0; i < pairs_.size(); ++i) {
        uses[static_cast<std::size_t>(i)] = off_px(result.pose, i).norm() < limit;
        if (uses[static_cast<std::size_t>(i)]) {
          static_cast<void>(chosen.try_push_back(pairs_[i]));
        }
      }
      if (chosen.size() < 4) {
        return false;
      }
      const auto fit = pose::solve_n_point(chosen.view(), result.pose, {});
      if (!fit) {
        return false;
      }
      const bool stays = round > 1 && uses == result.uses;
      result.pose = fit->T_camera_sheet;
      result.covariance = fit->covariance;
      result.uses = uses;
      result.used = chosen.size();
      measure(result);
      if (stays) {
        return true;
      }
      limit = std::max(kLeastOff_px, 5.0 * result.rms_px / std::numbers::sqrt2);
    }
    return true;
  }

  /// A wrong point must not be taken in at first, as it would bend the fit until it stays: four
  /// times the median miss of a pose of three points.
  [[nodiscard]] double first_limit(const Pose& pose) const {
    std::array<double, kMaxToolPoints> sizes{};
    const auto count = static_cast<std::ptrdiff_t>(pairs_.size());
    for (std::int32_t i = 0; i < pairs_.size(); ++i) {
      sizes[static_cast<std::size_t>(i)] = off_px(pose, i).norm();
    }
    std::nth_element(sizes.begin(), sizes.begin() + count / 2, sizes.begin() + count);
    return std::clamp(4.0 * sizes[static_cast<std::size_t>(count / 2)], kLeastOff_px,
                      2.0 * kNear_px);
  }

  void measure(Candidate& candidate) const {
    double square = 0.0;
    candidate.cost = 0.0;
    for (std::int32_t i = 0; i < pairs_.size(); ++i) {
      const double off2 = off_px(candidate.pose, i).squaredNorm();
      candidate.cost += std::min(off2, kMiss_px * kMiss_px);
      square += candidate.uses[static_cast<std::size_t>(i)] ? off2 : 0.0;
    }
    candidate.rms_px = std::sqrt(square / std::max(1, candidate.used));
  }

  const camera::CameraModel<double>& camera_;
  const ToolPointList& points_;
  PairList pairs_;
  StaticVector<Kept, kKept> kept_;
};

/// How the points lie: their extents along three axes, and the plane of most of them.
struct Shape {
  Eigen::Vector3d middle_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d extents_mm = Eigen::Vector3d::Zero();  ///< from the least on
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

Shape shape_of(const ToolPointList& points) {
  Shape shape;
  for (const ToolPoint& point : points) {
    shape.middle_mm += point.place_mm / points.size();
  }
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const ToolPoint& point : points) {
    const Eigen::Vector3d off = point.place_mm - shape.middle_mm;
    moments += off * off.transpose() / points.size();
  }
  const math::SymmetricEigen<3> eigen(moments);
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return eigen.values(a) < eigen.values(b); });
  for (int i = 0; i < 3; ++i) {
    shape.extents_mm(i) =
        std::sqrt(std::max(0.0, eigen.values(order[static_cast<std::size_t>(i)])));
  }
  shape.normal = eigen.vectors.col(order[0]);
  return shape;
}

/// Whether the pose sees what nobody can see: the guidetube pointing to the camera, or a plane of
/// points from the side where the tip is.
bool from_inside(const Pose& pose, const Shape& shape, bool coplanar) {
  if (pose.rotation()(2, 2) <= 0.0) {
    return true;
  }
  const double plane_mm = shape.normal.dot(shape.middle_mm);  // of the tip, along the normal
  if (!coplanar || std::abs(plane_mm) < 0.5) {
    return false;
  }
  const Eigen::Vector3d camera_mm = pose.inverse().translation_mm();
  const double beyond_mm = shape.normal.dot(camera_mm) - plane_mm;
  return beyond_mm * plane_mm <= 0.0;
}

void fill(const PointFit::Candidate& best, double sigma_px, ToolCalibration& tool) {
  const Eigen::Matrix3d rotation = math::orthonormal(best.pose.rotation());
  tool.T_camera_tool = {rotation, best.pose.translation_mm()};
  const std::array<double, 3> angles = math::angles_of(rotation);
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  tool.values << best.pose.translation_mm(), kDegrees * angles[0], kDegrees * angles[1],
      kDegrees * angles[2];
  math::Matrix6d slope = math::Matrix6d::Identity();
  slope.bottomRightCorner<3, 3>() = angle_slope_deg(rotation);
  const double scale = sigma_px / kExpected_px;
  const math::Matrix6d half = slope.lazyProduct(best.covariance);
  tool.covariance = scale * scale * half.lazyProduct(slope.transpose());
}

ToolPointsRefusal judge(const PointFit::Candidate& best, const PointFit::Candidate& rival,
                        const Shape& shape, ToolPointsOutcome& outcome) {
  const bool even =
      rival.used >= best.used && rival.rms_px < kRivalRatio * best.rms_px + kExpected_px;
  const bool inside = from_inside(best.pose, shape, outcome.coplanar);
  if (even && (inside || !from_inside(rival.pose, shape, outcome.coplanar))) {
    return ToolPointsRefusal::kAmbiguous;
  }
  if (inside) {
    return ToolPointsRefusal::kMirrored;
  }
  if (3 * best.used < 2 * outcome.points.size() || best.used < kLeastToolPoints - 1) {
    return ToolPointsRefusal::kManyOutliers;
  }
  return outcome.tool.covariance.diagonal().head<3>().maxCoeff() <= kMostSigma_mm * kMostSigma_mm
             ? ToolPointsRefusal::kNone
             : ToolPointsRefusal::kUncertain;
}

}  // namespace

ToolPointsOutcome tool_from_points(const camera::CameraModel<double>& camera,
                                   const ToolPointList& points) {
  ToolPointsOutcome outcome;
  if (points.size() < kLeastToolPoints) {
    outcome.refusal = ToolPointsRefusal::kTooFew;
    return outcome;
  }
  const Shape shape = shape_of(points);
  if (!(shape.extents_mm(1) > kFlat * shape.extents_mm(2))) {
    outcome.refusal = ToolPointsRefusal::kOneLine;
    return outcome;
  }
  outcome.coplanar = shape.extents_mm(0) < kFlat * shape.extents_mm(2);
  PointFit fit(camera, points, 1.0);
  PointFit::Candidate best;
  PointFit::Candidate rival;
  const bool found = fit.find(best, rival) && best.rms_px < kMostRms_px;
  if (!found || best.used < points.size() || best.rms_px > kPoor_px) {
    // Some points of a mirrored order always fit; as they are, more do or better.
    PointFit mirrored(camera, points, -1.0);
    PointFit::Candidate other;
    PointFit::Candidate unused;
    const bool fits = mirrored.find(other, unused) && other.rms_px < kMostRms_px;
    if (fits && (!found || 3.0 * other.cost < best.cost)) {
      outcome.refusal = ToolPointsRefusal::kMirrored;
      return outcome;
    }
  }
  if (!found) {
    outcome.refusal = ToolPointsRefusal::kNoPose;
    return outcome;
  }
  for (std::int32_t i = 0; i < points.size(); ++i) {
    static_cast<void>(outcome.points.try_push_back(
        {best.uses[static_cast<std::size_t>(i)], fit.off_px(best.pose, i)}));
  }
  outcome.used = best.used;
  outcome.rms_px = best.rms_px;
  outcome.second_px = rival.used > 0 ? rival.rms_px : 0.0;
  const double square = best.rms_px * best.rms_px * best.used;
  outcome.sigma_px = std::sqrt((square + kPriorMisses * kExpected_px * kExpected_px) /
                               (2.0 * best.used - 6.0 + kPriorMisses));
  fill(best, outcome.sigma_px, outcome.tool);
  outcome.refusal = judge(best, rival, shape, outcome);
  return outcome;
}

}  // namespace tubesight::core::calibration
