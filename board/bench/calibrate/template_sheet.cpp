#include "board/bench/calibrate/template_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

constexpr double kMargin_mm = 10.0;  // which printers leave white
constexpr double kLetters_mm = 3.0;
constexpr double kLineFeed_mm = 4.5;
constexpr double kStroke_mm = 0.2;
constexpr double kTick_mm = 4.0;
// Between the dots and what stands beside them: nothing there may be taken for a dot.
constexpr double kBeside_mm = 6.0;
constexpr int kLines = 3;

/// A scale between two ticks, whose outer edges are its ends.
void add_scale(TemplateSheet& sheet, double x, double y, double length_mm, bool down) {
  const auto add = [&](double along, double across, double size_along, double size_across) {
    sheet.bars.push_back(down ? TemplateSheet::Box{x + across, y + along, size_across, size_along}
                              : TemplateSheet::Box{x + along, y + across, size_along, size_across});
  };
  add(0.0, 0.5 * (kTick_mm - kStroke_mm), length_mm, kStroke_mm);
  add(0.0, 0.0, kStroke_mm, kTick_mm);
  add(length_mm - kStroke_mm, 0.0, kStroke_mm, kTick_mm);
}

/// Of whole centimetres, as long as there is room for.
double scale_for(double room_mm) { return 10.0 * std::floor(0.1 * room_mm); }

std::vector<std::string> words_of(const drivers::TargetSettings& target,
                                  const std::array<double, 2>& scale_mm) {
  std::vector<std::string> lines(static_cast<std::size_t>(kLines));
  drivers::print(lines[0], "Tubesight dot template: rows = %d, columns = %d, lattice = %s",
                 target.rows, target.columns,
                 target.lattice == drivers::DotLattice::kSquare ? "square" : "staggered");
  drivers::print(lines[1], "spacing_mm = %s, row_spacing_mm = %s, dot_mm = %s, dots = %s",
                 drivers::number_text(target.spacing_mm).c_str(),
                 drivers::number_text(target.row_spacing_mm).c_str(),
                 drivers::number_text(target.dot_mm).c_str(), target.bright ? "bright" : "dark");
  drivers::print(
      lines[2],
      "Print at 100 %%. Outside of the ticks: %.0f mm across, %.0f mm down; measure both.",
      scale_mm[0], scale_mm[1]);
  return lines;
}

/// A number of the sheet: fixed, as its readers know no exponents.
void number(std::string& out, double value) { drivers::print(out, "%.4f", value); }

std::string escaped(std::string_view words, std::string_view escape) {
  std::string out;
  for (const char c : words) {
    if (escape.find(c) != std::string_view::npos) {
      out += '\\';
    }
    out += c;
  }
  return out;
}

/// The page's marks, in millimetres from its lower left corner, y up, as a PDF has them.
std::string page_of(const TemplateSheet& sheet) {
  constexpr int kCurves = 8;
  constexpr double kTurn = 2.0 * std::numbers::pi / kCurves;
  const double handle = 4.0 / 3.0 * std::tan(0.25 * kTurn);
  std::string out = "2.8346456693 0 0 2.8346456693 0 0 cm\n";  // 72 / 25.4
  const auto y_up = [&](double y) { return sheet.paper_mm[1] - y; };
  const auto point = [&](double x, double y, const char* what) {
    drivers::print(out, "%.6f %.6f%s", x, y, what);
  };
  const auto box = [&](const TemplateSheet::Box& b) {
    point(b.x, y_up(b.y + b.height), " ");
    point(b.width, b.height, " re f\n");
  };
  out += "0 g\n";
  if (sheet.bright) {
    box(sheet.field);
    out += "1 g\n";
  }
  for (const auto& [dot_x, dot_y] : sheet.dots) {
    const auto on = [&, x = dot_x, y = dot_y](double angle, double side, const char* what) {
      const double c = std::cos(angle);
      const double s = std::sin(angle);
      point(x + sheet.radius_mm * (c - side * s), y_up(y) + sheet.radius_mm * (s + side * c), what);
    };
    on(0.0, 0.0, " m\n");
    for (int i = 0; i < kCurves; ++i) {
      on(i * kTurn, handle, " ");
      on((i + 1) * kTurn, -handle, " ");
      on((i + 1) * kTurn, 0.0, " c\n");
    }
    out += "f\n";
  }
  out += "0 g\n";
  for (const TemplateSheet::Box& b : sheet.bars) {
    box(b);
  }
  for (const TemplateSheet::Line& line : sheet.text) {
    drivers::print(out, "BT /F1 %.4f Tf %.4f %.4f Td (%s) Tj ET\n", sheet.letters_mm, line.x,
                   y_up(line.y), escaped(line.words, "()\\").c_str());
  }
  return out;
}

}  // namespace

std::string lay_out(const drivers::TargetSettings& target, std::array<double, 2> paper_mm,
                    TemplateSheet& sheet) {
  sheet = {};
  const bool staggered = target.lattice == drivers::DotLattice::kStaggered;
  const std::array<double, 2> across = {
      target.spacing_mm * (target.columns - 1 + (staggered ? 0.5 : 0.0)),
      target.row_spacing_mm * (target.rows - 1)};
  // What is dark around bright dots reaches half a dot beyond them.
  const double beyond = (target.bright ? 1.0 : 0.5) * target.dot_mm;
  const std::array<double, 2> field = {across[0] + 2.0 * beyond, across[1] + 2.0 * beyond};
  const double left = kBeside_mm + kTick_mm;
  const double below = kBeside_mm + kTick_mm + kLines * kLineFeed_mm + 0.5 * kLineFeed_mm;
  const std::array<double, 2> least = {field[0] + 2.0 * (left + kMargin_mm),
                                       field[1] + below + 2.0 * kMargin_mm};
  if (least[0] > paper_mm[0] || least[1] > paper_mm[1]) {
    std::swap(paper_mm[0], paper_mm[1]);
  }
  if (least[0] > paper_mm[0] || least[1] > paper_mm[1]) {
    std::string why;
    drivers::print(why, "needs a paper of %.0f x %.0f mm, expected one of that size, or fewer dots",
                   std::ceil(least[0]), std::ceil(least[1]));
    return why;
  }
  sheet.paper_mm = paper_mm;
  sheet.bright = target.bright;
  sheet.radius_mm = 0.5 * target.dot_mm;
  sheet.letters_mm = kLetters_mm;
  const double x0 = 0.5 * (paper_mm[0] - field[0]);
  const double y0 = 0.5 * (paper_mm[1] - field[1] - below);
  sheet.field = {x0, y0, field[0], field[1]};
  for (int line = 0; line < target.rows; ++line) {
    const double shift = staggered && line % 2 == 1 ? 0.5 * target.spacing_mm : 0.0;
    for (int column = 0; column < target.columns; ++column) {
      sheet.dots.push_back({x0 + beyond + shift + column * target.spacing_mm,
                            y0 + beyond + line * target.row_spacing_mm});
    }
  }
  const double foot = y0 + field[1] + kBeside_mm;
  sheet.scale_mm = {scale_for(paper_mm[0] - 2.0 * kMargin_mm), scale_for(foot - kMargin_mm)};
  add_scale(sheet, 0.5 * (paper_mm[0] - sheet.scale_mm[0]), foot, sheet.scale_mm[0], false);
  add_scale(sheet, x0 - kBeside_mm - kTick_mm, foot - sheet.scale_mm[1], sheet.scale_mm[1], true);
  double y = foot + kTick_mm + kLineFeed_mm;
  for (const std::string& words : words_of(target, sheet.scale_mm)) {
    sheet.text.push_back({kMargin_mm, y, words});
    y += kLineFeed_mm;
  }
  return {};
}

std::string svg_text(const TemplateSheet& sheet) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  const auto attribute = [&out](const char* name, double value) {
    out += std::string(" ") + name + "=\"";
    number(out, value);
    out += '"';
  };
  drivers::print(out,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.4fmm\" height=\"%.4fmm\" "
                 "viewBox=\"0 0 %.4f %.4f\">\n",
                 sheet.paper_mm[0], sheet.paper_mm[1], sheet.paper_mm[0], sheet.paper_mm[1]);
  const auto box = [&](const TemplateSheet::Box& b, const char* color) {
    out += "<rect";
    attribute("x", b.x);
    attribute("y", b.y);
    attribute("width", b.width);
    attribute("height", b.height);
    out += std::string(" fill=\"") + color + "\"/>\n";
  };
  box({0.0, 0.0, sheet.paper_mm[0], sheet.paper_mm[1]}, "white");
  if (sheet.bright) {
    box(sheet.field, "black");
  }
  out += std::string("<g fill=\"") + (sheet.bright ? "white" : "black") + "\">\n";
  for (const auto& [x, y] : sheet.dots) {
    out += "<circle";
    attribute("cx", x);
    attribute("cy", y);
    attribute("r", sheet.radius_mm);
    out += "/>\n";
  }
  out += "</g>\n";
  for (const TemplateSheet::Box& b : sheet.bars) {
    box(b, "black");
  }
  for (const TemplateSheet::Line& line : sheet.text) {
    drivers::print(out,
                   "<text x=\"%.4f\" y=\"%.4f\" font-family=\"Helvetica, Arial, sans-serif\" "
                   "font-size=\"%.4f\">%s</text>\n",
                   line.x, line.y, sheet.letters_mm, line.words.c_str());
  }
  return out + "</svg>\n";
}

std::string pdf_text(const TemplateSheet& sheet) {
  constexpr double kPoint_mm = 25.4 / 72.0;
  const std::string page = page_of(sheet);
  std::vector<std::string> objects(5);
  objects[0] = "<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>";
  objects[1] = "<< /Type /Pages /Kids [3 0 R] /Count 1 >>";
  drivers::print(objects[2],
                 "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 %.4f %.4f] /Contents 4 0 R "
                 "/Resources << /Font << /F1 5 0 R >> >> >>",
                 sheet.paper_mm[0] / kPoint_mm, sheet.paper_mm[1] / kPoint_mm);
  objects[3] = "<< /Length " + std::to_string(page.size()) + " >>\nstream\n" + page + "endstream";
  objects[4] = "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>";
  std::string out = "%PDF-1.6\n";
  std::string table = "xref\n0 6\n0000000000 65535 f \n";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    drivers::print(table, "%010zu 00000 n \n", out.size());
    out += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::size_t at = out.size();
  return out + table + "trailer\n<< /Size 6 /Root 1 0 R >>\nstartxref\n" + std::to_string(at) +
         "\n%%EOF\n";
}

}  // namespace tubesight::board
