#include "board/bench/campaign/campaign_run.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "board/bench/campaign/random_move.h"

namespace tubesight::board::campaign {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kSelfProof = "-without-margin-check";

/// A finished move that waits for its turn.
struct Finished {
  MoveResult result;
  std::int64_t busy_ms = 0;
};

/// Hands out moves to jobs and takes their results in the order of the moves.
class Campaign {
 public:
  Campaign(const CampaignPlan& plan, Progress& progress, const CampaignWatcher& watcher)
      : plan_(plan),
        progress_(progress),
        watcher_(watcher),
        next_to_run_(progress.next_move(plan.seed, plan.first_move)),
        next_to_add_(next_to_run_),
        begun_(Clock::now()),
        fields_(progress.total()[Count::kFields]),
        moves_(progress.total()[Count::kMoves]) {}

  std::string run() {
    over_ = reached_limit();
    std::vector<std::thread> jobs;
    for (std::int32_t i = 1; i < plan_.jobs; ++i) {
      jobs.emplace_back([this] { work(); });
    }
    work();
    for (std::thread& job : jobs) {
      job.join();
    }
    return trouble_;
  }

 private:
  void work() {
    MoveMaker maker;
    MoveRunner runner;
    const auto scenario = std::make_unique<drivers::Scenario>();
    while (true) {
      const std::int64_t move = take_number();
      if (move < 0) {
        return;
      }
      const Clock::time_point from = Clock::now();
      maker.make(plan_.seed, move, *scenario);
      Finished finished;
      finished.result = runner.run(*scenario, plan_.run);
      finished.busy_ms =
          std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - from).count();
      hand_in(move, finished);
    }
  }

  std::int64_t take_number() {
    const std::lock_guard lock(mutex_);
    if (over_) {
      return -1;
    }
    const std::int64_t move = next_to_run_;
    next_to_run_ = progress_.next_move(plan_.seed, move + 1);
    return move;
  }

  void hand_in(std::int64_t move, const Finished& finished) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(move, finished);
    // What is behind the limit is thrown away: the counts must not depend on the number of jobs.
    for (auto first = waiting_.begin();
         !over_ && first != waiting_.end() && first->first == next_to_add_;
         first = waiting_.erase(first)) {
      add(first->first, first->second);
    }
  }

  void add(std::int64_t move, const Finished& finished) {
    if (!finished.result.runs) {
      trouble_ = "move " + std::to_string(move) + " of seed " + std::to_string(plan_.seed) +
                 ": the scenario drawn cannot be played";
      over_ = true;
      return;
    }
    const Counts& counts = finished.result.counts;
    progress_.add(plan_.seed, move, counts, finished.busy_ms);
    next_to_add_ = progress_.next_move(plan_.seed, move + 1);
    fields_ += counts[Count::kFields];
    ++moves_;
    if (counts[Count::kWrongTube] > 0 && watcher_.found_wrong) {
      watcher_.found_wrong({plan_.seed, move, finished.result.first_wrong_field});
    }
    const bool go_on = !watcher_.done_move || watcher_.done_move(progress_);
    over_ = !go_on || reached_limit();
  }

  [[nodiscard]] bool reached_limit() const {
    const CampaignLimits& limits = plan_.limits;
    const double hours =
        std::chrono::duration<double, std::ratio<3600>>(Clock::now() - begun_).count();
    return (limits.moves > 0 && moves_ >= limits.moves) ||
           (limits.fields > 0 && fields_ >= limits.fields) ||
           (limits.hours > 0.0 && hours >= limits.hours);
  }

  const CampaignPlan& plan_;
  Progress& progress_;
  const CampaignWatcher& watcher_;
  std::mutex mutex_;
  std::map<std::int64_t, Finished> waiting_;
  std::int64_t next_to_run_;
  std::int64_t next_to_add_;
  Clock::time_point begun_;
  std::int64_t fields_;
  std::int64_t moves_;
  bool over_ = false;
  std::string trouble_;
};

}  // namespace

std::string run_campaign(const CampaignPlan& plan, Progress& progress,
                         const CampaignWatcher& watcher) {
  return Campaign(plan, progress, watcher).run();
}

std::string box_identity(const std::string& version) {
  // FNV-1a over the running program: exactly this box, this renderer and this drawing of moves.
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::vector<char> bytes(1U << 20U);
  std::uint64_t digest = 14695981039346656037ULL;
  while (program.good()) {
    program.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    for (std::streamsize i = 0; i < program.gcount(); ++i) {
      const auto byte = static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(i)]);
      digest = (digest ^ byte) * 1099511628211ULL;
    }
  }
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(digest));
  return version + "-" + text.data();
}

std::string configuration_name(const RunOptions& run) {
  return std::string(kDesign) + (run.margin_check ? "" : kSelfProof);
}

bool is_self_proof(const std::string& configuration) { return configuration.ends_with(kSelfProof); }

}  // namespace tubesight::board::campaign
