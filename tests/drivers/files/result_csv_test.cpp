#include "drivers/files/result_csv.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "core/base/names.h"

namespace tubesight::drivers {
namespace {

core::Sighting full_sighting() {
  core::Sighting sighting;
  sighting.time = core::FieldTime(16666667);
  sighting.state = core::TrackState::kTracking;
  sighting.reason = core::Reason::kNone;
  sighting.tracked = 17;
  sighting.primary_known = true;
  sighting.primary = {40, -60};
  sighting.primary_px = {313 * 65536 + 32768, 196 * 65536 + 33};  // 313.5, 196.0005035
  sighting.axis_known = true;
  sighting.height_um_q8 = 60000 * 256 + 13;  // 60.00005078 mm
  sighting.tool_known = true;
  sighting.tool = {41, 62};
  sighting.offset_um_q8 = 550 * 256 + 51;                       // 0.55019921875 mm
  sighting.displacement_um_q8 = {450 * 256, -316 * 256 - 154};  // 0.45, -0.3166016 mm
  sighting.aligned = true;
  sighting.judged = true;
  sighting.residual_px_q16 = 8192 + 13;  // 0.1252
  sighting.margin_known = true;
  sighting.margin_permyriad = 123456;
  return sighting;
}

TEST(AppendFieldsRow, WritesEveryCell) {
  std::string row;
  append_fields_row(row, 1, core::Parity::kOdd, full_sighting());

  EXPECT_EQ(row,
            "1,0,odd,0.016667,tracking,17,40,-60,313.500,196.001,41,62,0.5502,60.0001,1,12.3456,,0."
            "4500,-0.3166,0.125,unknown\n");
}

TEST(AppendFieldsRow, HasAsManyCellsAsItsHeader) {
  std::string row;
  append_fields_row(row, 0, core::Parity::kEven, {});

  EXPECT_EQ(row, "0,0,even,0.000000,waiting,0,,,,,,,,,0,,no-start,,,,unknown\n");
  EXPECT_EQ(std::count(row.begin(), row.end(), ','),
            std::count(kFieldsHeader.begin(), kFieldsHeader.end(), ','));
}

TEST(AppendFieldsRow, KeepsHeightOverAVoid) {
  core::Sighting sighting = full_sighting();
  sighting.tool_known = false;
  sighting.aligned = false;
  sighting.margin_known = false;
  std::string row;
  append_fields_row(row, 184, core::Parity::kProgressive, sighting);

  EXPECT_EQ(row,
            "184,92,progressive,0.016667,tracking,17,40,-60,313.500,196.001,,,,60.0001,0,,,,,0.125,"
            "unknown\n");
}

TEST(AppendFieldsRow, SaysWhyItIsLost) {
  core::Sighting sighting;
  sighting.state = core::TrackState::kLost;
  sighting.reason = core::Reason::kCoasted;
  std::string row;
  append_fields_row(row, 7, core::Parity::kOdd, sighting);

  EXPECT_EQ(row, "7,3,odd,0.000000,lost,0,,,,,,,,,0,,coasted,,,,unknown\n");
}

TEST(AppendCentersRow, WritesEveryCell) {
  core::TubeSighting tube;
  tube.address = {-3, 12};
  tube.center_px = {-32768, 480 * 65536 - 1};  // -0.5, just under 480
  tube.quality_permyriad = 9876;
  std::string row;
  append_centers_row(row, 12, tube);

  EXPECT_EQ(row, "12,-3,12,-0.500,480.000,0.9876\n");
}

TEST(Names, ReasonsAreOneWordEach) {
  using core::Reason;
  const std::pair<Reason, std::string_view> expected[] = {{Reason::kNone, ""},
                                                          {Reason::kNoStart, "no-start"},
                                                          {Reason::kStartRefused, "start-refused"},
                                                          {Reason::kFewTubes, "few-tubes"},
                                                          {Reason::kDark, "dark"},
                                                          {Reason::kWashedOut, "washed-out"},
                                                          {Reason::kNoTubes, "no-tubes"},
                                                          {Reason::kDamagedField, "damaged-field"},
                                                          {Reason::kUncertain, "uncertain"},
                                                          {Reason::kCoasted, "coasted"},
                                                          {Reason::kJump, "jump"},
                                                          {Reason::kSpeed, "speed"},
                                                          {Reason::kGap, "gap"},
                                                          {Reason::kTime, "time"},
                                                          {Reason::kSequence, "sequence"},
                                                          {Reason::kRate, "rate"},
                                                          {Reason::kMap, "map"},
                                                          {Reason::kFieldOrder, "field-order"},
                                                          {Reason::kNotLive, "not-live"},
                                                          {Reason::kArithmetic, "arithmetic"}};
  for (const auto& [reason, word] : expected) {
    EXPECT_EQ(core::name_of(reason), word);
  }
  EXPECT_EQ(core::name_of(core::TrackState::kDegraded), "degraded");
}

}  // namespace
}  // namespace tubesight::drivers
