#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/calibration/base_calibration.h"

namespace tubesight::board {

/// What a base calibration was made of and for.
struct BaseReport {
  const core::calibration::BaseCalibration& base;
  const core::calibration::PairOutcomes& outcomes;
  const core::calibration::BasePairs& pairs;
  const std::vector<std::string>& names;
  core::calibration::BaseKnowledge knowledge;
  core::calibration::NextPlace next;
};

/// What a technician reads: base with standard deviations, pairs, the tool over the generator.
[[nodiscard]] std::string base_text(const BaseReport& report);

/// Why there is none, in a line without the file's name.
[[nodiscard]] std::string why_no_base(const core::calibration::BaseCalibration& base,
                                      std::string_view generator);

/// `[base]` and `[base_quality]`.
[[nodiscard]] std::string base_settings(const BaseReport& report);

/// What it is good for, as told and written.
[[nodiscard]] std::string_view use_of(core::calibration::BaseVerdict verdict);

}  // namespace tubesight::board
