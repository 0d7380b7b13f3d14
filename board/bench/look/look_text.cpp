#include "board/bench/look/look_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "board/bench/output/csv_cells.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::detection::FinderRefusal;
using core::detection::FoundLattice;
using core::detection::LatticeElement;

double diameter_px(const LatticeElement& element) {
  return 2.0 * core::detection::half_axes(element.ellipse).x();
}

/// From the column's step to the row's.
double angle_deg(const core::detection::Steps& steps) {
  const double cosine = steps.column.dot(steps.row) / (steps.column.norm() * steps.row.norm());
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

// Without a camera the lens' bending stays in the steps: some hundredths, some degrees.
constexpr double kEqualSteps = 0.06;
constexpr double kNear_deg = 4.0;

std::string_view kind_of(const core::detection::Steps& steps) {
  const double angle = angle_deg(steps);
  const bool equal = std::abs(std::log(steps.column.norm() / steps.row.norm())) < kEqualSteps;
  if (std::abs(angle - 90.0) < kNear_deg) {
    return equal ? "a square" : "a rectangular";
  }
  if (equal && std::min(std::abs(angle - 60.0), std::abs(angle - 120.0)) < kNear_deg) {
    return "a triangular";
  }
  return "an oblique";
}

}  // namespace

void append_look_rows(std::string& out, const std::string& image, const FoundLattice& found) {
  for (const LatticeElement& element : found.elements) {
    append_text(out, image);
    drivers::print(out, ",%d,%d", element.row, element.column);
    append_cell(out, element.center_px.x(), 3);
    append_cell(out, element.center_px.y(), 3);
    append_cell(out, diameter_px(element), 3);
    out += '\n';
  }
}

std::string look_text(const std::string& image, const FoundLattice& found) {
  std::int32_t rows = 0;
  std::int32_t columns = 0;
  std::int32_t measured = 0;
  double smallest = 1e9;
  double largest = 0.0;
  double squares = 0.0;
  for (const LatticeElement& element : found.elements) {
    rows = std::max(rows, element.row + 1);
    columns = std::max(columns, element.column + 1);
    smallest = std::min(smallest, diameter_px(element));
    largest = std::max(largest, diameter_px(element));
    measured += element.share > 0.0 ? 1 : 0;
    squares += element.rms_px * element.rms_px;
  }
  std::string text = image;
  const std::string_view kind = kind_of(found.steps);
  drivers::print(text, ": %.*s lattice of %s elements: %d found, in %d rows and %d columns\n",
                 static_cast<int>(kind.size()), kind.data(), found.dark ? "dark" : "bright",
                 found.elements.size(), rows, columns);
  drivers::print(text,
                 "  steps                %.3f along a row, %.3f along a column (diameters), "
                 "%.1f deg apart\n",
                 found.steps.column.norm() / 2.0, found.steps.row.norm() / 2.0,
                 angle_deg(found.steps));
  drivers::print(text, "  diameters            %.1f to %.1f px\n", smallest, largest);
  drivers::print(text, "  edges                %d measured", measured);
  if (measured > 0) {
    drivers::print(text, ", RMS %.3f px from their ellipses", std::sqrt(squares / measured));
  }
  if (measured < found.elements.size()) {
    drivers::print(text, "; %d placed by their pixels", found.elements.size() - measured);
  }
  text += '\n';
  return text;
}

std::string_view explain(FinderRefusal refusal) {
  switch (refusal) {
    case FinderRefusal::kNone: return "";
    case FinderRefusal::kSize: return "a side outside 24 to 4096 pixels";
    case FinderRefusal::kFlat: return "no contrast in the picture";
    case FinderRefusal::kTooMany: return "spots all over, and no like ones that stand out";
    case FinderRefusal::kNoLattice: return "no five like spots in rows and columns";
  }
  return "";
}

}  // namespace tubesight::board
