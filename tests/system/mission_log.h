#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/tube_address.h"

namespace tubesight::tests {

/// A read of the block `sighting`, as mission_robot.py wrote it down. Instants of the monotonic
/// clock in us.
struct MissionPoll {
  std::int64_t sent_us = 0;
  std::int64_t received_us = 0;
  std::int32_t valid = 0;
  std::int64_t field = -1;
  std::int64_t age_ms = -1;
  bool aligned = false;
  std::int32_t state = 0;
};

/// A start after a loss.
struct MissionRestart {
  std::int64_t at_us = 0;
  std::int64_t field = -1;  ///< of the picture's, as the robot reckons it
  core::TubeAddress tube{};
  std::int32_t refused = 0;  ///< 0: taken
};

enum class MissionVerdict : std::uint8_t { kNone, kAgree, kDisagree, kCannotSay };

struct MissionClaim {
  std::int64_t sent_us = 0;
  std::int64_t taken_us = 0;
  std::int64_t received_us = 0;
  std::int64_t age_ms = 0;
  core::TubeAddress tube{};
  MissionVerdict verdict = MissionVerdict::kNone;
  std::int32_t reason = 0;
  bool named = false;
  core::TubeAddress seen{};
  std::int64_t field = -1;
};

/// What the robot read of the box at the end.
struct MissionHealth {
  std::int64_t fields = -1;
  std::int64_t missing = -1;
  std::int64_t late = -1;
  std::int64_t requests = -1;
  std::int64_t exceptions = -1;
  std::int64_t crc_errors = -1;
  std::int64_t late_claims = -1;
  std::int64_t worst_us = -1;
  std::int64_t claim_worst_us = -1;
};

/// What a robot wrote down, and when each field was exposed, by the robot's own clock: a read tells
/// a field's number and its age, and what came and went around it bounds the moment of reading.
class MissionLog {
 public:
  /// `span_us`: from one field to the next.
  MissionLog(const std::string& text, double span_us);

  [[nodiscard]] const std::vector<MissionPoll>& polls() const { return polls_; }
  [[nodiscard]] const std::vector<MissionClaim>& claims() const { return claims_; }
  [[nodiscard]] const std::vector<MissionRestart>& restarts() const { return restarts_; }
  [[nodiscard]] std::size_t restarts_taken() const;
  [[nodiscard]] std::size_t polls_while_lost() const;
  [[nodiscard]] const MissionHealth& health() const { return health_; }
  /// Lines that are none of these; empty: none.
  [[nodiscard]] const std::string& strange() const { return strange_; }

  /// When field `number` was exposed, from the read nearest to it; within a millisecond or two.
  [[nodiscard]] double exposed_us(std::int64_t number) const;
  /// The source's field at that moment, counted from its first.
  [[nodiscard]] std::int64_t slot_at(double instant_us) const;

 private:
  struct Mark {
    std::int64_t number = 0;
    double at_us = 0.0;
  };

  void take(const std::string& line);
  void mark_fields();

  double span_us_;
  std::vector<MissionPoll> polls_;
  std::vector<MissionClaim> claims_;
  std::vector<MissionRestart> restarts_;
  MissionHealth health_;
  std::string strange_;
  std::vector<Mark> marks_;  ///< in the order of their numbers
};

}  // namespace tubesight::tests
