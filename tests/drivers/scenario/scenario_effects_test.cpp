// Faults and events that would do nothing, and jumps to where no tool can be.

#include "drivers/scenario/scenario_effects.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/drivers/scenario/scenario_reading.h"

namespace tubesight::drivers {
namespace {

/// Two rests and the way between, from one row to another, before what comes at line 10.
std::string between_rows(const std::string& from, const std::string& to) {
  return "[path]\ntube = [" + from + ", 60]\n[[step]]\nrest_s = 0.5\n[[step]]\nto = [" + to +
         ", 60]\n[[step]]\nrest_s = 0.5\n";
}

std::string jump(const std::string& steps, const std::string& times) {
  return "[[fault]]\nkind = \"jump\"\n" + times + "\nsteps = [" + steps + "]\n";
}

std::string off_the_sheet(const std::string& place) {
  return "steps: (1524, " + place +
         " and column 60, expected a row from 0 to 120 and a column from 0 to 120\n";
}

TEST(ScenarioJumps, MayNotLeaveTheSheetAtOnce) {
  const ScenarioReading read(between_rows("2", "8") + jump("-4, 0", "at_s = 0.1"));

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.told(),
            "s.toml:13: fault[0]." + off_the_sheet("-50.8) mm is off the sheet, at row -2"));
}

TEST(ScenarioJumps, MayNotBringALaterStepOffTheSheet) {
  const ScenarioReading read(between_rows("8", "2") + jump("-4, 0", "at_s = 0.1"));

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.told(),
            "s.toml:13: fault[0]." + off_the_sheet("-50.8) mm is off the sheet, at row -2"));
}

TEST(ScenarioJumps, CountTogether) {
  const std::string first = jump("-2, 0", "at_s = 0.3");
  const ScenarioReading read(between_rows("2", "3") + first + jump("-1, 0", "at_s = 0.1"));

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.told(),
            "s.toml:13: fault[0]." + off_the_sheet("-25.4) mm is off the sheet, at row -1"));
}

TEST(ScenarioJumps, MayNotLeaveItJustBeforeTheyEnd) {
  // The move from row 4 to row 0 takes from 0.5 s to some 1.3 s: half way, at row 2, the jump ends.
  const ScenarioReading ends(between_rows("4", "0") + jump("-4, 0", "at_s = 0.1\nfor_s = 0.8"));

  EXPECT_FALSE(ends.good);
  EXPECT_NE(ends.told().find("s.toml:14: fault[0].steps: (1524, -"), std::string::npos)
      << ends.told();
}

TEST(ScenarioJumps, MayLeadAnywhereOnTheSheet) {
  const ScenarioReading while_far(between_rows("8", "2") +
                                  jump("-4, 0", "at_s = 0.1\nfor_s = 0.3"));
  EXPECT_TRUE(while_far.good) << while_far.told();

  const ScenarioReading one_undoes_another(between_rows("2", "3") + jump("-4, 0", "at_s = 0.3") +
                                           jump("4, 0", "at_s = 0.1"));
  EXPECT_TRUE(one_undoes_another.good) << one_undoes_another.told();
}

struct Idle {
  const char* text;  ///< from line 6, beside a second of rest
  const char* message;
};

class IdleTable : public testing::TestWithParam<Idle> {};

TEST_P(IdleTable, IsRefusedInOneLine) {
  const ScenarioReading read(kRestPath + GetParam().text);

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.told(), std::string("s.toml:") + GetParam().message + "\n");
}

// Fields are at multiples of 1/60 s, frames begin at multiples of 1/30 s.
INSTANTIATE_TEST_SUITE_P(
    What, IdleTable,
    testing::Values(
        Idle{"[[fault]]\nkind = \"black\"\nat_s = 0.201\nfor_s = 0.01\n",
             "9: fault[0].for_s: no field lies in it, expected longer or another at_s"},
        Idle{"[[fault]]\nkind = \"swapped\"\nat_s = 0.201\nfor_s = 0.03\n",
             "9: fault[0].for_s: no frame begins in it, expected longer or another at_s"},
        Idle{"[[fault]]\nkind = \"cut\"\nat_s = 0.97\n",
             "8: fault[0].at_s: no field is left from then on, expected an earlier time"},
        Idle{"[[fault]]\nkind = \"lamp-out\"\nat_s = 0.99\n",
             "8: fault[0].at_s: no field is left from then on, expected an earlier time"},
        Idle{"[[event]]\nkind = \"claim\"\ntube = [40, 60]\nat_s = 0.99\n",
             "9: event[0].at_s: no field is delivered from then on, expected an earlier time"},
        Idle{"[[event]]\nkind = \"pose\"\nat_s = 0.85\n[[fault]]\nkind = \"dropped\"\nat_s = 0.8\n"
             "for_s = 0.2\n",
             "8: event[0].at_s: no field is delivered from then on, expected an earlier time"},
        Idle{"claim = true\n[[fault]]\nkind = \"cut\"\nat_s = 0.5\nfor_s = 0.5\n",
             "6: step[0].claim: no field is delivered from then on, expected an earlier time"},
        Idle{"[video]\nlength_s = 0.6\n[[step]]\nrest_s = 0.01\nclaim = true\n"
             "[[event]]\nkind = \"start\"\nat_s = 0.595\n",
             "11: event[0]: no field is delivered from then on, expected one to click in"}));

TEST(ScenarioEffects, AllowWhatReachesTheLastField) {
  const std::string last = "at_s = 0.983\n";  // the last field is at 0.98333 s
  const ScenarioReading read(kRestPath + "[[event]]\nkind = \"pose\"\n" + last +
                             "[[fault]]\nkind = \"torn\"\n" + last +
                             "[[fault]]\nkind = \"swapped\"\nat_s = 0.96\n");

  EXPECT_TRUE(read.good) << read.told();
}

TEST(ScenarioEffects, LeaveOutTheClaimsOfStepsThatTheRecordingCutsOff) {
  const ScenarioReading read(kRestPath + "claim = true\n[video]\nlength_s = 0.3\n");

  EXPECT_TRUE(read.good) << read.told();
}

}  // namespace
}  // namespace tubesight::drivers
