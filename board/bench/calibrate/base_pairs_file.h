#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/calibration/base_pairs.h"
#include "core/calibration/link_calibration.h"

namespace tubesight::board {

/// The pairs of a file, and their names in the same order.
struct NamedPairs {
  core::calibration::BasePairs pairs;
  std::vector<std::string> names;
  core::calibration::PairJoints joints;  ///< all 0 where the file has none
  std::int32_t joint_columns = 0;        ///< joint_1_deg and so on
};

/// Reads PAIRS.csv (docs/file-formats.md). False, and a line in `messages` for each bad row, which
/// says where and what: nothing of the file is then to be used.
[[nodiscard]] bool read_base_pairs(const std::string& path, NamedPairs& pairs,
                                   std::vector<std::string>& messages);

}  // namespace tubesight::board
