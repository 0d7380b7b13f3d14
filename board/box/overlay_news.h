#pragma once

#include <cstdint>
#include <optional>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/static_vector.h"
#include "core/overlay/overlay.h"
#include "core/session/session.h"

namespace tubesight::board {

/// What an operator shall see longer than one field: where he clicked last and what became of it,
/// and what the box said to the robot's last claim.
///
/// Clicks that were taken, and claims that were not contradicted, are shown for three seconds of
/// the fields' time; clicks also no longer than the tool is known not to move. A refused start
/// stays until the next one, or, where the box tracks, as long as the others. A contradicted claim
/// stays until the next claim is answered or the operator acknowledges. Plain bytes; some hundred
/// of them; no heap.
class OverlayNews {
 public:
  /// Takes what a step was given and what it left; after each step, in order.
  void take(const core::session::Input& input, const core::session::Output& output);

  [[nodiscard]] const core::StaticVector<core::overlay::Click, core::kMaxStartPoints>& clicks()
      const {
    return clicks_;
  }
  [[nodiscard]] core::StartRefusal refusal() const { return refusal_; }
  [[nodiscard]] const std::optional<core::ClaimReply>& claim() const { return claim_; }

 private:
  void take_start(const core::Start& start, const core::StartReply& reply);
  void forget_old(const core::Sighting& sighting);

  core::StaticVector<core::overlay::Click, core::kMaxStartPoints> clicks_;
  core::StartRefusal refusal_ = core::StartRefusal::kNone;
  core::FieldTime start_at_{0};
  std::optional<core::ClaimReply> claim_;
  core::FieldTime claim_at_{0};
};

}  // namespace tubesight::board
