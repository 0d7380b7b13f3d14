#include "board/bench/campaign/one_move_command.h"

#include <memory>
#include <string>
#include <string_view>

#include "board/bench/campaign/lamp_run.h"
#include "board/bench/campaign/move_reducer.h"
#include "board/bench/campaign/move_run.h"
#include "board/bench/campaign/random_move.h"
#include "board/bench/output/progress_line.h"
#include "board/bench/output/text_output.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/scenario/scenario_text.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::board::campaign {
namespace {

/// "SEED:MOVE", both from 0.
bool parse_move(std::string_view text, std::int64_t& seed, std::int64_t& move) {
  const std::size_t colon = text.find(':');
  return colon != std::string_view::npos && drivers::parse_whole(text.substr(0, colon), seed) &&
         drivers::parse_whole(text.substr(colon + 1), move) && seed >= 0 && move >= 0;
}

std::string counts_text(const Counts& counts) {
  std::string text;
  for (std::size_t i = 0; i < kCounts; ++i) {
    const auto count = static_cast<Count>(i);
    if (counts[count] != 0) {
      drivers::print(text, "  %-20s %lld\n", std::string(name_of(count)).c_str(),
                     static_cast<long long>(counts[count]));
    }
  }
  return text;
}

/// Writes a scenario and reads it back: what it says must be what was run, by `shows_the_same`.
template <typename Shows>
ExitStatus write_scenario(drivers::AtomicFile& file, const std::string& path,
                          const drivers::Scenario& scenario, const std::string& title,
                          Shows shows_the_same) {
  if (!file.write(std::string_view(drivers::scenario_text(scenario, title))) || !file.commit()) {
    tell(file.message());
    return ExitStatus::kJobFailed;
  }
  const auto read = std::make_unique<drivers::ScenarioFile>();
  drivers::Messages messages;
  if (!drivers::load_scenario(path, {}, *read, messages)) {
    tell(messages);
    return ExitStatus::kJobFailed;
  }
  if (!shows_the_same(read->scenario)) {
    tell(path +
         ": shows something else than the move, by a rounding in the last bit; "
         "expected the same counts");
    return ExitStatus::kJobFailed;
  }
  return write_out(path + ": shows the same\n") ? ExitStatus::kDone : ExitStatus::kJobFailed;
}

/// Runs and writes one run of a lamp.
ExitStatus run_one_lamp(const CampaignOptions& options, std::uint64_t seed, std::int64_t number) {
  drivers::AtomicFile file;
  if (!file.open(options.out)) {
    tell(file.message());
    return ExitStatus::kWrongInput;
  }
  const auto scenario = std::make_unique<drivers::Scenario>();
  const LampRun run = LampRunMaker({options.sizes}).make(seed, number, *scenario);
  LampRunner runner;
  const LampResult result = runner.run(*scenario, run);
  const std::string kind = lamp_kind_name(lamp_kind_of(run));
  std::string text = "run " + options.one_move + ", " + kind + "\n";
  for (std::size_t i = 0; i < kLampCounts; ++i) {
    if (const std::int64_t value = result.counts.values.at(i); value != 0) {
      drivers::print(text, "  %-20s %lld\n",
                     std::string(name_of(static_cast<LampCount>(i))).c_str(),
                     static_cast<long long>(value));
    }
  }
  if (!result.named.empty()) {
    drivers::print(text, "  %s after %.2f s\n", result.named.c_str(),
                   static_cast<double>(result.counts.named_ms_most) / 1000.0);
  }
  if (!write_out(text)) {
    return ExitStatus::kJobFailed;
  }
  return write_scenario(
      file, options.out, *scenario, "Campaign run " + options.one_move + " (" + kind + ")",
      [&](const drivers::Scenario& read) { return runner.run(read, run).counts == result.counts; });
}

/// Runs, reduces and writes one move.
class OneMove {
 public:
  OneMove(const CampaignOptions& options, std::uint64_t seed, std::int64_t move)
      : options_(options), seed_(seed), move_(move) {}

  ExitStatus run() {
    // A place that cannot be written to is found out now, not after the reduction.
    if (!file_.open(options_.out)) {
      tell(file_.message());
      return ExitStatus::kWrongInput;
    }
    MoveMaker({options_.sizes}).make(seed_, move_, *scenario_);
    const std::string stratum = name_of(stratum_at(stratum_of_move(move_)));
    const MoveResult result = run(*scenario_, false);
    if (options_.reduce && result.counts[Count::kWrongTube] == 0) {
      tell("--reduce: move " + options_.one_move +
           " vouches for no wrong tube, expected one that does");
      return ExitStatus::kWrongInput;
    }
    std::string text =
        "move " + options_.one_move + ", " + stratum + "\n" + counts_text(result.counts);
    if (options_.reduce) {
      reduce();
      drivers::print(text, "reduced to %zu path parts, %zu faults and %.3f s\n",
                     scenario_->path.size(), scenario_->faults.size(), scenario_->video.length_s);
    }
    return write_out(text) ? write(stratum) : ExitStatus::kJobFailed;
  }

 private:
  MoveResult run(const drivers::Scenario& scenario, bool stop_at_wrong) {
    return runner_.run(scenario, {!options_.without_margin_check, stop_at_wrong});
  }

  /// How many tries that takes nobody knows beforehand.
  void reduce() {
    ProgressLine progress;
    std::int64_t tries = 0;
    campaign::reduce(*scenario_, [&](const drivers::Scenario& scenario) {
      const bool shows_it = run(scenario, true).counts[Count::kWrongTube] > 0;
      std::string words;
      drivers::print(words, "reducing: %lld tries, %zu path parts, %zu faults, %.3f s",
                     static_cast<long long>(++tries), scenario.path.size(), scenario.faults.size(),
                     scenario.video.length_s);
      progress.update(ProgressLine::Clock::now(), words);
      return shows_it;
    });
  }

  // Faults of whole frames are drawn between two now and then; a scenario file may hold none that
  // does nothing.
  void drop_idle_faults() {
    const auto world = std::make_unique<drivers::SimulatedWorld>();
    if (world->configure(*scenario_)) {
      std::erase_if(scenario_->faults,
                    [&](const drivers::Fault& fault) { return !world->hits(fault); });
    }
  }

  ExitStatus write(const std::string& stratum) {
    drop_idle_faults();
    return write_scenario(file_, options_.out, *scenario_,
                          "Campaign move " + options_.one_move + " (" + stratum + ")",
                          [this](const drivers::Scenario& read) {
                            return run(read, false).counts == run(*scenario_, false).counts;
                          });
  }

  const CampaignOptions& options_;
  std::uint64_t seed_;
  std::int64_t move_;
  MoveRunner runner_;
  drivers::AtomicFile file_;
  std::unique_ptr<drivers::Scenario> scenario_ = std::make_unique<drivers::Scenario>();
};

}  // namespace

ExitStatus run_one_move(const CampaignOptions& options) {
  std::int64_t seed = 0;
  std::int64_t move = 0;
  if (!parse_move(options.one_move, seed, move)) {
    tell("--replay-move " + drivers::printable(options.one_move) +
         ": expected SEED:MOVE, two whole numbers from 0");
    return ExitStatus::kWrongInput;
  }
  if (options.lamps) {
    return run_one_lamp(options, static_cast<std::uint64_t>(seed), move);
  }
  return OneMove(options, static_cast<std::uint64_t>(seed), move).run();
}

}  // namespace tubesight::board::campaign
