#include "drivers/replay/replay_meta.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

const std::string kHeader = "field,sequence,time_s,status,lamp_permille\n";

TEST(ReplayMeta, ReadsRows) {
  ReplayMeta meta;
  Messages messages;

  ASSERT_TRUE(meta.parse(kHeader + "0,7,0.000000,good,500\n1,9,0.050001,damaged,\n3,10,1,ok,0\n",
                         "a.meta.csv", messages));

  ASSERT_EQ(meta.rows().size(), 3u);
  EXPECT_EQ(meta.rows()[0].sequence, 7);
  EXPECT_EQ(meta.rows()[0].lamp_permille, 500);
  EXPECT_EQ(meta.rows()[1].time.count(), 50001000);
  EXPECT_EQ(meta.rows()[1].status, core::FieldStatus::kDamaged);
  EXPECT_FALSE(meta.rows()[1].lamp_permille.has_value());
  EXPECT_EQ(meta.rows()[2].status, core::FieldStatus::kGood);
  EXPECT_EQ(meta.rows()[2].line, 4);
  EXPECT_EQ(meta.find(2), nullptr);
  ASSERT_NE(meta.find(3), nullptr);
  EXPECT_EQ(meta.find(3)->sequence, 10);
}

TEST(ReplayMeta, TellsEachWrongCell) {
  ReplayMeta meta;
  Messages messages;

  const auto outcome = meta.parse(
      kHeader + "-1,x,1e3,lost,1001\n0,1,2\n5,1,0,good,1\n5,2,1,good,1\n", "a.meta.csv", messages);

  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error(), core::Error::kInvalidArgument);
  EXPECT_EQ(
      messages,
      (Messages{"a.meta.csv:2: field: '-1', expected a whole number from 0",
                "a.meta.csv:2: sequence: 'x', expected a whole number",
                "a.meta.csv:2: time_s: '1e3', expected seconds with at most 9 decimals",
                "a.meta.csv:2: status: 'lost', expected good, damaged or missing",
                "a.meta.csv:2: lamp_permille: '1001', expected a whole number from 0 to 1000, or "
                "nothing",
                "a.meta.csv:3: 3 cells, expected 5",
                "a.meta.csv:5: field: 5, expected more than in the row before (5)"}));
}

TEST(ReplayMeta, SaysOfNumbersThatAreTooLargeThatTheyAre) {
  ReplayMeta meta;
  Messages messages;
  const std::string far = "expected at most 4000000000 s to either side of zero";

  EXPECT_FALSE(meta.parse(kHeader +
                              "0,0,4154505010.207436,good,\n1,1,-99999999999999999999.5,good,\n"
                              "2,2,0.0000000001,good,\n3,99999999999999999999,5,good,\n"
                              "99999999999999999999,4,6,good,\n",
                          "m", messages));

  EXPECT_EQ(messages,
            (Messages{"m:2: time_s: '4154505010.207436', " + far,
                      "m:3: time_s: '-99999999999999999999.5', " + far,
                      "m:4: time_s: '0.0000000001', expected seconds with at most 9 decimals",
                      "m:5: sequence: '99999999999999999999', expected a number below 2^62 "
                      "either way",
                      "m:6: field: '99999999999999999999', expected a smaller number"}));
}

TEST(ReplayMeta, TakesMissingFieldsWithAndWithoutANumber) {
  ReplayMeta meta;
  Messages messages;

  ASSERT_TRUE(meta.parse(kHeader + "0,,0.00,missing,\n1,4,0.02,good,\n2,,0.04,missing,\n"
                                   "3,4,0.06,missing,\n4,5,0.08,good,\n",
                         "m", messages));
  ASSERT_EQ(meta.rows().size(), 5U);
  EXPECT_EQ(meta.rows()[2].status, core::FieldStatus::kMissing);
  EXPECT_EQ(meta.rows()[2].sequence, 4);
  EXPECT_EQ(meta.rows()[3].sequence, 4);
  EXPECT_EQ(meta.rows()[4].sequence, 5);

  EXPECT_FALSE(meta.parse(kHeader + "0,,0.00,damaged,\n1,x,0.02,missing,\n", "m", messages));
  EXPECT_EQ(messages, (Messages{"m:2: sequence: '', expected a whole number",
                                "m:3: sequence: 'x', expected a whole number"}));
}

TEST(ReplayMeta, RefusesTimesAndNumbersThatDoNotGrow) {
  ReplayMeta meta;
  Messages messages;

  // The farthest that are served, both ways.
  EXPECT_TRUE(meta.parse(kHeader + "0,-4611686018427387903,-4000000000,good,\n"
                                   "1,4611686018427387903,4000000000,good,\n",
                         "m", messages));
  EXPECT_FALSE(meta.parse(kHeader + "0,4611686018427387903,-4000000000,good,\n"
                                    "1,-4611686018427387903,4000000000,good,\n",
                          "m", messages));
  messages.clear();

  EXPECT_FALSE(meta.parse(kHeader + "0,3,0.00,good,\n1,3,0.00,good,\n", "m", messages));

  EXPECT_EQ(messages,
            (Messages{"m:3: sequence: 3 for both fields of a frame, expected 1 more for the later",
                      "m:3: time_s: 0.000000000 for both fields of a frame, expected each field's "
                      "own mid-exposure"}));
}

TEST(ReplayMeta, RefusesRowsWithMoreCellsThanColumns) {
  ReplayMeta meta;
  Messages messages;

  EXPECT_FALSE(meta.parse(
      kHeader + "0,0,0.0,good,1,000\n1,1,0,02,good,5\n2,2,0.04,good,\"1,000\"\n", "m", messages));
  EXPECT_EQ(messages, (Messages{"m:2: 6 cells, expected 5", "m:3: 6 cells, expected 5",
                                "m:4: lamp_permille: '1,000', expected a whole number from 0 to "
                                "1000, or nothing"}));

  messages.clear();
  EXPECT_TRUE(meta.parse("field,sequence,time_s,status,lamp_permille,gain\n0,0,0,good,1,x\n", "m",
                         messages));
  EXPECT_FALSE(
      meta.parse("field,sequence,time_s,status,lamp_permille,gain\n0,0,0,good,1\n", "m", messages));
  EXPECT_EQ(messages, Messages{"m:2: 5 cells, expected 6"});
}

TEST(ReplayMeta, StopsAfterTwentyMessages) {
  ReplayMeta meta;
  Messages messages;
  std::string text = kHeader;
  for (int i = 0; i < 100; ++i) {
    text += "bad\n";
  }

  EXPECT_FALSE(meta.parse(text, "a.meta.csv", messages));
  EXPECT_EQ(messages.size(), 20u);
}

}  // namespace
}  // namespace tubesight::drivers
