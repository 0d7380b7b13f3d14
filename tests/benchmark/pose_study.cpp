// The simulation studies of docs/accuracy.md: `pose_study [--poses N] [--plot FILE.png]`.
//
// Rim points of synthetic sheets, projected without the code under study, with normal noise across
// the edge. Prints Markdown tables; the same numbers every time.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "board/bench/output/line_plot.h"
#include "core/overlay/palette.h"
#include "core/pose/calibration_uncertainty.h"
#include "tests/benchmark/pose_study_methods.h"
#include "tests/benchmark/pose_study_points.h"
#include "tests/benchmark/pose_study_scene.h"

namespace tubesight::benchmark {
namespace {

using board::Panel;
using board::Series;
using board::write_plot;

constexpr core::overlay::Rgb kLateral{200, 40, 30};
constexpr core::overlay::Rgb kHeight{30, 90, 200};
constexpr core::overlay::Rgb kTold{120, 120, 120};

struct Study {
  std::string name;      // heading
  std::string argument;  // first column, with its unit
  std::vector<double> values;
  std::function<void(Trial&, double)> set;
};

std::vector<Study> studies() {
  return {
      {"Noise",
       "noise px",
       {0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5},
       [](Trial& t, double v) { t.look.noise_px = v; }},
      {"Number of tubes",
       "nearest tubes",
       {3, 4, 5, 6, 9, 16, 25, 49, 81},
       [](Trial& t, double v) { t.tubes = static_cast<std::size_t>(v); }},
      {"Height",
       "height mm",
       {0, 20, 40, 60, 90, 130, 180},
       [](Trial& t, double v) { t.height_mm = v; }},
      {"Angle",
       "lean deg",
       {0, 1, 2, 5, 10, 15},
       [](Trial& t, double v) {
         t.lean_deg = v;
         t.fixed_lean = true;
       }},
      {"Pitch error",
       "sigma mm",
       {0.0, 0.01, 0.03, 0.06, 0.127},
       [](Trial& t, double v) { t.look.center_sigma_mm = v; }},
      {"Tube-ends out of the plane",
       "sigma mm",
       {0.0, 0.05, 0.1, 0.2, 0.5, 1.0},
       [](Trial& t, double v) { t.look.height_sigma_mm = v; }},
      {"Arc of the rims that shows",
       "arc deg",
       {120, 180, 240, 360},
       [](Trial& t, double v) {
         t.look.arc_deg = v;
         t.look.points = static_cast<std::int32_t>(64.0 * v / 360.0);
       }},
      {"False points",
       "share of points",
       {0.0, 0.05, 0.1, 0.2, 0.3},
       [](Trial& t, double v) { t.look.outlier_share = v; }},
  };
}

constexpr const char* kColumns =
    " refused | tubes | lateral mm | worst mm | told mm | height mm | tilt deg | consistency |\n";

void print_row(const TrialResult& r) {
  std::printf(" %d | %.1f | %.4f | %.4f | %.4f | %.4f | %.4f | %.2f |\n", r.refused, r.tubes,
              r.lateral_mm, r.worst_mm, r.sigma_mm, r.height_mm, r.tilt_deg, r.consistency);
}

Panel run_study(StudyScene& scene, const Study& study, int poses) {
  std::printf("\n### %s\n\n| %s |%s|---|---|---|---|---|---|---|---|---|\n", study.name.c_str(),
              study.argument.c_str(), kColumns);
  Panel panel{
      study.name,
      study.argument,
      "mm",
      {{"lateral", kLateral, {}, true}, {"height", kHeight, {}, true}, {"told", kTold, {}, true}}};
  for (const double value : study.values) {
    Trial trial;
    study.set(trial, value);
    const TrialResult r = scene.run(trial, poses);
    std::printf("| %g |", value);
    print_row(r);
    panel.series[0].points.push_back({value, r.lateral_mm});
    panel.series[1].points.push_back({value, r.height_mm});
    panel.series[2].points.push_back({value, r.sigma_mm});
  }
  return panel;
}

void run_methods(StudyScene& scene, int poses) {
  using core::pose::PoseMethod;
  std::printf(
      "\n### Methods\n\n| method | nearest tubes |%s|---|---|---|---|---|---|---|---|---|---|\n",
      kColumns);
  const std::array<std::pair<const char*, PoseMethod>, 5> methods = {
      {{"all rims at once", PoseMethod::kRims},
       {"centres, eccentricity from the pose", PoseMethod::kCenters},
       {"centres from tangent points", PoseMethod::kTangentPoints},
       {"centres from tangent lines", PoseMethod::kTangentLines},
       {"centres of ellipses", PoseMethod::kEllipseCenters}}};
  for (const std::size_t tubes : {9U, 81U}) {
    for (const auto& [name, method] : methods) {
      Trial trial;
      trial.tubes = tubes;
      trial.method = method;
      std::printf("| %s | %zu |", name, tubes);
      print_row(scene.run(trial, poses));
    }
  }
}

// What one calibrated parameter's error does at one pose: 25 tubes from 10 mm and from 90 mm.
void print_sensitivity(StudyScene& scene, double height_mm, Panel& panel) {
  const std::array<const char*, 12> names = {"EFL",    "h_sx",  "c_u",    "c_v",
                                             "k",      "k2",    "tool x", "tool y",
                                             "tool z", "alpha", "beta",   "gamma"};
  const std::array<const char*, 12> units = {"mm", "",   "px", "px",  "/mm2", "/mm4",
                                             "mm", "mm", "mm", "deg", "deg",  "deg"};
  const std::array<double, 12> changes = {0.005, 0.001, 1.0, 1.0, 1e-4, 1e-5,
                                          0.1,   0.1,   0.1, 0.1, 0.1,  0.1};
  const tests::ToolPlace place{762.4, 457.0, height_mm, 33.0, 0.4, -0.7};
  Trial trial;
  trial.look = {};
  tests::Deviates deviates(1);
  scene.see(trial, place, deviates);
  const auto outcome = scene.estimate(core::pose::PoseMethod::kRims);
  if (!outcome.has_value()) {
    std::printf("no pose at %.0f mm\n", height_mm);
    return;
  }
  std::array<double, 6> steps{};
  std::copy_n(changes.begin(), 6, steps.begin());
  const auto by_camera = core::pose::camera_sensitivity(
      scene.model(), scene.rims(), outcome.estimate, steps, {}, scene.workspace());
  const auto by_tool = core::pose::tool_sensitivity(scene.model(), outcome.estimate);
  Series series{std::to_string(static_cast<int>(height_mm)) + " mm below",
                height_mm < 50.0 ? kLateral : kHeight,
                {},
                false};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i % 6);
    const core::math::Vector6d slope = i < 6 ? by_camera->col(column) : by_tool.col(column);
    const core::math::Vector6d error = slope * changes[i];
    std::printf("| %.0f | %s | %g %s | %.4f | %.4f | %.4f | %.4f |\n", height_mm, names[i],
                changes[i], units[i], error.head<2>().norm(), std::abs(error(2)),
                error.segment<2>(3).norm() * 57.29577951308232,
                std::abs(error(5)) * 57.29577951308232);
    series.points.push_back(
        {static_cast<double>(i + 1) + (height_mm < 50.0 ? 0.0 : 0.25), error.head<2>().norm()});
  }
  panel.series.push_back(series);
}

Panel run_sensitivity(StudyScene& scene) {
  std::printf(
      "\n### Calibrated parameters\n\n| height mm | parameter | error | lateral mm |"
      " height mm | tilt deg | heading deg |\n|---|---|---|---|---|---|---|\n");
  Panel panel{"Lateral error by parameter (order of the table)", "parameter", "mm", {}};
  print_sensitivity(scene, 10.0, panel);
  print_sensitivity(scene, 90.0, panel);
  return panel;
}

int run(int poses, const std::string& plot) {
  StudyScene scene;
  std::printf(
      "Source's camera and tool, square pitch 25.4 mm; where nothing else is said: 25"
      " nearest tubes as far as in\nview, 64 points a rim, 0.1 px of noise, bores of 0.06 mm"
      " deviation, 10 to 90 mm below the sheet, any heading,\nlean of 0.7 degrees deviation,"
      " %d poses. `told` is the estimate's own lateral sigma, `consistency` the mean\n"
      "normalised squared error (1: the covariance is true).\n",
      poses);
  print_ellipse_table(10 * poses);
  print_center_table(scene, 2 * poses);
  print_point_table(scene, poses);
  run_methods(scene, poses);
  std::vector<Panel> panels;
  for (const Study& study : studies()) {
    panels.push_back(run_study(scene, study, poses));
  }
  panels.push_back(run_sensitivity(scene));
  std::string message;
  if (!plot.empty() && !write_plot(plot, panels, message)) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace tubesight::benchmark

int main(int count, char** words) {
  int poses = 100;
  std::string plot;
  for (int i = 1; i < count; i += 2) {
    const std::string word = words[i];
    if (i + 1 < count && word == "--poses") {
      poses = std::atoi(words[i + 1]);
    } else if (i + 1 < count && word == "--plot") {
      plot = words[i + 1];
    } else {
      poses = 0;
    }
  }
  if (poses < 1) {
    std::fprintf(stderr, "usage: pose_study [--poses N] [--plot FILE.png]\n");
    return 2;
  }
  return tubesight::benchmark::run(poses, plot);
}
