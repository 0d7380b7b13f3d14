#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "board/bench/pose_rows.h"
#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/pose/pose_request_job.h"

namespace tubesight::board {

/// Serves the pose requests of a replay: averages the fields from an order on, fits, and hands the
/// result back as the event before the next field. A box does the same beside its tracking thread.
class PoseService {
 public:
  /// Errors as make_pose_model() and SheetMap::assign(). Call once, before the first field.
  [[nodiscard]] core::Result<void> configure(const core::SessionSettings& settings);

  /// Takes a field that was stepped, and the order that the step left. Computes when there are
  /// enough fields, which takes some tens of milliseconds.
  void take(const core::Field& field, std::int64_t number, const core::PoseOrder& order);

  /// The event to hand over before the next field, once.
  [[nodiscard]] std::optional<core::Event> take_result();

  /// Number of the field before which a request came that waits for more fields, or has its result
  /// not handed over yet; -1 without one. At the recording's end nobody answers it.
  [[nodiscard]] std::int64_t unanswered() const;

  /// Rows of `pose --csv`, one a request computed; the first cell is the recording and the number
  /// of the field that the request came before. Empty cells: no pose.
  [[nodiscard]] const std::string& rows() const { return rows_; }

  /// How the rows name the recording.
  void name_recording(std::string name) { recording_ = std::move(name); }

 private:
  struct Parts;

  std::shared_ptr<Parts> parts_;  ///< some 3 MB, made by configure()
  std::optional<core::Event> result_;
  std::string recording_;
  std::string rows_;
  core::PoseOrder order_;  ///< the last
  std::int64_t ordered_at_ = 0;
};

}  // namespace tubesight::board
