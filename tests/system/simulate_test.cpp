// `simulate`, then `replay` and `pose` on what it wrote, against the truth it wrote.

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/csv_rows.h"
#include "tests/system/program.h"
#include "tests/system/scenario_text.h"

namespace tubesight::tests {
namespace {

using support::replaced;
using support::TemporaryFolder;

const std::string kLibrary = std::string(TUBESIGHT_TEST_DATA_DIR) + "/scenarios/";

/// A scenario simulated and replayed.
struct SimulatedRun {
  TemporaryFolder folder;
  std::vector<Row> fields;
  std::vector<Row> truth;

  explicit SimulatedRun(const std::string& scenario, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"simulate", scenario, "--out", "r"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun simulated = run_tubesight(folder, arguments);
    EXPECT_EQ(simulated.status, 0) << simulated.err;
    EXPECT_EQ(simulated.err, "");
    const ProgramRun replayed =
        run_tubesight(folder, {"replay", "r.session.toml", "r.y4m", "--fields", "f.csv"});
    EXPECT_EQ(replayed.status, 0) << replayed.err;
    EXPECT_EQ(replayed.err, "");
    fields = read_rows(folder.read("f.csv"));
    truth = read_rows(folder.read("r.truth.csv"));
  }
};

/// As the recordings are scored: rows of field and truth in the same order.
void expect_right(const SimulatedRun& run) {
  ASSERT_EQ(run.fields.size(), run.truth.size());
  int vouched = 0;
  for (std::size_t i = 0; i < run.fields.size(); ++i) {
    const Row& field = run.fields[i];
    const Row& truth = run.truth[i];
    EXPECT_EQ(number(field, "field"), 2 * number(truth, "frame") + number(truth, "field")) << i;
    EXPECT_NEAR(number(field, "time_s"), number(truth, "t"), 1e-6) << i;
    if (field.at("tool_row").empty()) {
      continue;
    }
    if (field.at("aligned") == "1") {
      ++vouched;
      EXPECT_EQ(field.at("tool_row"), truth.at("near_row")) << i;
      EXPECT_EQ(field.at("tool_column"), truth.at("near_col")) << i;
      EXPECT_NEAR(number(field, "tool_offset_mm"), number(truth, "offset_mm"), 0.15) << i;
    }
    EXPECT_NEAR(number(field, "tool_height_mm"), -number(truth, "tool_z"), 0.3) << i;
  }
  EXPECT_GT(vouched, 30);
}

TEST(Simulate, GivesARecordingOnWhichReplayIsRight) {
  const SimulatedRun run(kLibrary + "rest-triangular.toml");

  EXPECT_EQ(run.fields.size(), 60U);
  for (const Row& field : run.fields) {
    EXPECT_EQ(field.at("state"), "tracking");
  }
  expect_right(run);
}

TEST(Simulate, ShiftedRowsAreFollowedFromRowToRow) {
  const SimulatedRun run(kLibrary + "moves-zigzag.toml", {"--window-only"});

  EXPECT_NE(run.folder.read("r.session.toml").find("\nodd_row_shift = 0.25\n"), std::string::npos);
  std::set<std::string> rows;
  for (const Row& field : run.fields) {
    EXPECT_EQ(field.at("state"), "tracking");
    rows.insert(field.at("tool_row"));
  }
  rows.erase("");  // midway between tubes none is named
  expect_right(run);
  EXPECT_EQ(rows, (std::set<std::string>{"40", "41", "42", "43", "44", "45", "46"}));
}

/// The address that the oblique steps give a tube of the sheet with half a step of shift.
std::int64_t oblique_column(std::int64_t row, std::int64_t column) { return column - row / 2; }

/// A session of the latter, in the words of the former.
std::string in_oblique_words(const std::string& session) {
  std::string text = replaced(session, "row_step_mm = [0.0, 22.0]", "row_step_mm = [12.7, 22.0]");
  text = replaced(text, "odd_row_shift = 0.5\n", "");
  text = replaced(text, "columns = [0, 120]", "columns = [-60, 120]");
  const std::regex click("row = (\\d+), column = (\\d+)");
  std::string all;
  for (std::smatch found; std::regex_search(text, found, click); text = found.suffix()) {
    const std::int64_t row = std::stoll(found[1]);
    all += found.prefix().str() + "row = " + found[1].str() +
           ", column = " + std::to_string(oblique_column(row, std::stoll(found[2])));
  }
  return all + text;
}

TEST(Simulate, HalfAStepOfShiftIsTheObliqueLatticeToReplayAndPose) {
  std::string scenario = replaced(small_scenario_text(), "row_step_mm = [0.0, 25.4]",
                                  "odd_row_shift = 0.5\nrow_step_mm = [0.0, 22.0]");
  scenario = scenario.substr(0, scenario.find("[[fault]]")) +
             "[[step]]\nto = [43, 61]\n[[step]]\nrest_s = 0.1\n";
  const TemporaryFolder folder;
  folder.write("s.toml", scenario);
  ASSERT_EQ(run_tubesight(folder, {"simulate", "s.toml", "--out", "r"}).status, 0);
  folder.write("oblique.toml", in_oblique_words(folder.read("r.session.toml")));
  for (const std::string session : {"r.session.toml", "oblique.toml"}) {
    ASSERT_EQ(
        run_tubesight(folder, {"replay", session, "r.y4m", "--fields", session + ".f.csv"}).status,
        0);
    ASSERT_EQ(run_tubesight(folder, {"pose", session, "r.y4m", "--csv", session + ".p.csv"}).status,
              0);
  }

  const std::vector<Row> shifted = read_rows(folder.read("r.session.toml.f.csv"));
  const std::vector<Row> oblique = read_rows(folder.read("oblique.toml.f.csv"));
  ASSERT_EQ(shifted.size(), oblique.size());
  ASSERT_GT(shifted.size(), 20U);
  int named = 0;
  for (std::size_t i = 0; i < shifted.size(); ++i) {
    EXPECT_EQ(shifted[i].at("state"), "tracking") << i;
    EXPECT_EQ(shifted[i].at("tracked"), oblique[i].at("tracked")) << i;
    EXPECT_EQ(shifted[i].at("tool_row"), oblique[i].at("tool_row")) << i;
    if (shifted[i].at("tool_row").empty()) {
      continue;  // midway between tubes
    }
    ++named;
    EXPECT_EQ(oblique_column(std::stoll(shifted[i].at("tool_row")),
                             std::stoll(shifted[i].at("tool_column"))),
              std::stoll(oblique[i].at("tool_column")))
        << i;
    EXPECT_NEAR(number(shifted[i], "tool_offset_mm"), number(oblique[i], "tool_offset_mm"), 1e-3);
  }
  EXPECT_GT(named, 20);
  EXPECT_EQ(shifted.back().at("tool_row"), "43");
  const Row a = read_rows(folder.read("r.session.toml.p.csv")).at(0);
  const Row b = read_rows(folder.read("oblique.toml.p.csv")).at(0);
  EXPECT_EQ(a.at("tubes"), b.at("tubes"));
  for (const char* name : {"tool_x_mm", "tool_y_mm", "tool_z_mm", "offset_mm"}) {
    EXPECT_NEAR(number(a, name), number(b, name), 2e-4) << name;
  }
}

TEST(Simulate, PoseKnowsShiftedRows) {
  const TemporaryFolder folder;
  folder.write("s.toml", replaced(replaced(small_scenario_text(), "bore_mm = 18.6",
                                           "odd_row_shift = -0.25\nbore_mm = 18.6"),
                                  "tube = [40, 60]", "tube = [41, 60]"));
  ASSERT_EQ(run_tubesight(folder, {"simulate", "s.toml", "--out", "r"}).status, 0);

  const ProgramRun run =
      run_tubesight(folder, {"pose", "r.session.toml", "r.y4m", "--csv", "p.csv"});

  ASSERT_EQ(run.status, 0) << run.err;
  const Row pose = read_rows(folder.read("p.csv")).at(0);
  // Column 60 of a row of odd number: 60 steps of 25.4 mm less a quarter.
  EXPECT_NEAR(number(pose, "tool_x_mm"), 1517.65, 0.05);
  EXPECT_NEAR(number(pose, "tool_y_mm"), 1041.4, 0.05);
  EXPECT_NEAR(number(pose, "tool_z_mm"), -60.0, 0.05);
  EXPECT_EQ(pose.at("row") + "," + pose.at("column"), "41,60");
  EXPECT_GT(number(pose, "tubes"), 20);
}

TEST(Simulate, FieldsLostOutOfAFrameKeepTheirPlaceAsDamagedOnes) {
  const SimulatedRun run(kLibrary + "fault-dropped.toml", {"--window-only"});

  const std::vector<Row> meta = read_rows(run.folder.read("r.meta.csv"));
  ASSERT_EQ(meta.size(), run.fields.size());
  // 0.25 s is field 15, the later one of its frame.
  EXPECT_EQ(meta[15].at("status"), "damaged");
  EXPECT_EQ(meta[15].at("sequence"), "15");
  EXPECT_EQ(run.truth[15].at("faults"), "dropped");
  EXPECT_EQ(run.fields[15].at("reason"), "damaged-field");
  EXPECT_EQ(meta[14].at("status"), "good");
  // Fields 72 to 74 are lost from 1.2 s on: a whole frame is left out.
  EXPECT_EQ(meta[72].at("sequence"), "74");
  EXPECT_EQ(meta[72].at("status"), "damaged");
  EXPECT_EQ(meta[73].at("sequence"), "75");
  expect_right(run);
}

TEST(Simulate, WritesTheClaimsAtTheirFields) {
  const SimulatedRun run(kLibrary + "rest-square.toml", {"--window-only"});

  EXPECT_EQ(run.folder.read("r.events.csv"),
            "field,time_s,kind,values,id,seen_field,confirm\n30,0.500000000,claim,\"40,60\",1,,\n");
  const ProgramRun replayed = run_tubesight(run.folder, {"replay", "r.session.toml", "r.y4m"});
  EXPECT_NE(replayed.out.find("claims: 1, 1 confirmed"), std::string::npos) << replayed.out;
}

TEST(Simulate, GivesPicturesFromWhichPoseTellsTheTool) {
  const TemporaryFolder folder;
  folder.write("s.toml", small_scenario_text());
  ASSERT_EQ(run_tubesight(folder, {"simulate", "s.toml", "--out", "r"}).status, 0);

  const ProgramRun run =
      run_tubesight(folder, {"pose", "r.session.toml", "r.y4m", "--csv", "p.csv"});

  ASSERT_EQ(run.status, 0) << run.err;
  const Row pose = read_rows(folder.read("p.csv")).at(0);
  // Under tube (40, 60) of 25.4 mm pitch, 60 mm below.
  EXPECT_NEAR(number(pose, "tool_x_mm"), 1524.0, 0.05);
  EXPECT_NEAR(number(pose, "tool_y_mm"), 1016.0, 0.05);
  EXPECT_NEAR(number(pose, "tool_z_mm"), -60.0, 0.05);
  EXPECT_NEAR(number(pose, "tool_beta_deg"), 0.0, 0.03);
  EXPECT_NEAR(number(pose, "tool_gamma_deg"), 0.0, 0.03);
}

TEST(Simulate, ListsHiddenTubesAndVoidsOfEveryTenthFrameAndTheLast) {
  const TemporaryFolder folder;
  std::string text = replaced(small_scenario_text(), "rest_s = 0.1", "rest_s = 0.42");
  // The frame at 0.4 s, the last, is lost: the one before it, at 0.3667 s, is number 11.
  text += "[[fault]]\nkind = \"cut\"\nat_s = 0.4\n[sheet]\nvoids = [[41, 61]]\n";
  folder.write("s.toml", text);

  const ProgramRun run =
      run_tubesight(folder, {"simulate", "s.toml", "--out", "r", "--window-only"});

  ASSERT_EQ(run.status, 0) << run.err;
  std::vector<std::string> voids;
  int hidden = 0;
  for (const Row& row : read_rows(folder.read("r.centers.csv"))) {
    hidden += row.at("occluded") == "1.00" ? 1 : 0;
    if (row.at("state") == "void") {
      EXPECT_EQ(row.at("row") + "," + row.at("col"), "41,61");
      voids.push_back(row.at("frame") + "." + row.at("field"));
    }
  }
  EXPECT_EQ(voids, (std::vector<std::string>{"0.0", "0.1", "10.0", "10.1", "11.0", "11.1"}));
  EXPECT_GT(hidden, 0) << "the guidetube stands before some";
}

TEST(Simulate, SaysInTheSessionFileWhatTheRecordingIsOf) {
  const TemporaryFolder folder;
  folder.write("s.toml", small_scenario_text() + "[scenario]\ntitle = \"A rest,\\nand black\"\n");
  std::filesystem::create_directory(folder.path("to"));

  const ProgramRun run = run_tubesight(
      folder, {"simulate", folder.path("s.toml"), "--out", "to/r", "--seed", "7", "--window-only"});

  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(folder.read("to/r.session.toml")
                  .starts_with("# A rest, and black\n# s.toml, seed 7\n\n[camera]\n"))
      << folder.read("to/r.session.toml");
}

TEST(Simulate, TheSeedDecidesTheBytes) {
  const TemporaryFolder folder;
  folder.write("s.toml", small_scenario_text());
  const auto simulated = [&](const std::string& name, const std::string& seed) {
    EXPECT_EQ(run_tubesight(folder, {"simulate", "s.toml", "--out", name, "--seed", seed}).status,
              0);
    const std::string session = folder.read(name + ".session.toml");
    return folder.read(name + ".y4m") + session.substr(session.find("[camera]"));
  };

  const std::string first = simulated("a", "3");

  EXPECT_EQ(simulated("b", "3"), first);
  EXPECT_NE(simulated("c", "4"), first);
}

TEST(Simulate, AndReplaySayBeforehandThatFieldsComeTooSeldom) {
  const TemporaryFolder folder;
  const std::string scenario = small_scenario_text();
  folder.write("s.toml", scenario.substr(0, scenario.find("rest_s")) +
                             "rest_s = 1.0\n[video]\nrate_hz = 8\n");

  const ProgramRun drawn = run_tubesight(folder, {"simulate", "s.toml", "--out", "r"});
  const ProgramRun replayed =
      run_tubesight(folder, {"replay", "r.session.toml", "r.y4m", "--fields", "f.csv"});

  EXPECT_EQ(drawn.status, 0);
  EXPECT_EQ(drawn.err.find("s.toml: the recording can be drawn and not be tracked: 16 fields"), 0U)
      << drawn.err;
  EXPECT_EQ(replayed.status, 2);
  EXPECT_EQ(replayed.err.find("r.session.toml: motion: r.y4m: 16 fields a second are too few: "),
            0U)
      << replayed.err;
  EXPECT_NE(replayed.err.find("max_acceleration_mm_s2 = 2200 or"), std::string::npos)
      << replayed.err;
  const std::string session = folder.read("r.session.toml");
  const std::string key = "max_acceleration_mm_s2 = 3000.0";
  ASSERT_NE(session.find(key), std::string::npos);
  folder.write("slow.toml", std::string(session).replace(session.find(key), key.size(),
                                                         "max_acceleration_mm_s2 = 2200"));
  const ProgramRun slow = run_tubesight(folder, {"replay", "slow.toml", "r.y4m"});
  EXPECT_EQ(slow.status, 0) << slow.err;
  EXPECT_NE(slow.out.find("lost            0.000 s"), std::string::npos) << slow.out;
}

TEST(Simulate, TellsWhatItWrote) {
  const TemporaryFolder folder;
  folder.write("s.toml", small_scenario_text());

  const ProgramRun run = run_tubesight(folder, {"simulate", "s.toml", "--out", "r"});

  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, "r.y4m: 635 x 480, 3 frames, 6 of 6 fields delivered, 0.100 s\n");
  EXPECT_EQ(folder.names().size(), 7U);
  EXPECT_TRUE(folder.read("r.y4m").starts_with("YUV4MPEG2 W635 H480 F30:1 It Cmono\nFRAME\n"));
}

}  // namespace
}  // namespace tubesight::tests
