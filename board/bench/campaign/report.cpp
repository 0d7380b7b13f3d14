#include "board/bench/campaign/report.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "board/bench/campaign/binomial_bounds.h"
#include "board/bench/campaign/report_groups.h"
#include "drivers/files/decimal.h"

namespace tubesight::board::campaign {
namespace {

using drivers::print;

long long count(std::int64_t value) { return value; }

double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

/// An error: its fields, and the moves that had one.
struct Error {
  const char* text;
  Count fields;
  Count moves;
};

constexpr std::array<Error, 5> kErrors = {{
    {"wrong tube vouched for", Count::kWrongTube, Count::kMovesWrongTube},
    {"falsely aligned", Count::kFalseAligned, Count::kMovesFalseAligned},
    {"wrong nearest tube", Count::kWrongNearest, Count::kMovesWrongNearest},
    {"undetectable jumps", Count::kUndetectable, Count::kMovesUndetectable},
    {"missed", Count::kMissed, Count::kMovesMissed},
}};

constexpr std::array<Count, 11> kLosses = {
    Count::kLostNoTubes, Count::kLostCoasted,    Count::kLostJump,       Count::kLostSpeed,
    Count::kLostGap,     Count::kLostTime,       Count::kLostArithmetic, Count::kLostSequence,
    Count::kLostRate,    Count::kLostFieldOrder, Count::kLostMap};

void print_totals(std::string& out, const Progress& progress) {
  const Counts total = progress.total();
  for (const DoneRange& range : progress.ranges()) {
    print(out, "seed %llu: moves %lld to %lld\n", static_cast<unsigned long long>(range.seed),
          count(range.first), count(range.end - 1));
  }
  const double hours = static_cast<double>(progress.busy_ms()) / 3.6e6;
  print(out, "box %s, %s\n", progress.identity().box.c_str(),
        progress.identity().configuration.c_str());
  print(out,
        "%lld moves, %lld fields seen by the box, %lld more after losses, %lld tubes visited; "
        "%.2f hours of one job\n",
        count(total[Count::kMoves]), count(total[Count::kFields]), count(total[Count::kAfterLoss]),
        count(total[Count::kTubes]), hours);
  print(out, "\n%-24s %8s %8s   %s\n", "", "fields", "moves",
        "share of moves (95 % Clopper-Pearson)");
  for (const Error& error : kErrors) {
    const BinomialBounds bounds = binomial_bounds(total[error.moves], total[Count::kMoves]);
    print(out, "%-24s %8lld %8lld   %.4f %% (%.4f to %.4f %%)\n", error.text,
          count(total[error.fields]), count(total[error.moves]),
          100.0 * share(total[error.moves], total[Count::kMoves]), 100.0 * bounds.lower,
          100.0 * bounds.upper);
  }
  print(out, "\ntracks lost: %lld, starts refused: %lld; reasons:", count(total[Count::kMovesLost]),
        count(total[Count::kMovesRefused]));
  for (const Count loss : kLosses) {
    if (total[loss] > 0) {
      const std::string_view name = name_of(loss);
      print(out, " %s %lld", std::string(name).c_str(), count(total[loss]));
    }
  }
  out += "\n";
}

void print_group(std::string& out, const ReportGroup& group) {
  const Counts& c = group.counts;
  print(out, "%-20s %8lld %9lld %6lld %6lld %6lld %6lld %9.3f %9.3f %7.2f %7lld\n",
        group.name.c_str(), count(c[Count::kMoves]), count(c[Count::kFields]),
        count(c[Count::kWrongTube]), count(c[Count::kFalseAligned]), count(c[Count::kWrongNearest]),
        count(c[Count::kUndetectable]), 100.0 * share(c[Count::kMissed], c[Count::kTrulyAligned]),
        100.0 * share(c[Count::kMissed] - c[Count::kMissedLost], c[Count::kTrulyAligned]),
        100.0 * share(c[Count::kMovesLost], c[Count::kMoves]), count(c[Count::kMovesRefused]));
}

void append_bounds(std::string& out, std::int64_t events, std::int64_t moves) {
  const BinomialBounds bounds = binomial_bounds(events, moves);
  print(out, ",%.7f,%.7f,%.7f", share(events, moves), bounds.lower, bounds.upper);
}

}  // namespace

std::string report_text(const Progress& progress) {
  std::string out;
  print_totals(out, progress);
  print(out, "\n%-20s %8s %9s %6s %6s %6s %6s %9s %9s %7s %7s\n", "", "moves", "fields", "wrong",
        "false", "near", "undet", "missed %", "tracking", "lost %", "refused");
  for (const ReportGroup& group : report_groups(progress, false)) {
    print_group(out, group);
  }
  std::int64_t fewest = progress.total()[Count::kMoves];
  for (const Counts& counts : progress.strata()) {
    fewest = std::min(fewest, counts[Count::kMoves]);
  }
  print(out, "\n%d strata; the smallest has %lld moves, %.2f %% of all\n", kStrata, count(fewest),
        100.0 * share(fewest, progress.total()[Count::kMoves]));
  return out;
}

std::string report_csv(const Progress& progress) {
  std::string out = "group";
  for (std::size_t i = 0; i < kCounts; ++i) {
    out += ',';
    out += name_of(static_cast<Count>(i));
  }
  out += ",missed_share";
  for (const char* name : {"wrong_tube", "false_aligned", "wrong_nearest", "lost"}) {
    for (const char* part : {"share", "lower", "upper"}) {
      out += std::string(",moves_") + name + "_" + part;
    }
  }
  out += '\n';
  for (const ReportGroup& group : report_groups(progress, true)) {
    const Counts& c = group.counts;
    out += group.name;
    for (std::size_t i = 0; i < kCounts; ++i) {
      print(out, ",%lld", count(c[static_cast<Count>(i)]));
    }
    print(out, ",%.7f", share(c[Count::kMissed], c[Count::kTrulyAligned]));
    for (const Count moves : {Count::kMovesWrongTube, Count::kMovesFalseAligned,
                              Count::kMovesWrongNearest, Count::kMovesLost}) {
      append_bounds(out, c[moves], c[Count::kMoves]);
    }
    out += '\n';
  }
  return out;
}

}  // namespace tubesight::board::campaign
