// Whole camera calibrations of templates drawn as pictures: is the error what was promised?
//
// Usage: calibration_sessions [SESSIONS] [--first N] [--tip DEG] [--falling-off SHARE] [--each]
//        [--check]
//
// Even sessions have a stage with two heights, odd ones five free poses; camera, places, contrast
// and noise are drawn anew for each. Told, for both kinds and together: the mean of the squared
// error of the camera's parameters by their covariance, a parameter (NEES; 1 is right, below 1 is
// too careful), that of the map over the picture, and how many sessions' halves agree to 2.5 sigma.
// --tip leans the stage's axis by so much (one sigma), --falling-off darkens the corners, --each
// tells each session's errors: squared by the covariance, and the parameters' with their sigmas.
// With --check the status is 1 when a session fails, or more than 2 % are refused as too uncertain
// (a stage, and a lens without distortion: nothing tells a lean from the centre), or NEES is
// outside 0.8..1.2 (0.65..1.4 below 100 sessions, where chance alone needs it) or fewer than 95 %
// of the halves agree. 200 sessions and two minutes of one core by default.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "core/calibration/camera_calibration.h"
#include "core/calibration/halves.h"
#include "core/calibration/target_order.h"
#include "core/detection/lattice_finder.h"
#include "core/math/small_matrix.h"
#include "tests/support/drawn_template.h"

namespace tubesight::tests {
namespace {

using namespace core::calibration;

constexpr double kDegree = std::numbers::pi / 180.0;

struct Wanted {
  int sessions = 200;
  int first = 0;
  double tip_deg = 0.0;
  double falling_off = 0.0;
  bool check = false;
  bool each = false;
};

/// Sums over sessions of a kind.
struct Sums {
  int sessions = 0;
  int failed = 0;
  int refused = 0;       // as too uncertain, which is an answer
  double squares = 0.0;  // of errors by their covariance
  int parameters = 0;
  double map_squares = 0.0;  // of the map's error by what was promised of it
  double map_px2 = 0.0;
  double sigma_px = 0.0;
  int axes = 0;
  int k2 = 0;
  int compared = 0;
  int agree = 0;

  void add(const Sums& other) {
    sessions += other.sessions;
    failed += other.failed;
    refused += other.refused;
    squares += other.squares;
    parameters += other.parameters;
    map_squares += other.map_squares;
    map_px2 += other.map_px2;
    sigma_px += other.sigma_px;
    axes += other.axes;
    k2 += other.k2;
    compared += other.compared;
    agree += other.agree;
  }
  [[nodiscard]] double nees() const { return squares / parameters; }
  void print(const char* name) const {
    const int good = sessions - failed - refused;
    std::printf(
        "%-12s %4d sessions, %d failed, %d refused: NEES %.3f, of the map %.3f; map %.4f px RMS, "
        "residuals' "
        "sigma %.4f px; halves agree to 2.5 sigma in %d of %d; axis freed %d times, k2 %d\n",
        name, sessions, failed, refused, nees(), map_squares / good, std::sqrt(map_px2 / good),
        sigma_px / good, agree, compared, axes, k2);
  }
};

class Session {
 public:
  Session() {
    target_.rows = target_.columns = 10;
    target_.spacing_mm = 8.0;
    target_.row_spacing_mm = 8.0;
    target_.dot_mm = 4.0;
  }

  /// Draws a session, calibrates it and compares it with what it was drawn from.
  [[nodiscard]] Sums run(const Wanted& wanted, std::uint64_t seed, bool staged) {
    random_.seed(seed);
    Sums sums;
    sums.sessions = 1;
    draw_camera(wanted);
    const bool drawn = staged ? draw_stage(wanted) : draw_poses();
    if (!drawn) {
      std::fprintf(stderr, "session %d: no template found\n", static_cast<int>(seed));
      sums.failed = 1;
      return sums;
    }
    const CalibrationOutcome outcome = calibrate_camera(*data_, *state_, *scratch_);
    if (outcome.refusal == CalibrationRefusal::kTooUncertain) {
      sums.refused = 1;
      return sums;
    }
    if (outcome.refusal != CalibrationRefusal::kNone) {
      std::fprintf(stderr, "session %d: refused, %d\n", static_cast<int>(seed),
                   static_cast<int>(outcome.refusal));
      sums.failed = 1;
      return sums;
    }
    judge(wanted, outcome, sums);
    return sums;
  }

 private:
  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  double normal(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }

  void draw_camera(const Wanted& wanted) {
    picture_ = DrawnTemplate();
    picture_.efl_mm = between(4.5, 8.0);
    picture_.scale = between(0.98, 1.03);
    picture_.center_px = {317.0 + normal(4.0), 239.5 + normal(4.0)};
    picture_.k_per_mm2 = between(0.0, 0.01);
    picture_.background = between(5.0, 30.0);
    picture_.inside = between(120.0, 230.0);
    picture_.smear_px = between(0.5, 0.9);
    picture_.noise = between(0.7, 2.0);
    picture_.falling_off = wanted.falling_off;
    data_->sensor = {picture_.column_mm, picture_.row_mm, 1.0 * picture_.width_px,
                     1.0 * picture_.height_px};
    data_->dot_radius_mm = 0.5 * target_.dot_mm;
    data_->dots.clear();
    data_->views.clear();
  }

  void turn(double about_x, double about_y, double about_z) {
    picture_.R_camera_target = (Eigen::AngleAxisd(about_x * kDegree, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(about_y * kDegree, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(about_z * kDegree, Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix();
  }

  [[nodiscard]] bool add_view(const Eigen::Vector3d& middle, bool staged, double height_mm) {
    picture_.t_camera_target = middle - picture_.R_camera_target * Eigen::Vector3d(36.0, 36.0, 0.0);
    CalibrationView view;
    view.first = data_->dots.size();
    view.staged = staged;
    view.height_mm = height_mm;
    const auto seen = picture_.draw(random_, pixels_);
    room_.resize(pixels_.size());
    if (finder_->find(seen, {}, room_, *found_) != core::detection::FinderRefusal::kNone ||
        order_on_target(*found_, target_, data_->dots) != OrderRefusal::kNone) {
      return false;
    }
    view.count = data_->dots.size() - view.first;
    return data_->views.try_push_back(view);
  }

  [[nodiscard]] bool draw_stage(const Wanted& wanted) {
    turn(normal(0.5), normal(0.5), normal(1.5));
    const Eigen::Vector3d axis =
        Eigen::AngleAxisd(normal(wanted.tip_deg) * kDegree, picture_.R_camera_target.col(0)) *
        (Eigen::AngleAxisd(normal(wanted.tip_deg) * kDegree, picture_.R_camera_target.col(1)) *
         picture_.R_camera_target.col(2));
    const Eigen::Vector3d middle(normal(0.5), normal(0.5),
                                 between(84.0, 92.0) * picture_.efl_mm / 5.06);
    const double rise_mm = between(25.0, 45.0);
    return add_view(middle, true, 0.0) && add_view(middle + rise_mm * axis, true, rise_mm);
  }

  [[nodiscard]] bool draw_poses() {
    constexpr std::array<std::array<double, 2>, 5> kTilts = {
        {{27.0, 0.0}, {-27.0, 5.0}, {0.0, 30.0}, {5.0, -30.0}, {20.0, 20.0}}};
    for (const auto& [about_x, about_y] : kTilts) {
      turn(about_x + normal(3.0), about_y + normal(3.0), between(-40.0, 40.0));
      if (!add_view({normal(1.5), normal(1.5), between(112.0, 125.0) * picture_.efl_mm / 5.06},
                    false, 0.0)) {
        return false;
      }
    }
    return true;
  }

  static void print_errors(double squares, const CameraValues& error,
                           const core::math::Matrix6d& covariance) {
    std::printf("%10.3f", squares);
    for (Eigen::Index i = 0; i < error.size(); ++i) {
      std::printf("  %9.2e +- %8.2e", error(i), std::sqrt(covariance(i, i)));
    }
    std::printf("\n");
  }

  void judge(const Wanted& wanted, const CalibrationOutcome& outcome, Sums& sums) {
    CameraValues truth = CameraValues::Zero();
    truth.head<5>() << picture_.efl_mm, picture_.scale, picture_.center_px.x(),
        picture_.center_px.y(), picture_.k_per_mm2;
    const auto& covariance = outcome.fit.camera_covariance;
    const CameraValues error = state_->camera - truth;
    // What is held counts with a variance of its own, so that the matrix is whole.
    auto whole = covariance;
    for (Eigen::Index i = 0; i < error.size(); ++i) {
      const bool free = covariance(i, i) > 0.0;
      sums.parameters += free ? 1 : 0;
      whole(i, i) = free ? covariance(i, i) : 1.0;
    }
    core::math::Cholesky<CameraValues::RowsAtCompileTime> factor;
    const double squares = factor.factor(whole) ? error.dot(factor.solve(error)) : HUGE_VAL;
    sums.squares += squares;
    if (wanted.each) {
      print_errors(squares, error, covariance);
    }
    const double off =
        map_difference(data_->sensor, state_->camera, truth, {0.0, 0.0}, MapGauge::kNone).rms_px;
    sums.map_px2 += off * off;
    sums.map_squares += off * off / (outcome.map.rms_px * outcome.map.rms_px);
    sums.sigma_px += outcome.fit.sigma_px;
    sums.axes += outcome.freed.stage_axis ? 1 : 0;
    sums.k2 += outcome.freed.distortion2 ? 1 : 0;
    const HalvesOutcome halves = compare_halves(*data_, *state_, outcome.freed, *halves_);
    sums.compared += halves.told ? 1 : 0;
    sums.agree += halves.told && halves.sigmas() <= kMostHalvesSigmas ? 1 : 0;
  }

  std::mt19937_64 random_;
  DrawnTemplate picture_;
  Target target_;
  std::vector<std::uint16_t> pixels_;
  std::vector<std::uint16_t> room_;
  std::unique_ptr<core::detection::LatticeFinder> finder_ =
      std::make_unique<core::detection::LatticeFinder>();
  std::unique_ptr<core::detection::FoundLattice> found_ =
      std::make_unique<core::detection::FoundLattice>();
  std::unique_ptr<CalibrationData> data_ = std::make_unique<CalibrationData>();
  std::unique_ptr<CalibrationState> state_ = std::make_unique<CalibrationState>();
  std::unique_ptr<FitScratch> scratch_ = std::make_unique<FitScratch>();
  std::unique_ptr<HalvesScratch> halves_ = std::make_unique<HalvesScratch>();
};

[[nodiscard]] bool parse(int count, char** values, Wanted& wanted) {
  for (int i = 1; i < count; ++i) {
    const std::string_view word = values[i];
    if (word == "--check") {
      wanted.check = true;
    } else if (word == "--each") {
      wanted.each = true;
    } else if (word == "--first" && i + 1 < count) {
      wanted.first = std::atoi(values[++i]);
    } else if (word == "--tip" && i + 1 < count) {
      wanted.tip_deg = std::atof(values[++i]);
    } else if (word == "--falling-off" && i + 1 < count) {
      wanted.falling_off = std::atof(values[++i]);
    } else if ((wanted.sessions = std::atoi(values[i])) < 2) {
      std::fprintf(
          stderr,
          "usage: calibration_sessions [SESSIONS] [--first N] [--tip DEG] [--falling-off SHARE] "
          "[--each] [--check]\n");
      return false;
    }
  }
  return true;
}

[[nodiscard]] bool is_good(const Sums& all) {
  constexpr int kMany = 100;
  const double least = all.sessions < kMany ? 0.65 : 0.8;
  const double most = all.sessions < kMany ? 1.4 : 1.2;
  return all.failed == 0 && all.refused <= 0.02 * all.sessions && all.nees() >= least &&
         all.nees() <= most && all.agree >= 0.95 * all.compared;
}

}  // namespace
}  // namespace tubesight::tests

int main(int count, char** values) {
  tubesight::tests::Wanted wanted;
  if (!tubesight::tests::parse(count, values, wanted)) {
    return 2;
  }
  std::array<tubesight::tests::Sums, 2> kinds;
  const auto session = std::make_unique<tubesight::tests::Session>();
  for (int i = wanted.first; i < wanted.first + wanted.sessions; ++i) {
    kinds[static_cast<std::size_t>(i % 2)].add(
        session->run(wanted, static_cast<std::uint64_t>(i), i % 2 == 0));
  }
  kinds[0].print("stage");
  kinds[1].print("free poses");
  tubesight::tests::Sums all = kinds[0];
  all.add(kinds[1]);
  all.print("all");
  return wanted.check && !tubesight::tests::is_good(all) ? 1 : 0;
}
