#include "board/bench/calibrate/template_command.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "board/bench/calibrate/template_sheet.h"
#include "board/bench/output/text_output.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

struct Paper {
  std::string_view name;
  std::array<double, 2> size_mm;
};
constexpr std::array<Paper, 5> kPapers = {{{"A4", {210.0, 297.0}},
                                           {"A3", {297.0, 420.0}},
                                           {"A2", {420.0, 594.0}},
                                           {"letter", {215.9, 279.4}},
                                           {"tabloid", {279.4, 431.8}}}};
constexpr double kLargestPaper_mm = 5000.0;

bool parse_mm(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value > 0.0 &&
         value <= kLargestPaper_mm;
}

bool find_paper(std::string_view name, std::array<double, 2>& size_mm) {
  for (const Paper& paper : kPapers) {
    if (paper.name == name) {
      size_mm = paper.size_mm;
      return true;
    }
  }
  const std::size_t comma = name.find(',');
  return comma != std::string_view::npos && parse_mm(name.substr(0, comma), size_mm[0]) &&
         parse_mm(name.substr(comma + 1), size_mm[1]);
}

/// From a dot to the nearest other one.
double nearest_mm(const drivers::TargetSettings& target) {
  const bool staggered = target.lattice == drivers::DotLattice::kStaggered;
  return std::min(target.spacing_mm,
                  std::hypot(target.row_spacing_mm, staggered ? 0.5 * target.spacing_mm : 0.0));
}

std::string target_text(const drivers::TargetSettings& target,
                        const std::array<double, 2>& scale_mm) {
  std::string text = "[target]\n";
  drivers::print(text, "rows = %d\ncolumns = %d\nlattice = \"%s\"\n", target.rows, target.columns,
                 target.lattice == drivers::DotLattice::kSquare ? "square" : "staggered");
  drivers::print(text,
                 "spacing_mm = %s      # as drawn: times the scale across as measured, by %.0f\n"
                 "row_spacing_mm = %s  # the same by the scale down, %.0f\n"
                 "dot_mm = %s\ndots = \"%s\"\n",
                 drivers::number_text(target.spacing_mm).c_str(), scale_mm[0],
                 drivers::number_text(target.row_spacing_mm).c_str(), scale_mm[1],
                 drivers::number_text(target.dot_mm).c_str(), target.bright ? "bright" : "dark");
  return text;
}

}  // namespace

ExitStatus run_calibrate_template(CalibrateTemplateOptions options) {
  const auto refuse = [](const std::string& why) {
    tell(why);
    return ExitStatus::kWrongInput;
  };
  const bool svg = options.out.ends_with(".svg");
  if (!svg && !options.out.ends_with(".pdf")) {
    return refuse(options.out + ": expected a name that ends in .svg or .pdf");
  }
  drivers::TargetSettings& target = options.target;
  target.lattice = options.lattice == "staggered" ? drivers::DotLattice::kStaggered
                                                  : drivers::DotLattice::kSquare;
  target.bright = options.dots == "bright";
  if (!(target.row_spacing_mm > 0.0)) {
    target.row_spacing_mm = target.spacing_mm;
  }
  std::array<double, 2> paper_mm{};
  if (!find_paper(options.paper, paper_mm)) {
    return refuse("--paper: " + drivers::in_quotes(options.paper) +
                  ", expected A4, A3, A2, letter, tabloid, or WIDTH,HEIGHT in mm");
  }
  // Dots that nearly touch are one to whoever looks for them.
  constexpr double kLargestDot = 0.8;
  if (target.dot_mm > kLargestDot * nearest_mm(target)) {
    return refuse("--dot-mm: " + drivers::number_text(target.dot_mm) + ", expected at most " +
                  drivers::rounded_text(kLargestDot * nearest_mm(target)) +
                  " where the nearest dots are " + drivers::rounded_text(nearest_mm(target)) +
                  " mm apart");
  }
  TemplateSheet sheet;
  if (const std::string why = lay_out(target, paper_mm, sheet); !why.empty()) {
    return refuse("--paper: " + options.paper + ": the template " + why);
  }
  drivers::AtomicFile file;
  if (!file.open(options.out)) {
    return refuse(file.message());
  }
  if (!file.write(svg ? svg_text(sheet) : pdf_text(sheet)) || !file.commit()) {
    tell(file.message());
    return ExitStatus::kJobFailed;
  }
  return write_out(target_text(target, sheet.scale_mm)) ? ExitStatus::kDone
                                                        : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
