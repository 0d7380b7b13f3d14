#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "board/box/pose_desk.h"
#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/pose/pose_estimate.h"
#include "core/pose/pose_request_job.h"

namespace tubesight::board {

/// Serves pose requests: averages the fields from an order on, fits, and hands the
/// result back as the event before the next field. On the thread that calls it: a box puts it
/// behind a PoseHandover, beside its tracking thread.
class PoseService final : public PoseDesk {
 public:
  /// Errors as make_pose_model() and SheetMap::assign(). Call once, before the first field.
  [[nodiscard]] core::Result<void> configure(const core::SessionSettings& settings);

  /// Takes a field that was stepped, and the order that the step left. Computes when there are
  /// enough fields, which takes some tens of milliseconds.
  void take(const core::Field& field, std::int64_t number, const core::PoseOrder& order) override;

  /// The event to hand over before the next field, once.
  [[nodiscard]] std::optional<core::Event> take_result() override;

  /// Number of the field before which a request came that waits for more fields, or has its result
  /// not handed over yet; -1 without one. At the recording's end nobody answers it.
  [[nodiscard]] std::int64_t unanswered() const;

  /// What one request came to, for whoever writes it down in more detail than the event has.
  struct Computed {
    std::int64_t field = 0;  ///< number of the field that the request came before
    const core::pose::PoseEstimate* estimate = nullptr;  ///< null: no pose
    bool has_tube = false;                               ///< a tube stands at its nearest address
  };
  /// What the last take() computed; empty: nothing. Valid until the next one.
  [[nodiscard]] const std::optional<Computed>& computed() const { return computed_; }

 private:
  struct Parts;

  std::shared_ptr<Parts> parts_;  ///< some 3 MB, made by configure()
  std::optional<core::Event> result_;
  std::optional<Computed> computed_;
  core::PoseOrder order_;  ///< the last
  std::int64_t ordered_at_ = 0;
};

}  // namespace tubesight::board
