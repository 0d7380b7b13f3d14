#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tubesight::board {

/// The arguments of `tubesight campaign`; an empty path is one that was not given.
struct CampaignOptions {
  std::int64_t moves = 0;  ///< 0: not given, as the others
  std::int64_t fields = 0;
  double hours = 0.0;
  std::int64_t seed = 1;
  std::int64_t first_move = 0;
  std::int32_t jobs = 1;
  std::string resume;  ///< progress file
  std::string report;  ///< CSV
  std::vector<std::string> merge;
  std::string one_move;  ///< "SEED:MOVE"
  std::string out;
  bool reduce = false;
  bool without_margin_check = false;
};

}  // namespace tubesight::board
