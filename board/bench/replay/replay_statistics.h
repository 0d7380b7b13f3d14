#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "board/bench/replay/visit_log.h"
#include "core/base/field.h"
#include "core/base/pose_result.h"
#include "core/base/reply.h"
#include "core/base/sighting.h"
#include "core/base/tube_address.h"
#include "core/base/words.h"
#include "core/session/session.h"
#include "core/tracking/start.h"

namespace tubesight::board {

/// Fields, and the recorded time for which they stand.
struct Share {
  std::int64_t fields = 0;
  core::FieldTime time{0};
};

/// What one replay came to; the summary is written from it.
///
/// A field stands for the time until the next one, the last field for as long as the one before it.
class ReplayStatistics {
 public:
  struct Start {
    core::FieldTime at{0};
    core::StartReply reply{};
  };
  struct Loss {
    core::FieldTime at{0};
    core::FieldTime lasted{0};
    core::Reason reason = core::Reason::kNone;
  };
  struct Contradiction {
    core::FieldTime at{0};
    core::TubeAddress claimed{};
    core::TubeAddress seen{};
  };

  static constexpr std::size_t kStates = 4;
  static constexpr std::size_t kReasons = static_cast<std::size_t>(core::count_of<core::Reason>());

  /// Takes what step() left for a field.
  void add(const core::session::Output& output);

  /// Ends the account. Call once, after the last field.
  void finish();

  [[nodiscard]] std::int64_t fields() const { return fields_; }
  /// Times of the first field and of the end of the last one; they run as the recording's do.
  [[nodiscard]] core::FieldTime begin() const { return begin_; }
  [[nodiscard]] core::FieldTime end() const { return previous_.time + span_; }

  [[nodiscard]] const Share& state(core::TrackState state) const {
    return states_[static_cast<std::size_t>(state)];
  }
  /// Degraded fields with this reason.
  [[nodiscard]] const Share& degraded(core::Reason reason) const {
    return degraded_[static_cast<std::size_t>(reason)];
  }
  [[nodiscard]] const std::vector<Start>& starts() const { return starts_; }
  [[nodiscard]] const std::vector<Loss>& losses() const { return losses_; }
  [[nodiscard]] const VisitLog& visits() const { return visits_; }

  /// Tube-ends measured and used, summed over the tracking and degraded fields.
  [[nodiscard]] std::int64_t tubes_used() const { return tubes_used_; }
  /// Tubes recognised as plugs, each once.
  [[nodiscard]] const std::set<core::TubeAddress>& plugs() const { return plugs_; }

  /// Largest speed over the sheet while tracking, and when; below 0 when none is known.
  [[nodiscard]] double largest_speed_mm_s() const { return largest_speed_mm_s_; }
  [[nodiscard]] core::FieldTime largest_speed_at() const { return largest_speed_at_; }

  [[nodiscard]] std::int64_t claims_confirmed() const { return claims_confirmed_; }
  [[nodiscard]] std::int64_t claims_unknown() const { return claims_unknown_; }
  [[nodiscard]] const std::vector<Contradiction>& contradictions() const { return contradictions_; }
  [[nodiscard]] std::int64_t picks_named() const { return picks_named_; }
  [[nodiscard]] std::int64_t picks_unknown() const { return picks_unknown_; }
  /// What became of a pose request: answered, or refused with its reason.
  struct Pose {
    core::FieldTime at{0};
    core::PoseResult result;
    bool contradicted = false;  ///< under another tube than the tracker sees
  };
  [[nodiscard]] const std::vector<Pose>& poses() const { return poses_; }
  [[nodiscard]] std::int64_t not_served() const { return not_served_; }

 private:
  void account(core::FieldTime span);
  void take_sighting(const core::session::Output& output);
  void take_reply(const core::Reply& reply);

  std::int64_t fields_ = 0;
  core::FieldTime begin_{0};
  core::FieldTime span_{0};  ///< of the last field that was accounted
  core::Sighting previous_;  ///< of the last field, not accounted until the next one comes
  std::array<Share, kStates> states_{};
  std::array<Share, kReasons> degraded_{};
  std::vector<Start> starts_;
  std::vector<Loss> losses_;
  VisitLog visits_;
  std::int64_t tubes_used_ = 0;
  std::set<core::TubeAddress> plugs_;
  double largest_speed_mm_s_ = -1.0;
  core::FieldTime largest_speed_at_{0};
  std::int64_t claims_confirmed_ = 0;
  std::int64_t claims_unknown_ = 0;
  std::vector<Contradiction> contradictions_;
  std::int64_t picks_named_ = 0;
  std::int64_t picks_unknown_ = 0;
  std::vector<Pose> poses_;
  std::int64_t not_served_ = 0;
};

}  // namespace tubesight::board
