#include "board/bench/reconcile/reconciliation.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace tubesight::board {
namespace {

/// What one row says if the job was at `at` by that row's clock: vouched only when `at` is within
/// the row's time or soon after it.
JobFinding finding_of(const Evidence& evidence, const core::TubeAddress& tube, UtcTime at,
                      std::chrono::milliseconds hold) {
  const bool in_time = at <= evidence.last + hold;
  switch (evidence.kind) {
    case Evidence::Kind::kConfirmed:
      if (!in_time) {
        return JobFinding::kNotVouched;
      }
      if (evidence.tube != tube) {
        return JobFinding::kWrongTube;
      }
      return evidence.trusted ? JobFinding::kVouched : JobFinding::kNotVouched;
    case Evidence::Kind::kContradicted:
      // However long ago: nobody has said since that it was right after all.
      if (evidence.claimed == tube) {
        return JobFinding::kContradicted;
      }
      return in_time && evidence.tube_known && evidence.tube != tube ? JobFinding::kWrongTube
                                                                     : JobFinding::kNotVouched;
    case Evidence::Kind::kBroken:
    case Evidence::Kind::kUnknown: break;
  }
  return JobFinding::kNotVouched;
}

/// The rows that may have been the last ones before the job, whatever the clock's error.
struct Deciding {
  std::span<const Evidence> rows;
  bool surely = false;  ///< the first of them surely began before it
};

Deciding deciding(const std::vector<Evidence>& evidence, UtcTime at) {
  std::size_t end = 0;
  std::optional<std::size_t> surely;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    if (evidence[i].first - evidence[i].doubt <= at) {
      end = i + 1;
    }
    if (evidence[i].first + evidence[i].doubt <= at) {
      surely = i;
    }
  }
  const std::size_t begin = surely.value_or(0);
  return {std::span(evidence).subspan(begin, end - begin), surely.has_value()};
}

bool is_wrong(JobFinding finding) {
  return finding == JobFinding::kWrongTube || finding == JobFinding::kContradicted;
}

TubeFinding finding_of(const std::array<std::vector<JudgedJob>, 2>& ends) {
  const auto any = [&](auto&& holds) {
    return std::any_of(ends.begin(), ends.end(), [&](const std::vector<JudgedJob>& end) {
      return std::any_of(end.begin(), end.end(), holds);
    });
  };
  const auto each_end = [&](auto&& holds) {
    return std::all_of(ends.begin(), ends.end(), [&](const std::vector<JudgedJob>& end) {
      return std::any_of(end.begin(), end.end(), holds);
    });
  };
  const auto has = [](JobFinding wanted) {
    return [wanted](const JudgedJob& job) { return job.finding == wanted; };
  };
  const auto done = [](const JudgedJob& job) { return job.finding != JobFinding::kNotDone; };
  if (any(has(JobFinding::kWrongTube))) {
    return TubeFinding::kWrongEnd;
  }
  if (any(has(JobFinding::kContradicted))) {
    return TubeFinding::kContradicted;
  }
  if (each_end(has(JobFinding::kVouched))) {
    return TubeFinding::kClosed;
  }
  if (each_end(done)) {
    return TubeFinding::kNotVouched;
  }
  return any(done) && (ends[0].empty() || ends[1].empty()) ? TubeFinding::kOneEnd
                                                           : TubeFinding::kOpen;
}

std::int64_t distance(const core::TubeAddress& one, const core::TubeAddress& other) {
  return std::abs(std::int64_t{one.row} - other.row) +
         std::abs(std::int64_t{one.column} - other.column);
}

/// The nearest tube with the same job at the end that this one lacks.
std::optional<core::TubeAddress> find_other_half(const ReconciledTube& half,
                                                 const std::vector<ReconciledTube>& tubes) {
  const std::size_t lacks = half.ends[0].empty() ? 0 : 1;
  const ReconciledTube* nearest = nullptr;
  for (const ReconciledTube& other : tubes) {
    const bool fits = other.finding == TubeFinding::kOneEnd && other.kind == half.kind &&
                      !other.ends[lacks].empty();
    if (fits && (nearest == nullptr ||
                 distance(other.tube, half.tube) < distance(nearest->tube, half.tube))) {
      nearest = &other;
    }
  }
  return nearest == nullptr ? std::nullopt : std::optional(nearest->tube);
}

}  // namespace

JudgedJob judge_job(const Job& job, const LegRecord& leg, std::chrono::milliseconds hold) {
  JudgedJob judged;
  judged.job = job;
  judged.tube = leg.numbering.turn(job.tube);
  if (!job.done_at) {
    judged.finding = JobFinding::kNotDone;
    return judged;
  }
  const Deciding may_be_last = deciding(leg.evidence, *job.done_at);
  bool first = true;
  for (const Evidence& evidence : may_be_last.rows) {
    const JobFinding found = finding_of(evidence, job.tube, *job.done_at + evidence.doubt, hold);
    // All that may have been the last must vouch for it; one that tells of a wrong tube is enough.
    if (first || is_wrong(found) || judged.finding == JobFinding::kVouched) {
      judged.finding = found;
      judged.row = evidence.row;
      const bool other = is_wrong(found) && evidence.tube_known && evidence.tube != job.tube;
      judged.seen = other ? std::optional(evidence.tube) : std::nullopt;
    }
    first = false;
    if (is_wrong(found)) {
      break;
    }
  }
  if (judged.finding == JobFinding::kVouched && !may_be_last.surely) {
    judged.finding = JobFinding::kNotVouched;
  }
  return judged;
}

std::vector<ReconciledTube> reconcile(std::span<const Job> jobs,
                                      const std::array<LegRecord, 2>& legs,
                                      std::chrono::milliseconds hold) {
  std::map<std::pair<std::string, core::TubeAddress>, ReconciledTube> by_tube;
  for (const Job& job : jobs) {
    const auto leg = static_cast<std::size_t>(job.leg);
    const JudgedJob judged = judge_job(job, legs[leg], hold);
    ReconciledTube& tube = by_tube[{job.kind, judged.tube}];
    tube.kind = job.kind;
    tube.tube = judged.tube;
    tube.ends[leg].push_back(judged);
  }
  std::vector<ReconciledTube> tubes;
  for (auto& [key, tube] : by_tube) {
    tube.finding = finding_of(tube.ends);
    tubes.push_back(std::move(tube));
  }
  for (ReconciledTube& tube : tubes) {
    if (tube.finding == TubeFinding::kOneEnd) {
      tube.other_half = find_other_half(tube, tubes);
    }
  }
  std::stable_sort(tubes.begin(), tubes.end(),
                   [](const ReconciledTube& one, const ReconciledTube& other) {
                     return one.finding < other.finding;
                   });
  return tubes;
}

}  // namespace tubesight::board
