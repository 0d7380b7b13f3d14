#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/detection/drawn_lattice.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {

using support::TemporaryFolder;

/// A [[view]] of a target's file.
inline std::string view_of(const std::string& source, const std::string& height_mm = "") {
  return "[[view]]\n" + source + "\n" +
         (height_mm.empty() ? "" : "height_mm = " + height_mm + "\n");
}

/// Runs `tubesight calibrate camera` on t.toml of these settings.
inline ProgramRun calibrate(const TemporaryFolder& folder, const std::string& settings,
                            const std::vector<std::string>& more = {}) {
  folder.write("t.toml", settings);
  std::vector<std::string> arguments = {"calibrate", "camera", "t.toml"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tubesight(folder, arguments);
}

/// The number behind a key of a settings file.
inline double number_of(const std::string& settings, const std::string& key) {
  const std::size_t at = settings.find(key + " = ");
  EXPECT_NE(at, std::string::npos) << key;
  return at == std::string::npos ? 0.0 : std::atof(settings.c_str() + at + key.size() + 3);
}

/// What may be wrong with a picture of dots.
struct DrawnFaults {
  double inside = 170.0;  ///< grey levels of the dots
  int moved_px = 1;       ///< along the rows while it was exposed
};

/// Ten lines of ten bright dots of 4 mm, 8 mm apart, seen by a camera of EFL 5 mm with a distortion
/// of 0.01 per mm2; `away_mm` from it.
inline void draw_dots(const TemporaryFolder& folder, const std::string& name, double away_mm,
                      const DrawnFaults& faults = {}) {
  core::detection::DrawnLattice drawn;
  drawn.distortion = 0.25;
  drawn.background = 12.0;
  drawn.inside = faults.inside;
  drawn.noise = 0.5;
  drawn.rows = 10;
  drawn.columns = 10;
  drawn.turn_deg = 0.7;
  drawn.tilt_deg = 0.3;
  drawn.distance = away_mm / 4.0;
  static_cast<void>(drawn.draw());
  std::string text = "P5\n640 480\n255\n";
  const auto moved = static_cast<std::size_t>(faults.moved_px);
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < moved; ++k) {
      sum += drawn.pixels[i + k < drawn.pixels.size() ? i + k : i];
    }
    text += static_cast<char>((sum / moved + 128) / 256);
  }
  folder.write(name, text);
}

}  // namespace tubesight::tests
