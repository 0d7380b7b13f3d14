#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/math/rotation.h"
#include "core/pose/pose_estimate.h"
#include "tests/support/synthetic_rims.h"

namespace tubesight::core::pose {

/// T_sheet_tool of a synthetic tool's place.
inline Transform<frames::Sheet, frames::Tool> true_pose(const tests::ToolPlace& place) {
  return {rotation_from_degrees({place.alpha_deg, place.beta_deg, place.gamma_deg}),
          Eigen::Vector3d(place.x_mm, place.y_mm, -place.height_mm)};
}

/// (tau, theta) from an estimate to the truth, sheet frame: what the covariance is of.
inline math::Vector6d pose_error(const Transform<frames::Sheet, frames::Tool>& estimate,
                                 const Transform<frames::Sheet, frames::Tool>& truth) {
  math::Vector6d error;
  error.head<3>() = truth.translation_mm() - estimate.translation_mm();
  error.tail<3>() = math::log_rotation(truth.rotation() * estimate.rotation().transpose());
  return error;
}

/// A synthetic sheet with its model and everything that an estimate needs, on the heap.
class PoseScene {
 public:
  PoseScene() {
    tests::make_synthetic_settings(*settings_);
    sheet_ = std::make_unique<tests::SyntheticSheet>(*settings_);
    const auto made = make_pose_model(settings_->camera, settings_->tool, settings_->tubesheet);
    EXPECT_TRUE(made.has_value());
    model = *made;
  }

  /// Rims of the `count` tube-ends nearest to the guidetube's axis.
  void see(const tests::ToolPlace& place, std::size_t count, const tests::RimLook& look,
           std::uint64_t seed = 1) {
    see(place, tests::addresses_around(*sheet_, place, count), look, seed);
  }
  void see(const tests::ToolPlace& place, const std::vector<TubeAddress>& addresses,
           const tests::RimLook& look, std::uint64_t seed = 1) {
    tests::Deviates deviates(seed);
    tests::make_rims(*sheet_, *settings_, place, addresses, look, deviates, *rims);
  }

  [[nodiscard]] PoseOutcome estimate(const PoseOptions& options = {}) {
    return estimate_pose(model, *rims, options, *workspace);
  }

  [[nodiscard]] const tests::SyntheticSheet& sheet() const { return *sheet_; }
  [[nodiscard]] const SessionSettings& settings() const { return *settings_; }

  PoseModel model;
  std::unique_ptr<picture::RimList> rims = std::make_unique<picture::RimList>();
  std::unique_ptr<PoseWorkspace> workspace = std::make_unique<PoseWorkspace>();

 private:
  std::unique_ptr<SessionSettings> settings_ = std::make_unique<SessionSettings>();
  std::unique_ptr<tests::SyntheticSheet> sheet_;
};

}  // namespace tubesight::core::pose
