#pragma once

#include <array>
#include <string>
#include <vector>

#include "drivers/settings/target_settings.h"

namespace tubesight::board {

/// What is printed, in millimetres from the paper's upper left corner, y down.
struct TemplateSheet {
  struct Box {
    double x = 0.0;
    double y = 0.0;
    double width = 0.0;
    double height = 0.0;
  };
  struct Line {
    double x = 0.0;  ///< where its first letter stands on the line
    double y = 0.0;
    std::string words;
  };

  std::array<double, 2> paper_mm{};
  bool bright = false;                      ///< bright dots on a dark field
  Box field;                                ///< of bright dots: what is dark
  double radius_mm = 0.0;                   ///< of a dot
  std::vector<std::array<double, 2>> dots;  ///< centres, line by line
  std::vector<Box> bars;                    ///< the two scales: their strokes
  std::array<double, 2> scale_mm{};         ///< length of the scales, across and down
  double letters_mm = 0.0;                  ///< size of the letters
  std::vector<Line> text;
};

/// Lays a target out in the middle of a paper, turned where it fits only so. Empty, or why it does
/// not fit.
[[nodiscard]] std::string lay_out(const drivers::TargetSettings& target,
                                  std::array<double, 2> paper_mm, TemplateSheet& sheet);

/// The sheet as a picture of lines: a dot is a circle, and no number is rounded above 0.1 um.
[[nodiscard]] std::string svg_text(const TemplateSheet& sheet);

/// The same as a document of one page, which asks whoever prints it not to scale it. A dot is of
/// eight Bezier curves, off the circle by 4 millionths of its radius.
[[nodiscard]] std::string pdf_text(const TemplateSheet& sheet);

}  // namespace tubesight::board
