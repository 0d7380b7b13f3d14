#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "board/bench/reconcile/job_list.h"
#include "board/bench/reconcile/utc_time.h"
#include "core/base/tube_address.h"

namespace tubesight::board {

/// What a journal says of a stretch of time.
struct Evidence {
  enum class Kind : std::uint8_t {
    kConfirmed,     ///< the box vouched for `tube`, which was claimed
    kContradicted,  ///< `claimed` was claimed, and the box vouched for `tube`
    kBroken,        ///< nothing from before holds any more: a start, a loss, a box started anew
    kUnknown,       ///< a claim that the box could not judge
  };
  Kind kind = Kind::kUnknown;
  core::TubeAddress claimed;
  core::TubeAddress tube;
  UtcTime first;                       ///< of equal claims in one row
  UtcTime last;                        ///< of them; the same where there was one
  std::chrono::milliseconds doubt{0};  ///< by which the wall clock may have been off
  std::int64_t row = 0;                ///< of the journal
  bool trusted = true;     ///< false: it accuses, and vouches for nothing (no signature covers it)
  bool tube_known = true;  ///< false: of a contradiction that names no tube, `tube` says nothing
};

/// How a leg's sheet names the tube whose other end the other sheet has.
struct LegNumbering {
  /// Columns are counted from the other side: a tube's column is this less the one on the sheet.
  /// Empty: both sheets are numbered alike.
  std::optional<std::int32_t> mirrored_sum;

  /// The tube's name from that of its end, and the other way round.
  [[nodiscard]] core::TubeAddress turn(const core::TubeAddress& address) const {
    return mirrored_sum ? core::TubeAddress{address.row, *mirrored_sum - address.column} : address;
  }
};

/// A leg: its journal, in the order of its rows, and how its sheet is numbered.
struct LegRecord {
  std::vector<Evidence> evidence;
  LegNumbering numbering;
};

/// Whether a job was done under the box's eyes.
enum class JobFinding : std::uint8_t {
  kVouched,       ///< at its instant the box vouched for that tube-end
  kWrongTube,     ///< then it vouched for another one
  kContradicted,  ///< the claim of that tube had just been contradicted
  kNotVouched,    ///< the journal does not say where the tool was, or is not to be trusted
  kNotDone,       ///< no time is told
};

/// A job and what the journal of its leg says of it.
struct JudgedJob {
  Job job;
  core::TubeAddress tube;  ///< by its name, the same for both ends
  JobFinding finding = JobFinding::kNotVouched;
  std::optional<core::TubeAddress> seen;  ///< on the leg's sheet, where it was another tube
  std::int64_t row = 0;                   ///< of the journal that decided; 0: none did
};

/// How a job on a tube stands, both ends together; the worst first.
enum class TubeFinding : std::uint8_t {
  kWrongEnd,      ///< at one of its ends, by its name, the box vouched for another tube
  kContradicted,  ///< a claim of it had been contradicted, and the job was done all the same
  kOneEnd,        ///< it was done at one end, and is not even planned at the other
  kOpen,          ///< planned, and not done at each end
  kNotVouched,    ///< done at both ends, and not vouched for at each
  kClosed,        ///< done at both ends of the same tube, both vouched for at that instant
};

/// One job on one tube.
struct ReconciledTube {
  std::string kind;
  core::TubeAddress tube;
  TubeFinding finding = TubeFinding::kOpen;
  std::array<std::vector<JudgedJob>, 2> ends;  ///< by Leg
  /// Of kOneEnd: the nearest tube that has the same job at its other end alone. Perhaps one of the
  /// two was meant for the other.
  std::optional<core::TubeAddress> other_half;
};

/// How long after its last confirmation a tube-end counts as vouched for, while nothing else is
/// said: the robot stands, and claims come once a second or so.
inline constexpr std::chrono::milliseconds kHold{10'000};

/// What the journal says of one job: the last evidence before its instant decides. Where the wall
/// clock is in doubt, the job must be vouched for whatever the clock's error was.
[[nodiscard]] JudgedJob judge_job(const Job& job, const LegRecord& leg,
                                  std::chrono::milliseconds hold);

/// Puts both ends of each tube together: what went wrong or is open first, then by tube.
[[nodiscard]] std::vector<ReconciledTube> reconcile(std::span<const Job> jobs,
                                                    const std::array<LegRecord, 2>& legs,
                                                    std::chrono::milliseconds hold);

}  // namespace tubesight::board
