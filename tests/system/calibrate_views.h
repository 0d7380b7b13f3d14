#pragma once

#include <cmath>
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

/// A camera whose pixels are cells of 0.01 mm, as a target's file knows it beforehand.
inline const std::string kPlainCamera =
    "[camera]\nwidth_px = 640\nheight_px = 480\nscan = \"progressive\"\ncell_width_mm = 0.01\n"
    "cell_height_mm = 0.01\nsensor_columns = 640\nframe_columns = 640\n";

/// A points file of ten lines of ten points, 8 mm apart, as a plain camera of EFL 5 mm with a
/// distortion of 0.01 per mm2 sees them: from `away` mm, leaning by the sine `lean`, with `depth`
/// out of the plane in steps and a `wave` along it, mm, each off by up to `off_px` as by chance.
struct ComputedPoints {
  double away = 82.0;
  double lean = 0.005;
  double depth = 0.0;
  double wave = 0.0;
  double off_px = 0.0;
  bool exchanged = false;
  bool half = false;  ///< those of the left half alone

  [[nodiscard]] std::string text() const {
    std::string rows = depth > 0.0 ? "x_mm,y_mm,z_mm,u_px,v_px\n" : "x_mm,y_mm,u_px,v_px\n";
    for (int i = 0; i < 100; ++i) {
      const double x = 8.0 * (i % 10);
      const double y = 8.0 * (i / 10);
      const double z = depth * (i * 7 % 3);
      if (half && i % 10 >= 5) {
        continue;
      }
      const double cosine = std::sqrt(1.0 - lean * lean);
      const double far = away + lean * (y - 36.0) + cosine * z;
      const double ideal_x = 5.0 * (x + wave * std::sin(x / 12.0) - 36.0) / far;
      const double ideal_y = 5.0 * (cosine * (y - 36.0) - lean * z) / far;
      double factor = 1.0;
      for (int k = 0; k < 60; ++k) {
        factor = 1.0 + 0.01 * (ideal_x * ideal_x + ideal_y * ideal_y) / (factor * factor);
      }
      const double u = 310.0 + 100.0 * ideal_x / factor + off_px * std::sin(37.0 * i * i + away);
      const double v = 245.0 + 100.0 * ideal_y / factor + off_px * std::cos(53.0 * i * i + away);
      rows += std::to_string(exchanged ? y : x) + "," + std::to_string(exchanged ? x : y) + "," +
              (depth > 0.0 ? std::to_string(z) + "," : "") + std::to_string(u) + "," +
              std::to_string(v) + "\n";
    }
    return rows;
  }
};

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
