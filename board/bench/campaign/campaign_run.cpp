#include "board/bench/campaign/campaign_run.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include "board/bench/campaign/ordered_jobs.h"
#include "core/base/fnv1a.h"

namespace tubesight::board::campaign {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kSelfProof = "-without-margin-check";

/// A finished move that waits for its turn.
struct Finished {
  MoveResult result;
  std::int64_t busy_ms = 0;
};

/// Runs moves and adds what came of them.
class Campaign {
 public:
  Campaign(const CampaignPlan& plan, Progress& progress, const CampaignWatcher& watcher)
      : plan_(plan),
        progress_(progress),
        watcher_(watcher),
        begun_(Clock::now()),
        fields_(progress.total()[Count::kFields]),
        moves_(progress.total()[Count::kMoves]) {}

  std::string run() {
    if (plan_.limits.reached(moves_, fields_, Clock::now() - begun_)) {
      return {};
    }
    OrderedJobs<Finished>::Plan jobs;
    jobs.first = progress_.next_move(plan_.seed, plan_.first_move);
    jobs.next = [this](std::int64_t move) { return progress_.next_move(plan_.seed, move + 1); };
    jobs.worker = [this] { return worker(); };
    jobs.add = [this](std::int64_t move, const Finished& finished) { return add(move, finished); };
    OrderedJobs<Finished>(std::move(jobs)).run(plan_.jobs);
    return trouble_;
  }

 private:
  [[nodiscard]] OrderedJobs<Finished>::Work worker() const {
    struct Tools {
      explicit Tools(const DrawOptions& draw) : maker(draw) {}

      MoveMaker maker;
      MoveRunner runner;
      drivers::Scenario scenario;
    };
    const auto tools = std::make_shared<Tools>(plan_.draw);
    return [this, tools](std::int64_t move) {
      const Clock::time_point from = Clock::now();
      tools->maker.make(plan_.seed, move, tools->scenario);
      Finished finished;
      finished.result = tools->runner.run(tools->scenario, plan_.run);
      finished.busy_ms =
          std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - from).count();
      return finished;
    };
  }

  bool add(std::int64_t move, const Finished& finished) {
    if (!finished.result.runs) {
      trouble_ = "move " + std::to_string(move) + " of seed " + std::to_string(plan_.seed) +
                 ": the scenario drawn cannot be played";
      return false;
    }
    const Counts& counts = finished.result.counts;
    progress_.add(plan_.seed, move, counts, finished.busy_ms);
    fields_ += counts[Count::kFields];
    ++moves_;
    if (counts[Count::kWrongTube] > 0 && watcher_.found_wrong) {
      watcher_.found_wrong({plan_.seed, move, finished.result.first_wrong_field});
    }
    const bool go_on = !watcher_.done_move || watcher_.done_move(progress_);
    return go_on && !plan_.limits.reached(moves_, fields_, Clock::now() - begun_);
  }

  const CampaignPlan& plan_;
  Progress& progress_;
  const CampaignWatcher& watcher_;
  Clock::time_point begun_;
  std::int64_t fields_;
  std::int64_t moves_;
  std::string trouble_;
};

}  // namespace

std::string run_campaign(const CampaignPlan& plan, Progress& progress,
                         const CampaignWatcher& watcher) {
  return Campaign(plan, progress, watcher).run();
}

std::string box_identity(const std::string& version) {
  // Of the running program: exactly this box, this renderer and this drawing of moves.
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::vector<char> bytes(1U << 20U);
  core::Fnv1a digest;
  while (program.good()) {
    program.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    digest.add(std::string_view(bytes.data(), static_cast<std::size_t>(program.gcount())));
  }
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx",
                static_cast<unsigned long long>(digest.value()));
  return version + "-" + text.data();
}

bool CampaignLimits::reached(std::int64_t done_moves, std::int64_t done_fields,
                             std::chrono::nanoseconds for_so_long) const {
  return (moves > 0 && done_moves >= moves) || (fields > 0 && done_fields >= fields) ||
         (hours > 0.0 &&
          std::chrono::duration<double, std::ratio<3600>>(for_so_long).count() >= hours);
}

std::string configuration_name(const RunOptions& run, const DrawOptions& draw) {
  return std::string(kDesign) + (draw.sizes ? "-sizes" : "") + (run.margin_check ? "" : kSelfProof);
}

bool is_self_proof(const std::string& configuration) { return configuration.ends_with(kSelfProof); }

}  // namespace tubesight::board::campaign
