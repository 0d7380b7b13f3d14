// A progress file: the text of a Progress, and back.

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "board/bench/campaign/progress.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::board::campaign {
namespace {

constexpr std::array<std::string_view, 8> kFixedColumns = {
    "format", "box", "configuration", "seed", "first_move", "end_move", "busy_ms", "stratum"};
constexpr std::string_view kFormat = "1";
constexpr std::string_view kAll = "all";

std::vector<std::string_view> columns() {
  std::vector<std::string_view> names(kFixedColumns.begin(), kFixedColumns.end());
  for (std::size_t i = 0; i < kCounts; ++i) {
    names.push_back(name_of(static_cast<Count>(i)));
  }
  return names;
}

void append_row(std::string& text, const CampaignIdentity& identity, const DoneRange& range,
                std::string_view stratum, const Counts& counts) {
  text += kFormat;
  for (const std::string& cell :
       {identity.box, identity.configuration, std::to_string(range.seed),
        std::to_string(range.first), std::to_string(range.end), std::to_string(range.busy_ms)}) {
    text += ',' + cell;
  }
  text += ',';
  text += stratum;
  for (std::size_t i = 0; i < kCounts; ++i) {
    text += ',';
    drivers::append_whole(text, counts[static_cast<Count>(i)]);
  }
  text += '\n';
}

/// Rows of one range while they are read.
struct OpenRange {
  DoneRange range;
  Counts sum;
  Counts all;
  bool has_all = false;
};

/// Moves before `end` that are of a stratum.
std::int64_t moves_before(std::int64_t end, std::int32_t stratum) {
  return end / kStrata + (end % kStrata > stratum ? 1 : 0);
}

/// What of a range's rows is not right; empty when they are whole. A range that claims more moves
/// than were run would leave the others out for ever.
std::string why_not_whole(const OpenRange& open) {
  if (!open.has_all || !(open.sum == open.all)) {
    return "the rows do not add up to their row \"all\"";
  }
  for (std::int32_t s = 0; s < kStrata; ++s) {
    const std::int64_t expected =
        moves_before(open.range.end, s) - moves_before(open.range.first, s);
    const std::int64_t moves = open.range.strata[static_cast<std::size_t>(s)][Count::kMoves];
    if (moves != expected) {
      return "stratum " + name_of(stratum_at(s)) + " has " + std::to_string(moves) +
             " moves, expected " + std::to_string(expected);
    }
  }
  return {};
}

/// Reads the rows of a progress file.
class ProgressReader {
 public:
  ProgressReader(const std::string& text, const std::string& name)
      : csv_(text, name), name_(name) {}

  bool read(std::string& why) {
    drivers::Messages messages;
    if (!csv_.read_header(columns(), messages)) {
      why = name_ + ": not a progress file of tubesight campaign, expected the header format,box," +
            "configuration,seed and so on (docs/campaign.md has all columns)";
      return false;
    }
    while (csv_.next(messages) && messages.empty()) {
      if (!take_row()) {
        why = csv_.place() + problem_;
        return false;
      }
    }
    if (!messages.empty()) {
      why = messages.front();
      return false;
    }
    for (const OpenRange& open : open_) {
      if (const std::string problem = why_not_whole(open); !problem.empty()) {
        why = name_ + ": moves " + std::to_string(open.range.first) + " to " +
              std::to_string(open.range.end - 1) + ": " + problem;
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] const CampaignIdentity& identity() const { return identity_; }
  [[nodiscard]] const std::vector<OpenRange>& ranges() const { return open_; }

 private:
  bool take_row() {
    const std::vector<std::string>& cells = csv_.cells();
    if (cells[0] != kFormat) {
      problem_ = "no row of format 1";
      return false;
    }
    const CampaignIdentity identity{cells[1], cells[2]};
    if (open_.empty()) {
      identity_ = identity;
    } else if (!(identity == identity_)) {
      problem_ = "box or configuration differ from the rows above";
      return false;
    }
    DoneRange range;
    std::int64_t seed = 0;
    Counts counts;
    bool good = drivers::parse_whole(cells[3], seed) && seed >= 0 &&
                drivers::parse_whole(cells[4], range.first) &&
                drivers::parse_whole(cells[5], range.end) &&
                drivers::parse_whole(cells[6], range.busy_ms) && range.first >= 0 &&
                range.first < range.end;
    for (std::size_t i = 0; i < kCounts && good; ++i) {
      std::int64_t& value = counts[static_cast<Count>(i)];
      good = drivers::parse_whole(cells[kFixedColumns.size() + i], value) && value >= 0;
    }
    if (!good) {
      problem_ = "seed, moves, time and counts: expected whole numbers from 0";
      return false;
    }
    range.seed = static_cast<std::uint64_t>(seed);
    return put(range, cells[7], counts);
  }

  bool put(const DoneRange& range, const std::string& stratum, const Counts& counts) {
    if (open_.empty() || open_.back().range.seed != range.seed ||
        open_.back().range.first != range.first) {
      open_.push_back({range, {}, {}, false});
    }
    OpenRange& open = open_.back();
    if (open.range.end != range.end || open.range.busy_ms != range.busy_ms) {
      problem_ =
          "end_move or busy_ms differ from the rows above, expected one of each for the moves";
      return false;
    }
    if (stratum == kAll) {
      open.all = counts;
      open.has_all = true;
      return true;
    }
    const std::int32_t index = find_stratum(stratum);
    if (index < 0) {
      problem_ = "stratum " + drivers::in_quotes(stratum) + " is not known";
      return false;
    }
    open.sum += counts;
    open.range.strata[static_cast<std::size_t>(index)] += counts;
    return true;
  }

  drivers::CsvReader csv_;
  std::string name_;
  CampaignIdentity identity_;
  std::vector<OpenRange> open_;
  std::string problem_;
};

}  // namespace

std::string Progress::text() const {
  std::string text;
  for (const std::string_view name : columns()) {
    text += text.empty() ? "" : ",";
    text += name;
  }
  text += '\n';
  for (const DoneRange& range : ranges_) {
    Counts all;
    for (std::int32_t s = 0; s < kStrata; ++s) {
      const Counts& counts = range.strata[static_cast<std::size_t>(s)];
      append_row(text, identity_, range, name_of(stratum_at(s)), counts);
      all += counts;
    }
    append_row(text, identity_, range, kAll, all);
  }
  return text;
}

bool Progress::parse(const std::string& text, const std::string& name, std::string& why) {
  ProgressReader reader(text, name);
  if (!reader.read(why)) {
    return false;
  }
  if (reader.ranges().empty()) {
    why = name + ": no moves in it";
    return false;
  }
  Progress read(reader.identity());
  for (const OpenRange& open : reader.ranges()) {
    Progress one(reader.identity());
    one.ranges_.push_back(open.range);
    std::string problem;
    if (!read.absorb(one, problem)) {
      why = name + ": " + problem;
      return false;
    }
  }
  *this = read;
  return true;
}

}  // namespace tubesight::board::campaign
