#include "tests/benchmark/pose_study_methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "core/pose/four_point.h"
#include "core/pose/n_point.h"
#include "core/pose/projected_center.h"
#include "core/pose/three_point.h"
#include "core/pose/tool_answer.h"

namespace tubesight::benchmark {
namespace {

using namespace core::pose;
using CameraSheet = core::Transform<core::frames::Camera, core::frames::Sheet>;

// A square of tube-ends beside the guidetube, as the source's Fig. 5.18 takes them.
constexpr std::array<core::TubeAddress, 4> kSquare = {{{18, 30}, {19, 30}, {18, 31}, {19, 31}}};

enum class PointMethod : std::uint8_t { kThree, kFour, kSome, kAll, kAllFocal };

// Images of the tube-ends' centres of one picture, corrected by their eccentricity: those of
// kSquare first, in its order. None when a rim of them is not wholly in view.
bool corrected_centers(StudyScene& scene, PointPairList& pairs) {
  pairs.clear();
  const PoseOutcome outcome = scene.estimate(PoseMethod::kCenters);
  const CenterFitWorkspace& centers = scene.workspace().centers;
  const auto add = [&](std::size_t i) {
    const SeenCircle& circle = centers.circles[i];
    const CameraSheet& T = outcome.estimate.T_camera_sheet;
    const double radius = apparent_radius(T, circle, 0.5 * scene.model().bore_mm);
    static_cast<void>(
        pairs.try_push_back({{circle.center_mm.x(), circle.center_mm.y(), 0.0},
                             center_of(circle.conic) + eccentricity(T, circle.center_mm, radius),
                             centers.sigma[i]}));
  };
  const auto in_square = [&](std::size_t i, core::TubeAddress address) {
    return scene.rims()[centers.rim[i]].address == address;
  };
  for (const core::TubeAddress address : kSquare) {
    for (std::size_t i = 0; i < centers.count && outcome.has_value(); ++i) {
      if (in_square(i, address)) {
        add(i);
      }
    }
  }
  if (pairs.size() < 4) {
    return false;
  }
  for (std::size_t i = 0; i < centers.count; ++i) {
    if (std::none_of(kSquare.begin(), kSquare.end(),
                     [&](core::TubeAddress address) { return in_square(i, address); })) {
      add(i);
    }
  }
  return true;
}

// Of three points' solutions the one nearest to the truth: what the method can do at best.
std::optional<CameraSheet> solve(PointMethod method, const PointPairList& pairs,
                                 const CameraSheet& truth) {
  const std::array<PointPair, 4> four = {pairs[0], pairs[1], pairs[2], pairs[3]};
  if (method == PointMethod::kThree) {
    std::optional<CameraSheet> best;
    for (const CameraSheet& T : solve_three_points({four[0], four[1], four[2]})) {
      const auto off = [&](const CameraSheet& any) {
        return (any.rotation() - truth.rotation()).norm();
      };
      best = !best || off(T) < off(*best) ? T : *best;
    }
    return best;
  }
  if (method == PointMethod::kFour) {
    const auto pose = solve_four_points(four);
    return pose ? std::optional(pose->T_camera_sheet) : std::nullopt;
  }
  NPointOptions options;
  options.free_focal_length = method == PointMethod::kAllFocal;
  const auto pose = solve_n_point(
      method == PointMethod::kSome ? pairs.view().first(4) : pairs.view(), truth, options);
  return pose ? std::optional(pose->T_camera_sheet) : std::nullopt;
}

void print_row(StudyScene& scene, const char* name, PointMethod method, double noise_px,
               int poses) {
  Trial trial;
  trial.look.noise_px = noise_px;
  int solved = 0;
  double lateral2 = 0.0;
  double worst = 0.0;
  double height2 = 0.0;
  double tilt2 = 0.0;
  int seen = 0;
  for (int i = 0; i < poses; ++i) {
    tests::Deviates deviates(static_cast<std::uint64_t>(i) + 17);
    const tests::ToolPlace where = scene.place(trial, deviates);
    scene.see(trial, where, deviates);
    PointPairList pairs;
    if (!corrected_centers(scene, pairs)) {
      continue;
    }
    ++seen;
    const core::Transform<core::frames::Sheet, core::frames::Tool> T_sheet_tool(
        core::rotation_from_degrees({where.alpha_deg, where.beta_deg, where.gamma_deg}),
        {where.x_mm, where.y_mm, -where.height_mm});
    const auto pose = solve(method, pairs, scene.model().T_camera_tool * T_sheet_tool.inverse());
    if (!pose) {
      continue;
    }
    ++solved;
    PoseEstimate estimate;
    estimate.T_sheet_tool = tool_pose(*pose, scene.model().T_camera_tool);
    const core::math::Vector6d error = error_of(estimate, where);
    lateral2 += error.head<2>().squaredNorm();
    worst = std::max(worst, error.head<2>().norm());
    height2 += error(2) * error(2);
    tilt2 += error.segment<2>(3).squaredNorm();
  }
  const double count = std::max(solved, 1);
  std::printf("| %s | %.2f | %d of %d | %.4f | %.4f | %.4f | %.4f |\n", name, noise_px, solved,
              seen, std::sqrt(lateral2 / count), worst, std::sqrt(height2 / count),
              std::sqrt(tilt2 / count) * 57.29577951308232);
}

}  // namespace

void print_point_table(StudyScene& scene, int poses) {
  std::printf(
      "\n### Points\n\nThe source's methods on corrected centres: four tube-ends in a square, or"
      " all in view of 25.\n\n| method | noise px | solved | lateral mm | worst mm | height mm |"
      " tilt deg |\n|---|---|---|---|---|---|---|\n");
  for (const double noise_px : {0.02, 0.1}) {
    print_row(scene, "three points, the best solution", PointMethod::kThree, noise_px, poses);
    print_row(scene, "four points, distances", PointMethod::kFour, noise_px, poses);
    print_row(scene, "the same four, n points", PointMethod::kSome, noise_px, poses);
    print_row(scene, "all, n points", PointMethod::kAll, noise_px, poses);
    print_row(scene, "all, n points, EFL free", PointMethod::kAllFocal, noise_px, poses);
  }
}

}  // namespace tubesight::benchmark
