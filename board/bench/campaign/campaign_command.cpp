#include "board/bench/campaign/campaign_command.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <ratio>
#include <string_view>
#include <vector>

#include "board/bench/campaign/campaign_run.h"
#include "board/bench/campaign/lamp_campaign.h"
#include "board/bench/campaign/one_move_command.h"
#include "board/bench/campaign/report.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/progress_line.h"
#include "board/bench/output/text_output.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/byte_source.h"

namespace tubesight::board {
namespace {

using campaign::CampaignPlan;
using campaign::Count;
using campaign::Progress;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kLargestProgress_bytes = std::size_t{1} << 28U;

bool write_file(const std::string& path, const std::string& text) {
  drivers::AtomicFile file;
  if (!file.open(path) || !file.write(std::string_view(text)) || !file.commit()) {
    tell(file.message());
    return false;
  }
  return true;
}

bool read_progress(const std::string& path, Progress& progress) {
  std::string text;
  std::string why;
  if (!drivers::read_whole_file(path, kLargestProgress_bytes, text, why)) {
    tell(path + ": " + why);
    return false;
  }
  if (!progress.parse(text, path, why)) {
    tell(why);
    return false;
  }
  return true;
}

/// One campaign, or the merging of several.
class CampaignCommand {
 public:
  CampaignCommand(const CampaignOptions& options, const std::string& version)
      : options_(options), version_(version) {}

  ExitStatus run() {
    plan_.limits = {options_.moves.value_or(0), options_.fields.value_or(0),
                    options_.hours.value_or(0.0)};
    plan_.jobs = options_.jobs.value_or(1);
    plan_.run.margin_check = !options_.without_margin_check;
    plan_.draw.sizes = options_.sizes;
    if (options_.lamps) {
      return run_lamps();
    }
    return options_.merge.empty() ? run_moves() : merge();
  }

 private:
  ExitStatus run_moves() {
    progress_ = Progress(
        {campaign::box_identity(version_), campaign::configuration_name(plan_.run, plan_.draw)});
    if (!options_.resume.empty() && std::filesystem::exists(options_.resume) && !resume()) {
      return ExitStatus::kWrongInput;
    }
    choose_first_move();
    tell_plan();
    // A place that cannot be written to is found out now, not after hours.
    for (const std::string& path : {options_.resume, options_.report}) {
      drivers::AtomicFile file;
      if (!path.empty() && !file.open(path)) {
        tell(file.message());
        return ExitStatus::kWrongInput;
      }
    }
    campaign::CampaignWatcher watcher;
    watcher.found_wrong = [](const campaign::WrongMove& wrong) {
      tell("wrong tube vouched for: move " + std::to_string(wrong.seed) + ":" +
           std::to_string(wrong.move) + ", field " + std::to_string(wrong.field));
    };
    watcher.done_move = [this](const Progress& progress) { return note(progress); };
    const std::string trouble = campaign::run_campaign(plan_, progress_, watcher);
    line_.erase();
    if (!trouble.empty()) {
      tell(trouble);
      return ExitStatus::kJobFailed;
    }
    if (failed_ || (!options_.resume.empty() && !write_file(options_.resume, progress_.text()))) {
      return ExitStatus::kJobFailed;
    }
    return tell_results();
  }

  ExitStatus run_lamps() {
    plan_.seed = static_cast<std::uint64_t>(options_.seed.value_or(1));
    plan_.first_move = options_.first_move.value_or(0);
    tell_plan();
    drivers::AtomicFile report;
    if (!options_.report.empty() && !report.open(options_.report)) {
      tell(report.message());
      return ExitStatus::kWrongInput;
    }
    campaign::LampProgress progress;
    campaign::LampWatcher watcher;
    watcher.found = [this](const campaign::LampFinding& found) {
      tell("run " + std::to_string(plan_.seed) + ":" + std::to_string(found.run) + ", " +
           campaign::lamp_kind_name(found.kind) + ": " + found.what);
    };
    watcher.done_run = [this](const campaign::LampProgress& now) {
      show(Clock::now(), "runs", now.end - now.first, now.total()[campaign::LampCount::kFields]);
    };
    const std::string trouble = campaign::run_lamp_campaign(plan_, progress, watcher);
    line_.erase();
    if (!trouble.empty()) {
      tell(trouble);
      return ExitStatus::kJobFailed;
    }
    if (!options_.report.empty() &&
        !write_file(options_.report, campaign::lamp_report_csv(progress))) {
      return ExitStatus::kJobFailed;
    }
    const std::string box =
        campaign::box_identity(version_) + ", " + campaign::configuration_name({}, plan_.draw);
    const bool written = write_out(campaign::lamp_report_text(progress, box));
    const bool wrong = progress.total()[campaign::LampCount::kWrong] > 0;
    return written && !wrong ? ExitStatus::kDone : ExitStatus::kJobFailed;
  }

  /// With `-v`, what is drawn from.
  void tell_plan() const {
    const std::int64_t done = progress_.total()[Count::kMoves];
    tell_more("campaign: box " + campaign::box_identity(version_) + ", " +
              campaign::configuration_name(plan_.run, plan_.draw) + ", seed " +
              std::to_string(plan_.seed) + " from number " + std::to_string(plan_.first_move) +
              ", " + std::to_string(plan_.jobs) + " at a time" +
              (done > 0 ? ", " + std::to_string(done) + " moves done before" : ""));
  }

  bool resume() {
    Progress before;
    std::string why;
    if (!read_progress(options_.resume, before)) {
      return false;
    }
    if (!progress_.absorb(before, why)) {
      tell(options_.resume + ": " + why);
      return false;
    }
    return true;
  }

  // Unless told otherwise, a progress file goes on with its own moves: another machine of the same
  // campaign may be at the moves before them.
  void choose_first_move() {
    const std::vector<campaign::DoneRange>& done = progress_.ranges();
    plan_.seed = done.empty() ? 1 : done.front().seed;
    if (options_.seed) {
      plan_.seed = static_cast<std::uint64_t>(*options_.seed);
    }
    const auto first = std::find_if(done.begin(), done.end(),
                                    [this](const auto& range) { return range.seed == plan_.seed; });
    plan_.first_move = options_.first_move.value_or(first == done.end() ? 0 : first->first);
  }

  // After every move; the file every five seconds.
  bool note(const Progress& progress) {
    const Clock::time_point now = Clock::now();
    const campaign::Counts total = progress.total();
    show(now, "moves", total[Count::kMoves], total[Count::kFields]);
    if (options_.resume.empty() || now < next_write_) {
      return true;
    }
    next_write_ = now + std::chrono::seconds(5);
    failed_ = !write_file(options_.resume, progress.text());
    return !failed_;
  }

  /// How far the campaign is towards the limit that it comes to first, and at this run's pace.
  void show(Clock::time_point now, const char* kind, std::int64_t moves, std::int64_t fields) {
    const auto part = [](double done, double of) { return of > 0.0 ? done / of : 0.0; };
    const double hours = std::chrono::duration<double, std::ratio<3600>>(now - begun_).count();
    const double done = std::max({part(static_cast<double>(moves), double(plan_.limits.moves)),
                                  part(static_cast<double>(fields), double(plan_.limits.fields)),
                                  part(hours, plan_.limits.hours)});
    const double before = before_.value_or(done);
    before_ = before;
    const double share = before < 1.0 ? (done - before) / (1.0 - before) : 1.0;
    const std::string left = share_words(share, now - begun_);
    line_.update(now, std::to_string(moves) + ' ' + kind + ", " + std::to_string(fields) +
                          " fields" + (left.empty() ? "" : ", of this run " + left));
  }

  ExitStatus merge() {
    for (const std::string& path : options_.merge) {
      Progress one;
      std::string why;
      if (!read_progress(path, one)) {
        return ExitStatus::kWrongInput;
      }
      if (progress_.ranges().empty()) {
        progress_ = Progress(one.identity());
      }
      if (!progress_.absorb(one, why)) {
        tell(path + ": " + why);
        return ExitStatus::kWrongInput;
      }
    }
    if (!options_.out.empty() && !write_file(options_.out, progress_.text())) {
      return ExitStatus::kJobFailed;
    }
    return tell_results();
  }

  ExitStatus tell_results() {
    if (!options_.report.empty() && !write_file(options_.report, campaign::report_csv(progress_))) {
      return ExitStatus::kJobFailed;
    }
    const std::string text = campaign::report_text(progress_);
    if (!write_out(text)) {
      return ExitStatus::kJobFailed;
    }
    // The self-proof is there to find errors; anything else that finds one has failed.
    const bool wrong = progress_.total()[Count::kWrongTube] > 0;
    if (!campaign::is_self_proof(progress_.identity().configuration)) {
      return wrong ? ExitStatus::kJobFailed : ExitStatus::kDone;
    }
    if (!wrong) {
      tell("self-proof: no wrong tube found without the margin check, expected one at least");
    }
    return wrong ? ExitStatus::kDone : ExitStatus::kJobFailed;
  }

  const CampaignOptions& options_;
  const std::string& version_;
  CampaignPlan plan_;
  Progress progress_;
  const Clock::time_point begun_ = Clock::now();
  std::optional<double> before_;  ///< share done when this run's first move was
  ProgressLine line_;
  Clock::time_point next_write_{};
  bool failed_ = false;
};

/// An option that only some tasks take.
struct TaskOption {
  const char* name;
  bool given;
  bool for_one_move;  ///< goes with --replay-move too; with --merge none does
};

/// The option that a merge or a single move has no use for; empty when there is none.
std::string find_useless(const CampaignOptions& options) {
  const bool merges = !options.merge.empty();
  const std::array<TaskOption, 8> rest = {{
      {"--resume", !options.resume.empty(), false},
      {"--seed", options.seed.has_value(), false},
      {"--first-move", options.first_move.has_value(), false},
      {"--jobs", options.jobs.has_value(), false},
      {"--report", !options.report.empty() && !merges, false},
      {"--without-margin-check", options.without_margin_check, true},
      {"--lamps", options.lamps, true},
      {"--sizes", options.sizes, true},
  }};
  for (const TaskOption& option : rest) {
    if (option.given && (merges || !option.for_one_move)) {
      return option.name;
    }
  }
  return {};
}

std::string why_arguments_contradict(const CampaignOptions& options) {
  const bool limited = options.moves || options.fields || options.hours;
  const int tasks =
      (limited ? 1 : 0) + (options.merge.empty() ? 0 : 1) + (options.one_move.empty() ? 0 : 1);
  if (tasks != 1) {
    return "tubesight campaign: expected a limit (--moves, --fields, --hours); or --merge; or "
           "--replay-move";
  }
  if (const std::string useless = limited ? "" : find_useless(options); !useless.empty()) {
    return "tubesight campaign: " + useless + " does not go with " +
           (options.merge.empty() ? "--replay-move" : "--merge") +
           ", expected a limit (--moves, --fields, --hours)";
  }
  if (!options.one_move.empty() && options.out.empty()) {
    return "tubesight campaign: --replay-move needs --out";
  }
  if (options.reduce && options.one_move.empty()) {
    return "tubesight campaign: --reduce needs --replay-move";
  }
  if (options.lamps) {
    const std::string useless = !options.resume.empty()        ? "--resume"
                                : options.reduce               ? "--reduce"
                                : options.without_margin_check ? "--without-margin-check"
                                                               : "";
    if (!useless.empty()) {
      return "tubesight campaign: " + useless + " does not go with --lamps, expected one of them";
    }
  }
  if (limited && !options.out.empty()) {
    return "tubesight campaign: --out goes with --replay-move or --merge";
  }
  return {};
}

/// Where an output cannot go; empty when all can. A progress file is hours of work: nothing else is
/// ever written over one that is read, the merged progress neither.
std::string find_output_conflict(const CampaignOptions& options) {
  std::vector<NamedPath> inputs = {{"--resume", options.resume}};
  for (const std::string& path : options.merge) {
    inputs.push_back({"a file of --merge", path});
  }
  const std::vector<NamedPath> outputs = {{"--out", options.out}, {"--report", options.report}};
  return find_clash(inputs, outputs);
}

}  // namespace

ExitStatus run_campaign(const CampaignOptions& options, const std::string& version) {
  for (const std::string& why :
       {why_arguments_contradict(options), find_output_conflict(options)}) {
    if (!why.empty()) {
      tell(why);
      return ExitStatus::kWrongInput;
    }
  }
  if (!options.one_move.empty()) {
    return campaign::run_one_move(options);
  }
  return CampaignCommand(options, version).run();
}

}  // namespace tubesight::board
