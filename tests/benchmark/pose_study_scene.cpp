#include "tests/benchmark/pose_study_scene.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/math/rotation.h"

namespace tubesight::benchmark {

using core::math::Vector6d;

StudyScene::StudyScene()
    : settings_(std::make_unique<core::SessionSettings>()),
      rims_(std::make_unique<core::picture::RimList>()),
      workspace_(std::make_unique<core::pose::PoseWorkspace>()) {
  tests::make_synthetic_settings(*settings_);
  sheet_ = std::make_unique<tests::SyntheticSheet>(*settings_);
  model_ = *core::pose::make_pose_model(settings_->camera, settings_->tool, settings_->tubesheet);
}

tests::ToolPlace StudyScene::place(const Trial& trial, tests::Deviates& deviates) const {
  tests::ToolPlace place;
  place.x_mm = 762.0 + 2.0 * deviates.normal();
  place.y_mm = 457.2 + 2.0 * deviates.normal();
  place.height_mm = trial.height_mm < 0.0 ? 10.0 + 80.0 * deviates.uniform() : trial.height_mm;
  place.alpha_deg = 360.0 * deviates.uniform();
  if (trial.fixed_lean) {
    const double way = 6.283185307179586 * deviates.uniform();
    place.beta_deg = trial.lean_deg * std::cos(way);
    place.gamma_deg = trial.lean_deg * std::sin(way);
  } else {
    place.beta_deg = trial.lean_deg * deviates.normal();
    place.gamma_deg = trial.lean_deg * deviates.normal();
  }
  return place;
}

void StudyScene::see(const Trial& trial, const tests::ToolPlace& place, tests::Deviates& deviates) {
  // More addresses than asked for: some of them are not wholly in view.
  tests::make_rims(*sheet_, *settings_, place, tests::addresses_around(*sheet_, place, trial.tubes),
                   trial.look, deviates, *rims_);
}

core::pose::PoseOutcome StudyScene::estimate(core::pose::PoseMethod method) {
  core::pose::PoseOptions options;
  options.method = method;
  options.max_rms_px = 10.0;  // what is asked is how large errors get
  return core::pose::estimate_pose(model_, *rims_, options, *workspace_);
}

TrialResult StudyScene::run(const Trial& trial, int poses) {
  TrialResult result;
  for (int i = 0; i < poses; ++i) {
    tests::Deviates deviates(static_cast<std::uint64_t>(i) + 17);
    const tests::ToolPlace where = place(trial, deviates);
    see(trial, where, deviates);
    const core::pose::PoseOutcome outcome = estimate(trial.method);
    if (!outcome.has_value()) {
      ++result.refused;
      continue;
    }
    ++result.poses;
    const Vector6d error = error_of(outcome.estimate, where);
    const core::math::Matrix6d& covariance = outcome.estimate.covariance;
    result.tubes += outcome.estimate.tubes;
    result.lateral_mm += error.head<2>().squaredNorm();
    result.worst_mm = std::max(result.worst_mm, error.head<2>().norm());
    result.height_mm += error(2) * error(2);
    result.tilt_deg += error.segment<2>(3).squaredNorm();
    result.sigma_mm += covariance(0, 0) + covariance(1, 1);
    result.consistency += error.dot(covariance.inverse() * error) / 6.0;
  }
  const double count = std::max(result.poses, 1);
  result.tubes /= count;
  result.lateral_mm = std::sqrt(result.lateral_mm / count);
  result.height_mm = std::sqrt(result.height_mm / count);
  result.tilt_deg = std::sqrt(result.tilt_deg / count) * 57.29577951308232;
  result.sigma_mm = std::sqrt(result.sigma_mm / count);
  result.consistency /= count;
  return result;
}

Vector6d error_of(const core::pose::PoseEstimate& estimate, const tests::ToolPlace& place) {
  const Eigen::Matrix3d R =
      core::rotation_from_degrees({place.alpha_deg, place.beta_deg, place.gamma_deg});
  Vector6d error;
  error.head<3>() = Eigen::Vector3d(place.x_mm, place.y_mm, -place.height_mm) -
                    estimate.T_sheet_tool.translation_mm();
  error.tail<3>() = core::math::log_rotation(R * estimate.T_sheet_tool.rotation().transpose());
  return error;
}

}  // namespace tubesight::benchmark
