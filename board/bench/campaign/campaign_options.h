#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tubesight::board {

/// The arguments of `tubesight campaign`; an empty path is one that was not given.
struct CampaignOptions {
  std::optional<std::int64_t> moves;
  std::optional<std::int64_t> fields;
  std::optional<double> hours;
  std::optional<std::int64_t> seed;        ///< not given: that of the progress file, or 1
  std::optional<std::int64_t> first_move;  ///< not given: the progress file's first, or 0
  std::optional<std::int32_t> jobs;
  std::string resume;  ///< progress file
  std::string report;  ///< CSV
  std::vector<std::string> merge;
  std::string one_move;  ///< "SEED:MOVE"
  std::string out;
  bool reduce = false;
  bool without_margin_check = false;
  bool lamps = false;  ///< runs of lamps in place of moves
  bool sizes = false;  ///< pictures of other sizes and rates
};

}  // namespace tubesight::board
