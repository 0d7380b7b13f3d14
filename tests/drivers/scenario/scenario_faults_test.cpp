#include "drivers/scenario/scenario_faults.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/drivers/scenario/scenario_reading.h"

namespace tubesight::drivers {
namespace {

using drivers::Fault;
using drivers::FaultKind;

/// The fault of a scenario with one.
Fault read_fault(const std::string& text) {
  const ScenarioReading read(kRestPath + "[[fault]]\n" + text);
  EXPECT_TRUE(read.good) << read.told();
  return read.scenario().faults.empty() ? Fault{} : read.scenario().faults.front();
}

TEST(ScenarioFaults, EachKindHasItsWordAndDefaults) {
  EXPECT_EQ(read_fault("kind = \"dropped\"\nat_s = 0.1\n").kind, FaultKind::kDropped);
  EXPECT_EQ(read_fault("kind = \"repeated\"\nat_s = 0.1\n").kind, FaultKind::kRepeated);
  EXPECT_EQ(read_fault("kind = \"torn\"\nat_s = 0.1\n").share, 0.5);
  EXPECT_EQ(read_fault("kind = \"swapped\"\nat_s = 0.1\n").kind, FaultKind::kSwapped);
  EXPECT_EQ(read_fault("kind = \"black\"\nat_s = 0.1\n").level, 4.0);
  EXPECT_EQ(read_fault("kind = \"saturated\"\nat_s = 0.1\n").kind, FaultKind::kSaturated);
  EXPECT_FALSE(read_fault("kind = \"signal-loss\"\nat_s = 0.1\n").told);
  EXPECT_EQ(read_fault("kind = \"knock\"\nat_s = 0.1\n").angle_deg, 0.3);
  EXPECT_EQ(read_fault("kind = \"lamp-out\"\nat_s = 0.1\n").level, 0.0);
  EXPECT_EQ(read_fault("kind = \"lamp-drift\"\nat_s = 0.1\nfor_s = 0.1\n").level, 0.0);
  EXPECT_EQ(read_fault("kind = \"vibration\"\nat_s = 0.1\nfor_s = 0.1\n").shake_mm[1], 0.2);
  EXPECT_TRUE(read_fault("kind = \"cut\"\nat_s = 0.1\nfor_s = 0.1\n").told);
  EXPECT_EQ(read_fault("kind = \"jump\"\nat_s = 0.1\n").columns, 1);
  EXPECT_EQ(read_fault("kind = \"emi\"\nat_s = 0.1\n").amplitude, 60.0);
  EXPECT_EQ(read_fault("kind = \"salt-pepper\"\nat_s = 0.1\n").share, 0.01);
}

TEST(ScenarioFaults, ReadTheirParameters) {
  const Fault dead =
      read_fault("kind = \"lamps-dead\"\nat_s = 0.25\nfor_s = 0.5\nlamps = [1, 12]\n");
  EXPECT_EQ(dead.at_s, 0.25);
  EXPECT_EQ(dead.for_s, 0.5);
  EXPECT_EQ(dead.lamps, 0b100000000001);
  const Fault jump = read_fault("kind = \"jump\"\nat_s = 0.1\nsteps = [-2, 3]\n");
  EXPECT_EQ(jump.rows, -2);
  EXPECT_EQ(jump.columns, 3);
  const Fault knock =
      read_fault("kind = \"knock\"\nat_s = 0\naxis = [1, 0, 0]\nangle_deg = -0.5\n");
  EXPECT_EQ(knock.axis[0], 1.0);
  EXPECT_EQ(knock.angle_deg, -0.5);
  EXPECT_TRUE(read_fault("kind = \"signal-loss\"\nat_s = 0\ndamaged = true\n").told);
  EXPECT_FALSE(read_fault("kind = \"cut\"\nat_s = 0.1\nfor_s = 0.1\ncounted = false\n").told);
}

struct Wrong {
  const char* fault;
  const char* message;
};

class ScenarioFaultsRefuse : public testing::TestWithParam<Wrong> {};

TEST_P(ScenarioFaultsRefuse, InOneLine) {
  const ScenarioReading read(kRestPath + "[[fault]]\n" + GetParam().fault);

  EXPECT_FALSE(read.good);
  EXPECT_EQ(read.told(), std::string("s.toml:") + GetParam().message + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    What, ScenarioFaultsRefuse,
    testing::Values(
        Wrong{"kind = \"black\"\n",
              "6: fault[0].at_s: missing, expected a number from 0 to 86400 s"},
        Wrong{"kind = \"black\"\nat_s = -1\n",
              "8: fault[0].at_s: -1, expected a number from 0 to 86400 s"},
        Wrong{"kind = \"vibration\"\nat_s = 0\n",
              "6: fault[0].for_s: missing or 0, expected how long it lasts"},
        Wrong{"kind = \"lamps-dead\"\nat_s = 0\nlamps = [13]\n",
              "9: fault[0].lamps[0]: 13, expected numbers of lamps, 1 to 12"},
        Wrong{"kind = \"lamps-dead\"\nat_s = 0\nlamps = []\n",
              "9: fault[0].lamps: an empty list, expected numbers of lamps, 1 to 12"},
        Wrong{"kind = \"knock\"\nat_s = 0\naxis = [0, 0, 0]\n",
              "9: fault[0].axis: no direction, expected a vector x, y, z of the camera frame"},
        Wrong{"kind = \"torn\"\nat_s = 0\nshare = 1.5\n",
              "9: fault[0].share: 1.5, expected a number from 0 to 1"}));

TEST(ScenarioFaults, OfPicturesInThePlaceOfTheCamerasOneIsShownAtATime) {
  const std::string frozen = "[[fault]]\nkind = \"frozen\"\nat_s = 0.1\n";
  const std::string other = "[[fault]]\nkind = \"other-camera\"\nat_s = 0.4\n";
  const ScenarioReading both(kRestPath + frozen + other);
  const ScenarioReading turn(kRestPath + frozen + "for_s = 0.3\n" + other);
  const ScenarioReading again(kRestPath + other + frozen + "for_s = 0.4\n");

  EXPECT_FALSE(both.good);
  EXPECT_NE(
      both.told().find("fault[1].kind: other-camera while a fault before, frozen, is at work, "
                       "expected one after the other"),
      std::string::npos)
      << both.told();
  EXPECT_TRUE(turn.good) << turn.told();
  EXPECT_FALSE(again.good) << "whichever stands first";
}

TEST(ScenarioFaults, AJumpOnASheetOfEverySecondAddressIsAnEvenOne) {
  const std::string sheet =
      "[tubesheet]\nrow_step_mm = [0.0, 19.2474]\ncolumn_step_mm = [11.1125, 0.0]\n"
      "bore_mm = 14.2\nrows = [0, 120]\ncolumns = [0, 240]\naddresses = \"even-sum\"\n";
  const ScenarioReading read(
      "[path]\ntube = [31, 119]\n[[step]]\nrest_s = 1.0\n"
      "[[fault]]\nkind = \"jump\"\nat_s = 0.5\nsteps = [0, 1]\n",
      {}, sheet);

  EXPECT_EQ(read.told(),
            "s.toml:9: fault[0].steps: an odd sum of rows and columns, expected an even one on "
            "this sheet\n");
}

TEST(ScenarioFaults, AJumpOnASheetOfShiftedRowsIsByAnEvenNumberOfThem) {
  const std::string sheet =
      "[tubesheet]\nrow_step_mm = [0.0, 25.4]\ncolumn_step_mm = [25.4, 0.0]\n"
      "bore_mm = 18.6\nrows = [0, 120]\ncolumns = [0, 120]\nodd_row_shift = 0.25\n";
  const auto told = [&](const std::string& steps) {
    return ScenarioReading(
               "[path]\ntube = [31, 59]\n[[step]]\nrest_s = 1.0\n"
               "[[fault]]\nkind = \"jump\"\nat_s = 0.5\nsteps = " +
                   steps + "\n",
               {}, sheet)
        .told();
  };

  EXPECT_EQ(told("[2, -1]"), "");
  EXPECT_EQ(told("[-1, 1]"),
            "s.toml:9: fault[0].steps: an odd number of rows, expected an even one on this "
            "sheet\n");
}

}  // namespace
}  // namespace tubesight::drivers
