#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/overlay/painter.h"

namespace tubesight::board {

/// One line of a plot.
struct Series {
  std::string name;
  core::overlay::Rgb colour;
  std::vector<std::array<double, 2>> points;  ///< in rising x
  bool joined = true;                         ///< by lines; otherwise dots on stems
};

/// One panel: axes from zero, a caption, lines with their names.
struct Panel {
  std::string caption;
  std::string x_name;
  std::string y_name;
  std::vector<Series> series;
};

/// Draws panels in two columns and writes them as a PNG. False, with one line in `message`, when
/// it can't be written.
[[nodiscard]] bool write_plot(const std::string& path, const std::vector<Panel>& panels,
                              std::string& message);

}  // namespace tubesight::board
