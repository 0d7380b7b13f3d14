// `tubesight calibrate zones`: local corrections, added at any time, refused where they contradict.

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

using support::TemporaryFolder;

constexpr const char* kHeader =
    "name,robot_x_mm,robot_y_mm,robot_z_mm,robot_alpha_deg,robot_beta_deg,robot_gamma_deg,"
    "tool_x_mm,tool_y_mm,tool_z_mm,tool_alpha_deg,tool_beta_deg,tool_gamma_deg,sigma_x_mm,"
    "sigma_y_mm,sigma_z_mm,use\n";
constexpr const char* kBase =
    "[base]\nposition_mm = [0.0, 0.0, -1000.0]\nrotation_deg = [0.0, 0.0, 0.0]\n";
constexpr const char* kZonesHeader = "sheet_x_mm,sheet_y_mm,dx_mm,dy_mm,dz_mm,sigma_mm\n";

/// A place of a robot whose error along x is 0.8 sin(x / 400 mm), and `more`.
std::string pair_row(const std::string& name, double x, double y, double more = 0.0) {
  std::array<char, 300> row{};
  std::snprintf(row.data(), row.size(), "%s,%.4f,%.4f,970.0000,,,,%.4f,%.4f,-30.0000,,,,,,,1\n",
                name.c_str(), x - 0.8 * std::sin(x / 400.0) - more, y, x, y);
  return row.data();
}

std::string nine_pairs() {
  std::string text = kHeader;
  for (int i = 0; i < 9; ++i) {
    text += pair_row("n" + std::to_string(i), -600.0 + 600.0 * (i % 3), -500.0 + 500.0 * (i / 3));
  }
  return text;
}

ProgramRun run_zones(const TemporaryFolder& folder, const std::string& pairs) {
  return run_tubesight(folder, {"calibrate", "zones", pairs, "--base", "base.toml", "--out",
                                "zones.csv", "--picture", "zones.png"});
}

TEST(CalibrateZones, AreWrittenAndAddedTo) {
  const TemporaryFolder folder;
  folder.write("base.toml", kBase);
  folder.write("a.csv", nine_pairs());
  folder.write("b.csv", kHeader + pair_row("later", 300.0, 250.0));

  const ProgramRun first = run_zones(folder, "a.csv");

  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_TRUE(first.out.starts_with("corrections at 9 places, 9 of them new\n")) << first.out;
  const std::string before = folder.read("zones.csv");
  EXPECT_TRUE(before.starts_with(std::string(kZonesHeader) +
                                 "-600.0000,-500.0000,-0.7980,0.0000,0.0000,0.1000\n"))
      << before;
  EXPECT_TRUE(folder.read("zones.png").starts_with("\x89PNG"));
  const ProgramRun second = run_zones(folder, "b.csv");
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_TRUE(second.out.starts_with("corrections at 10 places, 1 of them new\n")) << second.out;
  EXPECT_EQ(folder.read("zones.csv"), before + "300.0000,250.0000,0.5453,0.0000,0.0000,0.1000\n");
  EXPECT_EQ(folder.read("zones.csv.bak"), before);
}

TEST(CalibrateZones, RefusesWhatContradicts) {
  const TemporaryFolder folder;
  folder.write("base.toml", kBase);
  folder.write("a.csv", nine_pairs());
  ASSERT_EQ(run_zones(folder, "a.csv").status, 0);
  const std::string before = folder.read("zones.csv");
  const auto refused = [&](const std::string& row, const std::string& why) {
    folder.write("b.csv", kHeader + row);
    const ProgramRun run = run_zones(folder, "b.csv");
    EXPECT_EQ(run.status, 1) << why;
    EXPECT_TRUE(run.err.starts_with("b.csv: no zones: " + why)) << run.err;
    EXPECT_EQ(run.err.find('\n'), run.err.size() - 1);
    EXPECT_EQ(folder.read("zones.csv"), before);
  };
  refused(pair_row("of another tube", 300.0, 250.0, 25.4), "pair of another tube is 2");
  refused(pair_row("same place", 0.0, 0.0, 3.0), "pair same place has dx 3.00");
}

TEST(CalibrateZones, RefusesBadInput) {
  const TemporaryFolder folder;
  folder.write("base.toml", kBase);
  folder.write("a.csv", nine_pairs());
  EXPECT_EQ(run_tubesight(folder, {"calibrate", "zones", "a.csv"}).status, 2) << "no --base";
  folder.write("zones.csv", std::string(kZonesHeader) + "0,0,0.1,0,0,0\n");
  const ProgramRun zero = run_zones(folder, "a.csv");
  EXPECT_EQ(zero.status, 2);
  EXPECT_TRUE(zero.err.starts_with("zones.csv:2: sigma_mm: '0', expected ")) << zero.err;
  folder.write("base.toml", "[tool]\nposition_mm = [0.0, 0.0, 0.0]\n");
  EXPECT_NE(run_zones(folder, "a.csv").err.find("base: the table is missing"), std::string::npos);
}

}  // namespace
}  // namespace tubesight::tests
