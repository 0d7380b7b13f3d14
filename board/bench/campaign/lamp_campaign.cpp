#include "board/bench/campaign/lamp_campaign.h"

#include <chrono>
#include <memory>
#include <utility>

#include "board/bench/campaign/binomial_bounds.h"
#include "board/bench/campaign/ordered_jobs.h"
#include "drivers/files/decimal.h"

namespace tubesight::board::campaign {
namespace {

using Clock = std::chrono::steady_clock;
using drivers::print;

struct Done {
  LampRun run;
  LampResult result;
};

/// What a person should look at; empty: nothing.
std::string why_found(const LampCounts& counts) {
  std::string what;
  const auto add = [&what](const std::string& more) { what += (what.empty() ? "" : ", ") + more; };
  if (counts[LampCount::kWrong] > 0) {
    add("wrong tube vouched for in " + std::to_string(counts[LampCount::kWrong]) + " fields, " +
        std::to_string(counts[LampCount::kWrongUnnamed]) + " of them before the fault had a name");
  }
  if (counts[LampCount::kFalseAlarms] > 0) {
    add("false alarm");
  }
  if (counts[LampCount::kUnnamed] > 0) {
    add(counts[LampCount::kLostBefore] > 0 ? "fault without a name, track lost"
        : counts[LampCount::kUnknown] > 0  ? "fault without a name, liveness not proved"
                                           : "fault without a name");
  }
  return what;
}

long long whole(std::int64_t value) { return value; }

double seconds(std::int64_t ms) { return static_cast<double>(ms) / 1000.0; }

void print_row(std::string& out, const std::string& name, const LampCounts& c) {
  const std::int64_t named = c[LampCount::kNamed];
  print(
      out,
      "%-20s %6lld %8lld %7lld %7.1f %6lld %6lld %7.2f %7.2f %6lld %6lld %6lld %6lld %7lld %8lld\n",
      name.c_str(), whole(c[LampCount::kRuns]), whole(c[LampCount::kFields]),
      whole(c[LampCount::kProved]), seconds(c.proved_ms_most), whole(c[LampCount::kFalseAlarms]),
      whole(named), named > 0 ? seconds(c.named_ms_sum) / static_cast<double>(named) : 0.0,
      seconds(c.named_ms_most), whole(c[LampCount::kNamedLate]), whole(c[LampCount::kUnnamed]),
      whole(c[LampCount::kUnknown]), whole(c[LampCount::kLostBefore]), whole(c[LampCount::kWrong]),
      whole(c[LampCount::kWrongUnnamed]));
}

void append_row(std::string& out, const std::string& name, const LampCounts& counts) {
  out += name;
  for (const std::int64_t value : counts.values) {
    print(out, ",%lld", whole(value));
  }
  print(out, ",%lld,%lld,%lld\n", whole(counts.named_ms_sum), whole(counts.named_ms_most),
        whole(counts.proved_ms_most));
}

}  // namespace

LampCounts LampProgress::total() const {
  LampCounts all;
  for (const LampCounts& kind : kinds) {
    all += kind;
  }
  return all;
}

std::string run_lamp_campaign(const CampaignPlan& plan, LampProgress& progress,
                              const LampWatcher& watcher) {
  const Clock::time_point begun = Clock::now();
  std::string trouble;
  progress = {plan.seed, plan.first_move, plan.first_move, {}};
  OrderedJobs<Done>::Plan jobs;
  jobs.first = plan.first_move;
  jobs.next = [](std::int64_t number) { return number + 1; };
  jobs.worker = [&plan] {
    struct Tools {
      explicit Tools(const DrawOptions& draw) : maker(draw) {}

      LampRunMaker maker;
      LampRunner runner;
      drivers::Scenario scenario;
    };
    const auto tools = std::make_shared<Tools>(plan.draw);
    return [&plan, tools](std::int64_t number) {
      Done done;
      done.run = tools->maker.make(plan.seed, number, tools->scenario);
      done.result = tools->runner.run(tools->scenario, done.run);
      return done;
    };
  };
  jobs.add = [&](std::int64_t number, const Done& done) {
    if (!done.result.runs) {
      trouble = "run " + std::to_string(number) + " of seed " + std::to_string(plan.seed) +
                ": the scenario drawn cannot be played";
      return false;
    }
    const std::int32_t kind = lamp_kind_of(done.run);
    progress.kinds.at(static_cast<std::size_t>(kind)) += done.result.counts;
    progress.end = number + 1;
    if (std::string what = why_found(done.result.counts); !what.empty() && watcher.found) {
      watcher.found({number, kind, std::move(what)});
    }
    if (watcher.done_run) {
      watcher.done_run(progress);
    }
    return !plan.limits.reached(progress.end - progress.first, progress.total()[LampCount::kFields],
                                Clock::now() - begun);
  };
  OrderedJobs<Done>(std::move(jobs)).run(plan.jobs);
  return trouble;
}

std::string lamp_report_text(const LampProgress& progress, const std::string& box) {
  std::string out;
  const LampCounts total = progress.total();
  print(out, "seed %llu: runs %lld to %lld of lamps\nbox %s\n",
        static_cast<unsigned long long>(progress.seed), whole(progress.first),
        whole(progress.end - 1), box.c_str());
  const std::int64_t runs = total[LampCount::kRuns] - total[LampCount::kRefused];
  const BinomialBounds wrong = binomial_bounds(total[LampCount::kRunsWrong], runs);
  const BinomialBounds alarms = binomial_bounds(total[LampCount::kFalseAlarms], runs);
  print(out,
        "%lld runs, %lld starts refused, %lld fields, %lld of them vouched for\n"
        "wrong tube vouched for: %lld fields (%lld before the fault had a name) of %lld runs, "
        "at most %.3f %% of runs (95 %%)\nfalse alarms: %lld runs, at most %.3f %%\n",
        whole(total[LampCount::kRuns]), whole(total[LampCount::kRefused]),
        whole(total[LampCount::kFields]), whole(total[LampCount::kVouched]),
        whole(total[LampCount::kWrong]), whole(total[LampCount::kWrongUnnamed]),
        whole(total[LampCount::kRunsWrong]), 100.0 * wrong.upper,
        whole(total[LampCount::kFalseAlarms]), 100.0 * alarms.upper);
  print(out, "\n%-20s %6s %8s %7s %7s %6s %6s %7s %7s %6s %6s %6s %6s %7s %8s\n", "", "runs",
        "fields", "proved", "slowest", "alarms", "named", "mean s", "most s", "late", "none",
        "unsure", "lost", "wrong", "unnamed");
  for (std::int32_t kind = 0; kind < kLampKinds; ++kind) {
    const LampCounts& counts = progress.kinds.at(static_cast<std::size_t>(kind));
    if (counts[LampCount::kRuns] > 0) {
      print_row(out, lamp_kind_name(kind), counts);
    }
  }
  print_row(out, "all", total);
  return out;
}

std::string lamp_report_csv(const LampProgress& progress) {
  std::string out = "kind";
  for (std::size_t i = 0; i < kLampCounts; ++i) {
    out += ',';
    out += name_of(static_cast<LampCount>(i));
  }
  out += ",named_ms_sum,named_ms_most,proved_ms_most\n";
  for (std::int32_t kind = 0; kind < kLampKinds; ++kind) {
    append_row(out, lamp_kind_name(kind), progress.kinds.at(static_cast<std::size_t>(kind)));
  }
  append_row(out, "all", progress.total());
  return out;
}

}  // namespace tubesight::board::campaign
