#include "core/pose/pose_request_job.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/rotation.h"

namespace tubesight::core::pose {
namespace {

constexpr double kQ16 = 65536.0;
constexpr double kNanometresPerMillimetre = 1e6;
constexpr double kNanodegrees = 180e9 / std::numbers::pi;

/// To the nearest integer; what is beyond a million metres or turns is held there.
std::int64_t rounded(double value) {
  constexpr double kMost = 1e15;
  return std::llround(std::clamp(value, -kMost, kMost));
}

PoseReason reason_of(PoseRefusal refusal) {
  switch (refusal) {
    case PoseRefusal::kNone: return PoseReason::kNone;
    case PoseRefusal::kCollinear:
    case PoseRefusal::kAmbiguous:
    case PoseRefusal::kIllConditioned: return PoseReason::kWeak;
    default: return PoseReason::kPicture;
  }
}

}  // namespace

PoseResult make_pose_result(const PictureOutcome& outcome) {
  PoseResult result;
  if (!outcome.has_value()) {
    result.reason = outcome.refusal == PictureRefusal::kPose ? reason_of(outcome.pose.refusal)
                                                             : PoseReason::kPicture;
    return result;
  }
  const PoseEstimate& pose = outcome.pose.estimate;
  const auto angles = math::angles_of(pose.T_sheet_tool.rotation());
  const Eigen::Vector3d angle_sigmas =
      math::angle_covariance(pose.T_sheet_tool.rotation(),
                             pose.covariance.bottomRightCorner<3, 3>())
          .diagonal()
          .cwiseMax(0.0)
          .cwiseSqrt();
  result.reason = PoseReason::kNone;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    result.position_nm[k] =
        rounded(pose.T_sheet_tool.translation_mm()(i) * kNanometresPerMillimetre);
    result.angles_ndeg[k] = rounded(angles[k] * kNanodegrees);
    result.position_sigma_nm[k] =
        rounded(std::sqrt(std::max(0.0, pose.covariance(i, i))) * kNanometresPerMillimetre);
    result.angle_sigma_ndeg[k] = rounded(angle_sigmas(i) * kNanodegrees);
  }
  result.tubes = pose.tubes;
  result.nearest = pose.nearest;
  result.offset_nm = rounded(pose.offset_mm * kNanometresPerMillimetre);
  return result;
}

void PoseRequestJob::begin(const PoseOrder& order, std::int32_t fields) {
  order_ = order;
  wanted_ = std::clamp(fields, 1, 2 * picture::kMaxAveragedFrames);
  average_.emplace(sums_, model_.camera_settings.width_px, model_.camera_settings.height_px);
}

void PoseRequestJob::add_field(const Field& field) {
  if (!active() || ready() || field.status != FieldStatus::kGood) {
    return;
  }
  // A field of another size, or more of one parity than fit, is left out: the request then waits
  // for others.
  static_cast<void>(average_->add(field.pixels));
}

PoseResult PoseRequestJob::compute() {
  PoseResult result;
  outcome_ = PictureOutcome();
  outcome_.refusal = PictureRefusal::kTooFewStarts;
  if (!ready()) {
    result.reason = PoseReason::kEnded;
    average_.reset();
    return result;
  }
  const picture::RestOutcome rest = average_->finish();
  average_.reset();
  if (!rest.rested) {
    result.reason = PoseReason::kMoving;
    return result;
  }
  StaticVector<PictureStart, kMaxPoseOrderTubes> starts;
  for (const PoseOrderTube& tube : order_.tubes) {
    static_cast<void>(starts.try_push_back(
        {tube.address, tube.center_px.u_q16 / kQ16, tube.center_px.v_q16 / kQ16}));
  }
  outcome_ = estimate_from_picture(rest.picture, model_, map_, starts.view(), PictureOptions(),
                                   workspace_);
  return make_pose_result(outcome_);
}

}  // namespace tubesight::core::pose
