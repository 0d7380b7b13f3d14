#include "tests/benchmark/pose_study_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/pose/ellipse_fit.h"
#include "core/pose/projected_center.h"
#include "core/pose/tool_answer.h"

namespace tubesight::benchmark {
namespace {

using core::pose::EllipseMethod;
using core::pose::PlanePoint;

constexpr double kPi = 3.14159265358979323846;
constexpr double kPerPx = 1.0 / 520.0;  // of the plane at unit distance

// An ellipse of half axes 40 and 30 px, 25 degrees up, about (0.2, -0.1).
Eigen::Vector2d ellipse_point(double angle) {
  const double a = 40.0 * kPerPx * std::cos(angle);
  const double b = 30.0 * kPerPx * std::sin(angle);
  const double c = std::cos(25.0 * kPi / 180.0);
  const double s = std::sin(25.0 * kPi / 180.0);
  return {0.2 + c * a - s * b, -0.1 + s * a + c * b};
}

std::vector<PlanePoint> noisy_arc(double start, double arc_deg, double noise_px,
                                  tests::Deviates& deviates) {
  std::vector<PlanePoint> points;
  const int count = static_cast<int>(arc_deg * 100.0 / 360.0);
  for (int i = 0; i < count; ++i) {
    const double angle = start + arc_deg * kPi / 180.0 * i / count;
    const Eigen::Vector2d tangent = ellipse_point(angle + 1e-4) - ellipse_point(angle - 1e-4);
    const Eigen::Vector2d normal = Eigen::Vector2d(tangent.y(), -tangent.x()).normalized();
    const Eigen::Vector2d p = ellipse_point(angle) + noise_px * kPerPx * deviates.normal() * normal;
    PlanePoint point;
    point.x = p.x();
    point.y = p.y();
    point.x_u = kPerPx;
    point.y_v = kPerPx;
    point.weight = 1.0 / (noise_px * noise_px);
    points.push_back(point);
  }
  return points;
}

// Bias towards the middle of the arc (positive: the centre is put too near to it: too small an
// ellipse) and RMS, px.
void print_ellipse_cell(EllipseMethod method, double arc_deg, double noise_px, int fits) {
  tests::Deviates deviates(7);
  double inwards = 0.0;
  double square = 0.0;
  int failed = 0;
  for (int i = 0; i < fits; ++i) {
    const double start = 2.0 * kPi * deviates.uniform();
    std::vector<PlanePoint> points = noisy_arc(start, arc_deg, noise_px, deviates);
    core::pose::EllipseOptions options;
    options.method = method;
    options.robust_rounds = 0;
    const auto fit = core::pose::fit_ellipse(points, options);
    if (!fit) {
      ++failed;
      continue;
    }
    const Eigen::Vector2d center(0.2, -0.1);
    const Eigen::Vector2d off = (core::pose::center_of(fit->conic) - center) / kPerPx;
    inwards += off.dot((ellipse_point(start + 0.5 * arc_deg * kPi / 180.0) - center).normalized());
    square += off.squaredNorm();
  }
  const double count = std::max(fits - failed, 1);
  std::printf(" %+.3f / %.3f%s |", inwards / count, std::sqrt(square / count),
              failed > 0 ? (" (" + std::to_string(failed) + " failed)").c_str() : "");
}

// Quality of a fit: RMS of the points that it used / of every fourth, left out, that it predicts.
void print_withheld_cell(EllipseMethod method, double arc_deg, int fits) {
  tests::Deviates deviates(7);
  double used2 = 0.0;
  double withheld2 = 0.0;
  double count = 0.0;
  for (int i = 0; i < fits; ++i) {
    std::vector<PlanePoint> points =
        noisy_arc(2.0 * kPi * deviates.uniform(), arc_deg, 0.1, deviates);
    core::pose::EllipseOptions options;
    options.method = method;
    options.robust_rounds = 0;
    options.withhold = true;
    if (const auto fit = core::pose::fit_ellipse(points, options)) {
      used2 += fit->rms_px * fit->rms_px;
      withheld2 += fit->withheld_rms_px * fit->withheld_rms_px;
      count += 1.0;
    }
  }
  count = std::max(count, 1.0);
  std::printf(" %.4f / %.4f |", std::sqrt(used2 / count), std::sqrt(withheld2 / count));
}

// The image of a tube-end's centre in the four ways.
enum class Way : std::uint8_t { kEllipse, kTangentPoints, kTangentLines, kFromPose };
constexpr std::array<Way, 4> kWays = {Way::kEllipse, Way::kTangentPoints, Way::kTangentLines,
                                      Way::kFromPose};

struct CenterErrors {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double square = 0.0;
  double count = 0.0;
};

// One picture's ellipses, and the pose found from them.
void add_picture(StudyScene& scene, const tests::ToolPlace& place,
                 std::array<std::vector<CenterErrors>, 4>& errors) {
  const auto outcome = scene.estimate(core::pose::PoseMethod::kCenters);
  if (!outcome.has_value()) {
    return;
  }
  const auto& centers = scene.workspace().centers;
  const std::span<const core::pose::SeenCircle> circles(centers.circles.data(), centers.count);
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const auto rim = static_cast<std::size_t>(centers.rim[i]);
    const auto truth = scene.sheet().image_of(place, scene.rims()[centers.rim[i]].address);
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      Eigen::Vector2d point = core::pose::center_of(circles[i].conic);
      if (kWays[way] == Way::kFromPose) {
        const auto& T = outcome.estimate.T_camera_sheet;
        const double radius =
            core::pose::apparent_radius(T, circles[i], 0.5 * scene.model().bore_mm);
        point += core::pose::eccentricity(T, circles[i].center_mm, radius);
      } else if (kWays[way] != Way::kEllipse) {
        const auto made = core::pose::construct_center(
            circles, i,
            kWays[way] == Way::kTangentPoints ? core::pose::CenterConstruction::kTangentPoints
                                              : core::pose::CenterConstruction::kTangentLines,
            40.0);
        if (!made) {
          continue;
        }
        point = *made;
      }
      const auto pixel = scene.model().camera.to_pixel({point.x(), point.y()});
      if (pixel) {
        const Eigen::Vector2d off(pixel->x - truth[0], pixel->y - truth[1]);
        CenterErrors& sum = errors[way][rim];
        sum.sum += off;
        sum.square += off.squaredNorm();
        sum.count += 1.0;
      }
    }
  }
}

}  // namespace

void print_ellipse_table(int fits) {
  std::printf("\n### Ellipse fits\n\n");
  std::printf(
      "Centre of an ellipse of 80 by 60 px from 100 points all round (fewer on arcs), %d"
      " fits:\nbias towards the arc / RMS, px.\n\n",
      fits);
  std::printf(
      "| arc | noise px | linear regression | direct (ellipse-specific) | Taubin |"
      " gradient-weighted |\n|---|---|---|---|---|---|\n");
  for (const double arc_deg : {360.0, 240.0, 180.0, 120.0}) {
    for (const double noise_px : {0.05, 0.1, 0.3}) {
      std::printf("| %.0f° | %.2f |", arc_deg, noise_px);
      for (const EllipseMethod method : {EllipseMethod::kLinear, EllipseMethod::kDirect,
                                         EllipseMethod::kTaubin, EllipseMethod::kSampson}) {
        print_ellipse_cell(method, arc_deg, noise_px, fits);
      }
      std::printf("\n");
    }
  }
  std::printf(
      "\nQuality at 0.1 px of noise: RMS of the points used / of every fourth, withheld from the"
      " fit, px.\n\n"
      "| arc | linear regression | direct (ellipse-specific) | Taubin | gradient-weighted |\n"
      "|---|---|---|---|---|\n");
  for (const double arc_deg : {360.0, 240.0, 180.0, 120.0}) {
    std::printf("| %.0f° |", arc_deg);
    for (const EllipseMethod method : {EllipseMethod::kLinear, EllipseMethod::kDirect,
                                       EllipseMethod::kTaubin, EllipseMethod::kSampson}) {
      print_withheld_cell(method, arc_deg, fits);
    }
    std::printf("\n");
  }
}

void print_center_table(StudyScene& scene, int pictures) {
  std::printf(
      "\n### Centres\n\nImages of the centres of 25 tube-ends, 40 mm below the sheet, %d"
      " pictures of one pose:\nRMS over tube-ends of the mean error (bias) / of its"
      " deviations (scatter), px.\n\n",
      pictures);
  std::printf(
      "| noise px | bores mm | centre of the ellipse | tangent points | tangent lines |"
      " eccentricity from the pose |\n|---|---|---|---|---|---|\n");
  const tests::ToolPlace place{762.4, 457.0, 40.0, 33.0, 0.4, -0.7};
  for (const auto& [noise_px, bore_mm] :
       {std::array<double, 2>{0.0, 0.0}, std::array<double, 2>{0.05, 0.0},
        std::array<double, 2>{0.1, 0.0}, std::array<double, 2>{0.3, 0.0},
        std::array<double, 2>{0.0, 0.06}, std::array<double, 2>{0.1, 0.06}}) {
    std::array<std::vector<CenterErrors>, 4> errors;
    Trial trial;
    trial.look.noise_px = noise_px;
    trial.look.bore_sigma_mm = bore_mm;
    for (int i = 0; i < pictures; ++i) {
      tests::Deviates deviates(static_cast<std::uint64_t>(i) + 31);
      scene.see(trial, place, deviates);
      for (auto& list : errors) {
        list.resize(static_cast<std::size_t>(scene.rims().size()));
      }
      add_picture(scene, place, errors);
    }
    std::printf("| %.2f | %.2f |", noise_px, bore_mm);
    for (const auto& list : errors) {
      double bias2 = 0.0;
      double scatter2 = 0.0;
      double tubes = 0.0;
      for (const CenterErrors& e : list) {
        if (e.count > 0.0) {
          const double mean2 = (e.sum / e.count).squaredNorm();
          bias2 += mean2;
          scatter2 += std::max(e.square / e.count - mean2, 0.0);
          tubes += 1.0;
        }
      }
      std::printf(" %.3f / %.3f |", std::sqrt(bias2 / tubes), std::sqrt(scatter2 / tubes));
    }
    std::printf("\n");
  }
}

}  // namespace tubesight::benchmark
