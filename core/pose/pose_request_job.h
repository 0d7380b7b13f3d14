#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/field.h"
#include "core/base/pose_result.h"
#include "core/base/reply.h"
#include "core/picture/rest_average.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::pose {

/// Serves one pose request at a time beside the tracking: collects fields, averages them, fits.
///
/// begin() with the order that a step left, add_field() with that step's field and those after it
/// until ready() says that there are enough, then compute(); its result goes back to the session as
/// an event. The buffer of sums and the workspace are the caller's, nothing is allocated.
class PoseRequestJob {
 public:
  /// Fields that one pose averages unless told otherwise: four frames, which halves the noise.
  static constexpr std::int32_t kUsualFields = 8;

  /// `sums` holds width * height sums of the camera of `model`. All must outlive this object.
  PoseRequestJob(const PoseModel& model, const tubesheet::SheetMap& map,
                 std::span<std::uint16_t> sums, PictureWorkspace& workspace)
      : model_(model), map_(map), sums_(sums), workspace_(workspace) {}

  /// Begins a request with the tube-ends that the tracker sees; forgets one that is under way.
  /// `fields`: good fields wanted, 1 to 64.
  void begin(const PoseOrder& order, std::int32_t fields = kUsualFields);

  /// Whether a request is under way.
  [[nodiscard]] bool active() const { return average_.has_value(); }

  /// Takes a field when a request is under way; damaged ones are passed over.
  void add_field(const Field& field);

  /// Whether compute() has all fields it wants.
  [[nodiscard]] bool ready() const { return active() && average_->fields() >= wanted_; }

  /// The pose from the fields taken, or the reason against it; ends the request. Costs tens of
  /// milliseconds: not for the thread that tracks.
  [[nodiscard]] PoseResult compute();

  /// Everything that the last compute() found.
  [[nodiscard]] const PictureOutcome& outcome() const { return outcome_; }

 private:
  const PoseModel& model_;
  const tubesheet::SheetMap& map_;
  std::span<std::uint16_t> sums_;
  PictureWorkspace& workspace_;
  std::optional<picture::RestAverage> average_;
  PoseOrder order_;
  PictureOutcome outcome_;
  std::int32_t wanted_ = 0;
};

/// A pose as it crosses ports.
[[nodiscard]] PoseResult make_pose_result(const PictureOutcome& outcome);

}  // namespace tubesight::core::pose
