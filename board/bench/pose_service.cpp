#include "board/bench/pose_service.h"

#include <cstddef>
#include <utility>

#include "core/pose/pose_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::board {

struct PoseService::Parts {
  explicit Parts(const core::pose::PoseModel& pose_model)
      : model(pose_model),
        sums(static_cast<std::size_t>(model.camera_settings.width_px) *
             static_cast<std::size_t>(model.camera_settings.height_px)),
        job(model, map, sums, workspace) {}

  core::pose::PoseModel model;
  core::tubesheet::SheetMap map;
  std::vector<std::uint16_t> sums;
  core::pose::PictureWorkspace workspace;
  core::pose::PoseRequestJob job;
};

core::Result<void> PoseService::configure(const core::SessionSettings& settings) {
  const auto model =
      core::pose::make_pose_model(settings.camera, settings.tool, settings.tubesheet);
  if (!model) {
    return core::Unexpected(model.error());
  }
  parts_ = std::make_shared<Parts>(*model);
  return parts_->map.assign(settings.tubesheet);
}

void PoseService::take(const core::Field& field, std::int64_t number,
                       const core::PoseOrder& order) {
  core::pose::PoseRequestJob& job = parts_->job;
  if (order.wanted) {
    job.begin(order);
    order_ = order;
    ordered_at_ = number;
  }
  job.add_field(field);
  if (!job.ready()) {
    return;
  }
  const core::PoseResult pose = job.compute();
  result_ = core::Event{order_.id, order_.origin, {}, pose};
  const bool known = pose.reason == core::PoseReason::kNone;
  PoseRow row;
  row.image = recording_ + ":" + std::to_string(ordered_at_);
  if (known) {
    row.estimate = &job.outcome().pose.estimate;
    row.covariance = row.estimate->covariance;
    row.has_tube = parts_->map.state(row.estimate->nearest) != core::TubeState::kAbsent;
  }
  append_pose_row(rows_, row);
}

std::int64_t PoseService::unanswered() const {
  return (parts_ != nullptr && parts_->job.active()) || result_ ? ordered_at_ : -1;
}

std::optional<core::Event> PoseService::take_result() {
  return std::exchange(result_, std::nullopt);
}

}  // namespace tubesight::board
