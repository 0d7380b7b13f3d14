#pragma once

#include <string>

#include "board/bench/output/exit_status.h"
#include "drivers/settings/target_settings.h"

namespace tubesight::board {

/// The arguments of `tubesight calibrate template`.
struct CalibrateTemplateOptions {
  std::string out;  ///< its ending says what it becomes: .svg or .pdf
  std::string paper = "A4";
  std::string lattice = "square";
  std::string dots = "dark";
  bool given = false;  ///< any of these was
  drivers::TargetSettings target{10, 10, drivers::DotLattice::kSquare, 8.0, 0.0, 4.0, false};
};

/// `tubesight calibrate template`: a dot template to print, with scales to measure it by. What a
/// target's file says of it goes to standard output.
[[nodiscard]] ExitStatus run_calibrate_template(CalibrateTemplateOptions options);

}  // namespace tubesight::board
