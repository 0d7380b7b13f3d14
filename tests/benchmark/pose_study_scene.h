#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/pose/pose_estimate.h"
#include "tests/support/synthetic_rims.h"

namespace tubesight::benchmark {

/// What poses of one trial are like; everything that is not said is the source's camera and tool on
/// a square pitch of 25.4 mm.
struct Trial {
  tests::RimLook look{.noise_px = 0.1, .bore_sigma_mm = 0.06};
  std::size_t tubes = 25;   ///< nearest to the guidetube's axis, as far as they are in view
  double height_mm = -1.0;  ///< below zero: 10 to 90 mm
  double lean_deg = 0.7;    ///< deviation of beta and gamma; or, with `fixed_lean`, the lean
  bool fixed_lean = false;
  core::pose::PoseMethod method = core::pose::PoseMethod::kRims;
};

/// Errors over many poses.
struct TrialResult {
  int poses = 0;
  int refused = 0;
  double tubes = 0.0;        ///< mean number used
  double lateral_mm = 0.0;   ///< RMS
  double worst_mm = 0.0;     ///< lateral
  double height_mm = 0.0;    ///< RMS
  double tilt_deg = 0.0;     ///< RMS
  double sigma_mm = 0.0;     ///< lateral as told, RMS
  double consistency = 0.0;  ///< mean of normalised squared errors over six: 1 is true
};

/// A sheet, its camera and everything that estimates need.
class StudyScene {
 public:
  StudyScene();

  /// A random place of the tool: a deviation of 2 mm about tube (18, 30), any heading.
  [[nodiscard]] tests::ToolPlace place(const Trial& trial, tests::Deviates& deviates) const;
  /// Fills rims().
  void see(const Trial& trial, const tests::ToolPlace& place, tests::Deviates& deviates);
  [[nodiscard]] core::pose::PoseOutcome estimate(core::pose::PoseMethod method);
  /// Runs `poses` poses of a trial.
  [[nodiscard]] TrialResult run(const Trial& trial, int poses);

  [[nodiscard]] const tests::SyntheticSheet& sheet() const { return *sheet_; }
  [[nodiscard]] const core::pose::PoseModel& model() const { return model_; }
  [[nodiscard]] core::picture::RimList& rims() { return *rims_; }
  [[nodiscard]] core::pose::PoseWorkspace& workspace() { return *workspace_; }

 private:
  std::unique_ptr<core::SessionSettings> settings_;
  std::unique_ptr<tests::SyntheticSheet> sheet_;
  std::unique_ptr<core::picture::RimList> rims_;
  std::unique_ptr<core::pose::PoseWorkspace> workspace_;
  core::pose::PoseModel model_;
};

/// (tau, theta) from an estimate to the true pose.
[[nodiscard]] core::math::Vector6d error_of(const core::pose::PoseEstimate& estimate,
                                            const tests::ToolPlace& place);

}  // namespace tubesight::benchmark
