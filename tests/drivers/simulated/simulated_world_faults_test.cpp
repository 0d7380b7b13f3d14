// What each fault does to delivery, pixels and truth, one test a kind.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/simulated/simulated_world.h"
#include "tests/drivers/simulated/small_scenario.h"
#include "tests/support/events.h"

namespace tubesight::drivers {
namespace {

/// A field with its pixels.
struct Kept {
  SimulatedField field;
  std::vector<std::uint8_t> pixels;

  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const std::uint8_t grey : pixels) {
      sum += grey;
    }
    return sum / static_cast<double>(pixels.size());
  }
  [[nodiscard]] std::vector<std::uint8_t> line(std::int32_t index) const {
    const auto width = static_cast<std::ptrdiff_t>(field.field.pixels.width_px);
    return {pixels.begin() + index * width, pixels.begin() + (index + 1) * width};
  }
};

/// The first fields of the small scenario with faults.
std::vector<Kept> play(const std::vector<Fault>& faults, int most = 14, double length_s = 0.25) {
  const auto scenario = small_scenario();
  scenario->faults = faults;
  scenario->video.length_s = length_s;
  const auto world = std::make_unique<SimulatedWorld>();
  EXPECT_TRUE(world->configure(*scenario));
  std::vector<Kept> all;
  Kept kept;
  while (static_cast<int>(all.size()) < most && world->next(kept.field)) {
    const core::FieldView& view = kept.field.field.pixels;
    kept.pixels.clear();
    for (std::int32_t line = 0; line < view.lines; ++line) {
      const std::uint8_t* const start =
          view.pixels + static_cast<std::ptrdiff_t>(line) * view.stride_px;
      kept.pixels.insert(kept.pixels.end(), start, start + view.width_px);
    }
    all.push_back(kept);
  }
  return all;
}

/// The field of slot `number` in a list that may lack some; the list holds it.
const Kept& of_slot(const std::vector<Kept>& all, std::int64_t number) {
  return *std::find_if(all.begin(), all.end(),
                       [number](const Kept& kept) { return kept.field.slot == number; });
}

/// Slot 6 is at 0.1 s.
Fault fault(FaultKind kind, double for_s = 0.0) {
  Fault made;
  made.kind = kind;
  made.at_s = 0.1;
  made.for_s = for_s;
  return made;
}

const std::vector<Kept>& sound() {
  static const std::vector<Kept> fields = play({});
  return fields;
}

TEST(FaultDropped, LeavesAGapInSequenceAndTime) {
  const auto fields = play({fault(FaultKind::kDropped)});

  ASSERT_GT(fields.size(), 7U);
  EXPECT_EQ(fields[5].field.field.sequence, 5);
  EXPECT_EQ(fields[6].field.field.sequence, 7);
  EXPECT_EQ(fields[6].field.field.parity, core::Parity::kOdd);
  EXPECT_EQ(fields[6].field.field.mid_exposure.count(), 116666667);
  EXPECT_EQ(fields[6].pixels, sound()[7].pixels) << "the others are as without the fault";
}

TEST(FaultRepeated, DeliversTheLastPictureOfTheSameLines) {
  const auto fields = play({fault(FaultKind::kRepeated, 0.04)});  // slots 6, 7, 8

  ASSERT_GT(fields.size(), 9U);
  EXPECT_EQ(fields[6].pixels, sound()[4].pixels);
  EXPECT_EQ(fields[7].pixels, sound()[5].pixels);
  EXPECT_EQ(fields[8].pixels, sound()[4].pixels);
  EXPECT_EQ(fields[9].pixels, sound()[9].pixels);
  EXPECT_EQ(fields[6].field.field.sequence, 6);
  EXPECT_EQ(fields[6].field.field.status, core::FieldStatus::kGood);
}

TEST(FaultTorn, KeepsTheOldPictureBelowALine) {
  Fault torn = fault(FaultKind::kTorn);
  torn.share = 0.25;
  const auto fields = play({torn});

  // 30 of 120 lines are new.
  ASSERT_GT(fields.size(), 7U);
  EXPECT_EQ(fields[6].line(29), sound()[6].line(29));
  EXPECT_EQ(fields[6].line(30), sound()[4].line(30));
  EXPECT_EQ(fields[6].line(119), sound()[4].line(119));
  EXPECT_NE(sound()[6].line(29), sound()[4].line(29)) << "so that the test can fail";
  EXPECT_EQ(fields[7].pixels, sound()[7].pixels);
}

TEST(FaultSwapped, ExposesTheFieldsOfAFrameInTheOtherOrder) {
  // In the move: slots 40 and 41 are at 0.6667 and 0.6833 s, 11.67 and 13.33 mm along the way.
  Fault swapped = fault(FaultKind::kSwapped);
  swapped.at_s = 40.0 / 60.0;
  const auto fields = play({swapped}, 44, 0.8);
  const auto plain = play({}, 44, 0.8);

  EXPECT_NEAR(of_slot(fields, 40).field.truth.axis.axis_mm[0], 1524.4 + 5.0 + 8.3333, 1e-3);
  EXPECT_NEAR(of_slot(fields, 41).field.truth.axis.axis_mm[0], 1524.4 + 5.0 + 6.6667, 1e-3);
  EXPECT_EQ(of_slot(fields, 40).field.field.parity, core::Parity::kEven);
  EXPECT_EQ(of_slot(fields, 40).field.field.mid_exposure,
            of_slot(plain, 40).field.field.mid_exposure);
  EXPECT_NE(of_slot(fields, 40).pixels, of_slot(plain, 40).pixels);
  EXPECT_EQ(of_slot(fields, 42).pixels, of_slot(plain, 42).pixels);
}

TEST(FaultBlack, ShowsNoLevelForAWhile) {
  Fault black = fault(FaultKind::kBlack, 0.05);  // slots 6, 7, 8
  black.level = 4.0;
  const auto fields = play({black});

  ASSERT_GT(fields.size(), 9U);
  for (const int number : {6, 7, 8}) {
    EXPECT_EQ(fields[static_cast<std::size_t>(number)].pixels,
              std::vector<std::uint8_t>(317 * 120, 4));
  }
  EXPECT_EQ(fields[6].field.field.status, core::FieldStatus::kGood);
  EXPECT_EQ(fields[9].pixels, sound()[9].pixels);
}

TEST(FaultSaturated, ShowsWhiteAllOver) {
  const auto fields = play({fault(FaultKind::kSaturated, 0.05)});

  ASSERT_GT(fields.size(), 9U);
  EXPECT_EQ(fields[7].pixels, std::vector<std::uint8_t>(317 * 120, 255));
  EXPECT_EQ(fields[9].pixels, sound()[9].pixels);
}

TEST(FaultSignalLoss, ShowsSnowThatTheDriverMarksOrNot) {
  Fault loss = fault(FaultKind::kSignalLoss, 0.05);
  loss.told = false;
  const auto silent = play({loss});
  loss.told = true;
  const auto told = play({loss});

  ASSERT_GT(silent.size(), 9U);
  EXPECT_NEAR(silent[6].mean(), 127.5, 3.0);  // sigma of the mean 0.4
  EXPECT_EQ(silent[6].field.field.status, core::FieldStatus::kGood);
  EXPECT_EQ(told[6].field.field.status, core::FieldStatus::kDamaged);
  EXPECT_EQ(told[9].field.field.status, core::FieldStatus::kGood);
  EXPECT_NE(silent[6].pixels, silent[8].pixels);
}

TEST(FaultKnock, MovesThePictureWhileTheToolStays) {
  Fault knock = fault(FaultKind::kKnock);
  knock.angle_deg = 0.5;
  knock.axis = {0.0, 1.0, 0.0};
  const auto fields = play({knock});

  ASSERT_GT(fields.size(), 8U);
  EXPECT_EQ(fields[5].pixels, sound()[5].pixels);
  EXPECT_NE(fields[6].pixels, sound()[6].pixels);
  EXPECT_EQ(fields[6].field.truth.axis.axis_mm, sound()[6].field.truth.axis.axis_mm);
  // Turned by +0.5 degrees about the camera's y axis: what was at (x, y, z) is at (x cos + z sin,
  // y, z cos - x sin), sin = 0.0087265, cos = 0.99996192.
  const auto before = sound()[6].field.truth.T_camera_sheet;
  const auto after = fields[6].field.truth.T_camera_sheet;
  const Eigen::Vector3d tube(1524.0, 1016.0, 0.0);
  const Eigen::Vector3d was = before * tube;
  const Eigen::Vector3d is = after * tube;
  EXPECT_NEAR(is.x(), 0.99996192 * was.x() + 0.0087265 * was.z(), 1e-4);
  EXPECT_NEAR(is.y(), was.y(), 1e-9);
  EXPECT_NEAR(is.z(), 0.99996192 * was.z() - 0.0087265 * was.x(), 1e-4);
  EXPECT_GT(was.z(), 100.0) << "so that the test can fail";
}

TEST(FaultLampOut, LeavesAShareOfTheLight) {
  Fault out = fault(FaultKind::kLampOut, 0.05);
  out.level = 0.2;
  const auto fields = play({out});

  ASSERT_GT(fields.size(), 9U);
  EXPECT_LT(fields[6].mean(), 0.5 * sound()[6].mean());
  EXPECT_EQ(fields[6].field.field.lamp_permille, 1000) << "what is commanded stays";
  EXPECT_EQ(fields[9].pixels, sound()[9].pixels);
}

TEST(FaultLampsDead, DarkenThePicture) {
  Fault dead = fault(FaultKind::kLampsDead);
  dead.lamps = 0b111111;
  const auto fields = play({dead});

  ASSERT_GT(fields.size(), 7U);
  EXPECT_LT(fields[6].mean(), 0.9 * sound()[6].mean());
  EXPECT_GT(fields[6].mean(), 0.1 * sound()[6].mean());
}

TEST(FaultLampDrift, DimsSlowly) {
  Fault drift = fault(FaultKind::kLampDrift, 0.1);
  drift.level = 0.1;
  const auto fields = play({drift});

  ASSERT_GT(fields.size(), 12U);
  EXPECT_LT(fields[9].mean(), 0.9 * fields[6].mean());
  EXPECT_LT(fields[12].mean(), 0.6 * fields[9].mean());
}

TEST(FaultVibration, ShakesTheTool) {
  Fault vibration = fault(FaultKind::kVibration, 0.1);
  vibration.shake_mm = {1.0, 0.0, 0.0};
  vibration.frequency_hz = 15.0;
  const auto fields = play({vibration});

  ASSERT_GT(fields.size(), 13U);
  double most = 0.0;
  for (const Kept& kept : fields) {
    const double off = std::abs(kept.field.truth.axis.axis_mm[0] - 1524.4) +
                       std::abs(kept.field.truth.axis.axis_mm[1] - 1015.7);
    most = std::max(most, off);
    if (kept.field.slot < 6 || kept.field.slot > 12) {
      EXPECT_NEAR(off, 0.0, 1e-9) << kept.field.slot;
    }
  }
  EXPECT_GT(most, 0.5);
  EXPECT_GT(fields[8].field.truth.speed_mm_s, 5.0);
}

TEST(FaultCut, LeavesOutWholeFrames) {
  Fault cut = fault(FaultKind::kCut, 0.05);  // frames at 0.1 and 0.1333 s: slots 6 to 9
  const auto counted = play({cut});
  cut.told = false;
  const auto silent = play({cut});

  ASSERT_GT(counted.size(), 7U);
  EXPECT_EQ(counted[6].field.slot, 10);
  EXPECT_EQ(counted[6].field.field.sequence, 10);
  EXPECT_EQ(silent[6].field.slot, 10);
  EXPECT_EQ(silent[6].field.field.sequence, 6) << "time alone shows it";
  EXPECT_EQ(silent[6].field.field.mid_exposure.count(), 166666667);
}

TEST(FaultCut, WithoutALengthLeavesOutTheNextFrame) {
  Fault cut = fault(FaultKind::kCut);
  cut.at_s = 0.101;  // just after the frame of slots 6 and 7 has begun
  const auto fields = play({cut});

  ASSERT_GT(fields.size(), 8U);
  EXPECT_EQ(fields[7].field.slot, 7);
  EXPECT_EQ(fields[8].field.slot, 10);
}

TEST(FaultJump, MovesTheToolByLatticeStepsAndShowsNothing) {
  Fault jump = fault(FaultKind::kJump);
  jump.rows = 1;
  jump.columns = -2;
  const auto fields = play({jump});

  ASSERT_GT(fields.size(), 8U);
  EXPECT_EQ(fields[5].field.truth.axis.nearest.address, (core::TubeAddress{40, 60}));
  EXPECT_EQ(fields[5].field.truth.slip, (std::array<std::int32_t, 2>{0, 0}));
  EXPECT_EQ(fields[6].field.truth.axis.nearest.address, (core::TubeAddress{41, 58}));
  EXPECT_NEAR(fields[6].field.truth.axis.nearest.offset_mm, 0.5, 1e-9);
  EXPECT_EQ(fields[6].field.truth.slip, (std::array<std::int32_t, 2>{1, -2}));
  EXPECT_EQ(fields[6].field.field.sequence, 6);
}

/// Slips of the first fields, by slots; lost ones have 9.
std::vector<int> column_slips(const std::vector<Fault>& faults, double start_s = -1.0) {
  const auto scenario = small_scenario();
  scenario->faults = faults;
  scenario->video.length_s = 0.2;
  if (start_s >= 0.0) {
    ScenarioEvent start;
    start.at_s = start_s;
    start.event.content = core::Start{};
    scenario->events = {start};
  }
  const auto world = std::make_unique<SimulatedWorld>();
  EXPECT_TRUE(world->configure(*scenario));
  std::vector<int> slips;
  SimulatedField field;
  while (world->next_slot(field)) {
    slips.push_back(field.lost ? 9 : field.truth.slip[1]);
  }
  return slips;
}

TEST(FaultJump, IsSilentUntilItEnds) {
  Fault jump = fault(FaultKind::kJump, 0.04);  // slots 6, 7, 8
  jump.columns = 2;

  EXPECT_EQ(column_slips({jump}), (std::vector<int>{0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0}));
}

TEST(FaultJump, IsNotSilentInAGap) {
  Fault jump = fault(FaultKind::kJump);
  jump.columns = 2;
  Fault dropped = fault(FaultKind::kDropped);
  dropped.at_s = 0.075;  // slot 5, before the jump
  Fault cut = fault(FaultKind::kCut);
  cut.told = false;  // slots 6 and 7: time shows it
  Fault later = fault(FaultKind::kDropped);
  later.at_s = 0.11;  // slot 7, after the jump

  EXPECT_EQ(column_slips({jump, dropped}), (std::vector<int>{0, 0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(column_slips({jump, cut}), (std::vector<int>{0, 0, 0, 0, 0, 0, 9, 9, 0, 0, 0, 0}));
  EXPECT_EQ(column_slips({jump, later}), (std::vector<int>{0, 0, 0, 0, 0, 0, 2, 9, 2, 2, 2, 2}));
}

TEST(FaultJump, IsKnownToWhoStartsAnew) {
  Fault jump = fault(FaultKind::kJump, 0.08);  // slots 6 to 10
  jump.columns = 2;

  EXPECT_EQ(column_slips({jump}, 0.13), (std::vector<int>{0, 0, 0, 0, 0, 0, 2, 2, 0, 0, 0, -2}));
}

TEST(FaultEmi, DisturbsSomeLines) {
  Fault emi = fault(FaultKind::kEmi);
  emi.share = 0.3;
  emi.amplitude = 60.0;
  const auto fields = play({emi});

  ASSERT_GT(fields.size(), 7U);
  int lines = 0;
  for (std::int32_t line = 0; line < 120; ++line) {
    lines += fields[6].line(line) != sound()[6].line(line) ? 1 : 0;
  }
  EXPECT_GT(lines, 18);  // 36 expected, sigma 5
  EXPECT_LT(lines, 54);
  EXPECT_EQ(fields[7].pixels, sound()[7].pixels);
}

TEST(FaultSaltPepper, StrewsPixels) {
  Fault strewn = fault(FaultKind::kSaltPepper);
  strewn.share = 0.05;
  const auto fields = play({strewn});

  ASSERT_GT(fields.size(), 7U);
  int differ = 0;
  for (std::size_t i = 0; i < fields[6].pixels.size(); ++i) {
    const std::uint8_t grey = fields[6].pixels[i];
    if (grey != sound()[6].pixels[i]) {
      ++differ;
      EXPECT_TRUE(grey == 0 || grey == 255);
    }
  }
  EXPECT_GT(differ, 1500);  // 1902 throws
  EXPECT_LE(differ, 1902);
}

TEST(Faults, EventsOfALostFieldReachTheNext) {
  const auto scenario = small_scenario();
  scenario->faults = {fault(FaultKind::kDropped)};
  scenario->events = {{0.095, tests::event_of(core::Claim{{40, 60}})}};
  const auto world = std::make_unique<SimulatedWorld>();
  ASSERT_TRUE(world->configure(*scenario));
  SimulatedField field;
  for (int i = 0; i < 7; ++i) {
    ASSERT_TRUE(world->next(field));
  }

  EXPECT_EQ(field.slot, 7);
  ASSERT_EQ(field.events.size(), 1);
  EXPECT_EQ(tests::content_of<core::Claim>(field.events[0]).tube, (core::TubeAddress{40, 60}));
  EXPECT_EQ(field.events[0].at, std::chrono::milliseconds(95)) << "its own instant";
  EXPECT_EQ(field.events[0].id, 1);
}

TEST(Faults, NextSlotTellsOfLostFieldsToo) {
  const auto scenario = small_scenario();
  scenario->faults = {fault(FaultKind::kDropped)};
  const auto world = std::make_unique<SimulatedWorld>();
  ASSERT_TRUE(world->configure(*scenario));
  SimulatedField field;
  for (int i = 0; i < 7; ++i) {
    ASSERT_TRUE(world->next_slot(field));
  }

  EXPECT_EQ(field.slot, 6);
  EXPECT_TRUE(field.lost);
  EXPECT_EQ(field.field.status, core::FieldStatus::kDamaged);
  EXPECT_EQ(field.truth.axis.nearest.address, (core::TubeAddress{40, 60}));
}

}  // namespace
}  // namespace tubesight::drivers
