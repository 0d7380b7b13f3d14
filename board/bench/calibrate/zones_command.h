#pragma once

#include <string>

#include "board/bench/output/exit_status.h"

namespace tubesight::board {

/// The arguments of `tubesight calibrate zones`.
struct CalibrateZonesOptions {
  std::string pairs;
  std::string base;     ///< a settings file with [base]
  std::string picture;  ///< of the corrections over the sheet
  std::string out;
};

/// `tubesight calibrate zones`: what the tool's place by vision is off the one by the calibrated
/// base, place by place, and between the places. Corrections that stand in `out` already are kept,
/// the new ones added, the former file kept as `out.bak`.
///
/// Pairs that contradict the corrections there, or each other, give one line on standard error and
/// status kJobFailed, and `out` stays as it was.
[[nodiscard]] ExitStatus run_calibrate_zones(const CalibrateZonesOptions& options);

}  // namespace tubesight::board
