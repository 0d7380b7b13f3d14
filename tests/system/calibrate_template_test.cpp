// `tubesight calibrate template`: what is printed is read back by its numbers, and found by `look`.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using support::TemporaryFolder;

using Place = std::array<double, 2>;
struct Circle {
  Place at{};
  double radius = 0.0;
};

ProgramRun draw(const TemporaryFolder& folder, const std::string& name,
                const std::vector<std::string>& further = {}) {
  std::vector<std::string> all = {"calibrate", "template", name};
  all.insert(all.end(), further.begin(), further.end());
  return run_tubesight(folder, all);
}

std::vector<Circle> circles_of_svg(const std::string& text) {
  std::vector<Circle> circles;
  const std::regex circle(R"re(<circle cx="([\d.]+)" cy="([\d.]+)" r="([\d.]+)"/>)re");
  for (auto at = std::sregex_iterator(text.begin(), text.end(), circle);
       at != std::sregex_iterator(); ++at) {
    circles.push_back({{std::stod((*at)[1]), std::stod((*at)[2])}, std::stod((*at)[3])});
  }
  return circles;
}

/// Each path of curves: the middle of the points that it passes through, and how far they all are
/// from that; y down from the upper edge, as in an SVG.
std::vector<Circle> circles_of_pdf(const std::string& text, double height_mm) {
  std::vector<Circle> circles;
  const std::regex path(R"(([-\d.]+) ([-\d.]+) m\n((?:[-\d. ]+ c\n)+)f\n)");
  const std::regex curve(R"(([-\d.]+) ([-\d.]+) c\n)");
  for (auto at = std::sregex_iterator(text.begin(), text.end(), path); at != std::sregex_iterator();
       ++at) {
    std::vector<Place> on;
    const std::string curves = (*at)[3];
    for (auto c = std::sregex_iterator(curves.begin(), curves.end(), curve);
         c != std::sregex_iterator(); ++c) {
      on.push_back({std::stod((*c)[1]), height_mm - std::stod((*c)[2])});
    }
    Circle circle;
    for (const Place& p : on) {
      circle.at[0] += p[0] / static_cast<double>(on.size());
      circle.at[1] += p[1] / static_cast<double>(on.size());
    }
    circle.radius = std::hypot(on[0][0] - circle.at[0], on[0][1] - circle.at[1]);
    for (const Place& p : on) {
      EXPECT_NEAR(std::hypot(p[0] - circle.at[0], p[1] - circle.at[1]), circle.radius, 1e-5);
    }
    circles.push_back(circle);
  }
  return circles;
}

/// What a scanner would make of the circles, with 6 pixels a millimetre.
std::string picture_of(const std::vector<Circle>& circles, const Place& paper_mm, bool bright) {
  constexpr double kPerMm = 6.0;
  const int width = static_cast<int>(paper_mm[0] * kPerMm);
  const int height = static_cast<int>(paper_mm[1] * kPerMm);
  std::string pixels(static_cast<std::size_t>(width * height), bright ? '\x20' : '\xE0');
  for (const Circle& circle : circles) {
    const double u0 = circle.at[0] * kPerMm - 0.5;
    const double v0 = circle.at[1] * kPerMm - 0.5;
    const double r = circle.radius * kPerMm;
    for (int v = static_cast<int>(v0 - r) - 1; v <= static_cast<int>(v0 + r) + 2; ++v) {
      for (int u = static_cast<int>(u0 - r) - 1; u <= static_cast<int>(u0 + r) + 2; ++u) {
        const double share = std::clamp(r - std::hypot(u - u0, v - v0) + 0.5, 0.0, 1.0);
        const double grey = bright ? 32.0 + 192.0 * share : 224.0 - 192.0 * share;
        pixels[static_cast<std::size_t>(v * width + u)] = static_cast<char>(std::lround(grey));
      }
    }
  }
  return "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n" + pixels;
}

TEST(CalibrateTemplate, SvgAndPdfHaveTheDotsAsTheyWereAskedFor) {
  const TemporaryFolder folder;
  const std::vector<std::string> size = {"--rows",       "7",    "--columns",        "5",
                                         "--spacing-mm", "12.5", "--row-spacing-mm", "10.25",
                                         "--dot-mm",     "5.5",  "--lattice",        "staggered"};
  const ProgramRun svg = draw(folder, "t.svg", size);
  const ProgramRun pdf = draw(folder, "t.pdf", size);
  ASSERT_EQ(svg.status, 0) << svg.err;
  ASSERT_EQ(pdf.status, 0) << pdf.err;
  EXPECT_EQ(svg.out, pdf.out);
  EXPECT_NE(svg.out.find("[target]\nrows = 7\ncolumns = 5\nlattice = \"staggered\"\n"
                         "spacing_mm = 12.5 "),
            std::string::npos)
      << svg.out;
  const std::string drawn = folder.read("t.svg");
  EXPECT_NE(
      drawn.find("width=\"210.0000mm\" height=\"297.0000mm\" viewBox=\"0 0 210.0000 297.0000\""),
      std::string::npos);
  EXPECT_NE(folder.read("t.pdf").find("/MediaBox [0 0 595.2756 841.8898]"), std::string::npos);

  const std::vector<Circle> in_svg = circles_of_svg(drawn);
  const std::vector<Circle> in_pdf = circles_of_pdf(folder.read("t.pdf"), 297.0);

  ASSERT_EQ(in_svg.size(), 35U);
  ASSERT_EQ(in_pdf.size(), 35U);
  for (std::size_t i = 0; i < in_svg.size(); ++i) {
    const auto row = static_cast<double>(i / 5);
    const auto column = static_cast<double>(i % 5);
    const double shift = i / 5 % 2 == 1 ? 6.25 : 0.0;
    EXPECT_NEAR(in_svg[i].at[0] - in_svg[0].at[0], 12.5 * column + shift, 1.1e-4);
    EXPECT_NEAR(in_svg[i].at[1] - in_svg[0].at[1], 10.25 * row, 1.1e-4);
    EXPECT_NEAR(in_svg[i].radius, 2.75, 1e-9);
    EXPECT_NEAR(in_pdf[i].at[0], in_svg[i].at[0], 1e-4);
    EXPECT_NEAR(in_pdf[i].at[1], in_svg[i].at[1], 1e-4);
    EXPECT_NEAR(in_pdf[i].radius, 2.75, 1e-5);
  }
}

TEST(CalibrateTemplate, LookFindsEachDotOfIt) {
  for (const bool bright : {false, true}) {
    const TemporaryFolder folder;
    ASSERT_EQ(draw(folder, "t.svg", {"--dots", bright ? "bright" : "dark"}).status, 0);
    const std::vector<Circle> circles = circles_of_svg(folder.read("t.svg"));
    folder.write("t.pgm", picture_of(circles, {210.0, 297.0}, bright));

    const ProgramRun look = run_tubesight(folder, {"look", "t.pgm", "--csv", "l.csv"});

    ASSERT_EQ(look.status, 0) << look.err;
    const std::string rows = folder.read("l.csv");
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 101) << look.out;
    // Spacing by diameter, as the options that are left out have it: 8 mm and 4 mm; drawn edges are
    // found 0.1 px too far out of 12.
    const std::size_t steps = look.out.find("steps ");
    ASSERT_NE(steps, std::string::npos) << look.out;
    EXPECT_NEAR(std::stod(look.out.substr(steps + 6)), 2.0, 0.02) << look.out;
  }
}

TEST(CalibrateTemplate, TheScalesSayHowLongTheyAre) {
  const TemporaryFolder folder;
  const ProgramRun run = draw(folder, "t.svg", {"--paper", "letter"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string text = folder.read("t.svg");
  double across = 0.0;
  double down = 0.0;
  const std::regex box(R"re(width="([\d.]+)" height="([\d.]+)" fill="black"/>)re");
  for (auto at = std::sregex_iterator(text.begin(), text.end(), box); at != std::sregex_iterator();
       ++at) {
    across = std::max(across, std::stod((*at)[1]));
    down = std::max(down, std::stod((*at)[2]));
  }
  EXPECT_EQ(across, 190.0);
  EXPECT_GE(down, 80.0);
  std::array<char, 80> said{};
  std::snprintf(said.data(), said.size(), "%.0f mm across, %.0f mm down", across, down);
  EXPECT_NE(text.find(said.data()), std::string::npos) << text;
}

TEST(CalibrateTemplate, WhatCannotBePrintedIsRefused) {
  struct Case {
    std::vector<std::string> arguments;
    std::string why;
  };
  for (const auto& [arguments, why] :
       {Case{{"t.png"}, "t.png: expected a name that ends in .svg or .pdf"},
        Case{{"t.pdf", "--columns", "40"}, "--paper: A4: the template needs a paper of"},
        Case{{"t.pdf", "--dot-mm", "7"}, "--dot-mm: 7, expected at most 6.4"},
        Case{{"t.pdf", "--dot-mm", "nan"}, "--dot-mm: Value nan not in range 0.05"},
        Case{{"t.pdf", "--paper", "A9"}, "--paper: 'A9', expected A4"},
        Case{{"t.pdf", "--paper", "100,-1"}, "--paper: '100,-1', expected A4"},
        Case{{"t.pdf", "--out", "x.toml"}, "calibrate template: writes the file"},
        Case{{"gone/t.pdf"}, "gone/t.pdf: cannot be written"}}) {
    const TemporaryFolder folder;
    const ProgramRun run = draw(folder, arguments[0], {arguments.begin() + 1, arguments.end()});
    EXPECT_EQ(run.status, 2) << why;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  const TemporaryFolder folder;
  const ProgramRun other = run_tubesight(folder, {"calibrate", "camera", "t.toml", "--rows", "3"});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("of a template alone"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace tubesight::tests
