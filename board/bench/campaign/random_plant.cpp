#include <algorithm>
#include <cmath>

#include "board/bench/campaign/random_parts.h"
#include "core/tubesheet/addresses.h"
#include "core/tubesheet/sheet_places.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::board::campaign {
namespace {

using core::AddressParity;
using core::TubeAddress;
using core::TubesheetSettings;
using core::rendering::PlugKind;
using core::tubesheet::center_mm;
using drivers::Scenario;

constexpr std::int32_t kMostSeed = 2'000'000'000;  // what scenario files hold

// A quarter turn of both steps, some times, and perhaps a mirror: every numbering that plants use.
void turn_numbering(RandomSource& random, TubesheetSettings& sheet) {
  const std::int32_t quarters = random.whole(0, 3);
  for (auto* step : {&sheet.row_step_mm, &sheet.column_step_mm}) {
    for (std::int32_t i = 0; i < quarters; ++i) {
      *step = {-(*step)[1], (*step)[0]};
    }
  }
  if (random.chance(0.5)) {
    std::swap(sheet.row_step_mm, sheet.column_step_mm);
  }
}

void draw_lattice(const Stratum& stratum, RandomSource& random, TubesheetSettings& sheet) {
  const double pitch = random.between(20.6, 32.6);
  sheet.bore_mm = pitch * random.between(0.60, 0.74);
  sheet.origin_mm = {random.between(-500.0, 500.0), random.between(-500.0, 500.0)};
  sheet.rows = {0, kLastAddress};
  sheet.columns = {0, kLastAddress};
  sheet.weld = stratum.weld == WeldKind::kFlush ? core::Weld::kFlush : core::Weld::kFillet;
  sheet.addresses = AddressParity::kAll;
  const double rise = pitch * std::sqrt(0.75);
  if (stratum.pitch == Pitch::kSquare) {
    sheet.row_step_mm = {0.0, pitch};
    sheet.column_step_mm = {pitch, 0.0};
  } else if (random.chance(0.5)) {
    sheet.row_step_mm = {pitch / 2.0, rise};
    sheet.column_step_mm = {pitch, 0.0};
  } else {
    sheet.row_step_mm = {0.0, rise};
    sheet.column_step_mm = {pitch / 2.0, 0.0};
    sheet.addresses = random.chance(0.5) ? AddressParity::kEvenSum : AddressParity::kOddSum;
  }
  turn_numbering(random, sheet);
}

void add_missing(TubesheetSettings& sheet, TubeAddress address) {
  static_cast<void>(sheet.missing.try_push_back(address));
}

// A round stay, or a lane, in the middle part of the sheet, where the tool goes.
void draw_voids(RandomSource& random, TubesheetSettings& sheet) {
  const std::array<double, 2> middle =
      center_mm(sheet, {random.whole(12, 28), random.whole(12, 28)});
  if (random.chance(0.25)) {
    const double radius = pitch_mm(sheet) * random.between(0.6, 2.1);
    for (std::int32_t row = 0; row <= kLastAddress; ++row) {
      for (std::int32_t column = 0; column <= kLastAddress; ++column) {
        const auto at = center_mm(sheet, {row, column});
        if (std::hypot(at[0] - middle[0], at[1] - middle[1]) < radius) {
          add_missing(sheet, {row, column});
        }
      }
    }
  } else if (random.chance(0.1)) {
    const std::int32_t lane = random.whole(14, 26);
    const bool along_row = random.chance(0.5);
    for (std::int32_t i = 0; i <= kLastAddress; ++i) {
      add_missing(sheet, along_row ? TubeAddress{lane, i} : TubeAddress{i, lane});
    }
  }
}

// Plugs, half of them in the lists that the box is given.
void draw_plugs(RandomSource& random, Scenario& scenario) {
  const double share = random.chance(0.5) ? random.between(0.0, 0.08) : 0.0;
  const TubesheetSettings& sheet = scenario.scene.sheet;
  const auto missing = sheet.missing.view();
  for (std::int32_t row = 0; row <= kLastAddress; ++row) {
    for (std::int32_t column = 0; column <= kLastAddress; ++column) {
      const TubeAddress address{row, column};
      const bool absent = !core::tubesheet::exists(sheet.addresses, address) ||
                          std::find(missing.begin(), missing.end(), address) != missing.end();
      if (!random.chance(share) || absent) {
        continue;
      }
      const PlugKind kind = random.chance(0.5) ? PlugKind::kRolled : PlugKind::kFlush;
      static_cast<void>(scenario.scene.plugs.try_push_back({address, kind}));
      if (random.chance(0.5)) {
        static_cast<void>(scenario.told.tubesheet.plugged.try_push_back(address));
        static_cast<void>(scenario.scene.sheet.plugged.try_push_back(address));
      }
    }
  }
}

void draw_looks(RandomSource& random, core::rendering::SheetLook& look) {
  look.plate = random.between(0.38, 0.55);
  look.gloss = random.between(0.2, 0.7);
  look.texture = random.between(0.04, 0.14);
  look.stains = random.between(0.04, 0.22);
  look.weld = random.between(0.5, 0.62);
  look.weld_mm = random.between(1.0, 2.0);
  look.fillet_mm = random.between(2.5, 3.5);
  look.fillet_height_mm = random.between(2.0, 3.2);
  look.land_mm = random.between(0.9, 1.4);
  look.wall = random.between(0.15, 0.3);
  look.bore_spread_mm = random.between(0.02, 0.08);
  look.nicked = random.between(0.0, 0.15);
  look.boron = random.chance(0.3) ? random.between(0.0, 0.2) : 0.0;
}

}  // namespace

void draw_plant(const Stratum& stratum, RandomSource& random, Scenario& scenario) {
  TubesheetSettings& sheet = scenario.scene.sheet;
  sheet.missing.clear();
  sheet.plugged.clear();
  scenario.scene.plugs.clear();
  scenario.scene.displaced.clear();
  draw_lattice(stratum, random, sheet);
  draw_voids(random, sheet);
  scenario.told.tubesheet = sheet;
  draw_plugs(random, scenario);
  draw_looks(random, scenario.scene.look);
  // The drawing's bore is that of a gauge, not of the average tube.
  scenario.told.tubesheet.bore_mm += random.normal(0.03);
  scenario.scene.seed = static_cast<std::uint64_t>(random.whole(1, kMostSeed));
}

double pitch_mm(const TubesheetSettings& sheet) {
  // Of the lattices drawn these steps are the shortest.
  const auto [one, other] = core::tubesheet::spanning_steps(sheet.addresses);
  const auto a = core::tubesheet::move_mm(sheet, one);
  const auto b = core::tubesheet::move_mm(sheet, other);
  return std::min(std::hypot(a[0], a[1]), std::hypot(b[0], b[1]));
}

}  // namespace tubesight::board::campaign
