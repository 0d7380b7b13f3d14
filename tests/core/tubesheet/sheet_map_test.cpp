#include "core/tubesheet/sheet_map.h"

#include <memory>

#include <gtest/gtest.h>

namespace tubesight::core::tubesheet {
namespace {

// Maps and settings hold 260 KB each: on the heap.
std::unique_ptr<TubesheetSettings> sheet() {
  auto settings = std::make_unique<TubesheetSettings>();
  settings->rows = {-2, 10};
  settings->columns = {0, 20};
  return settings;
}

std::unique_ptr<SheetMap> map_of(const TubesheetSettings& settings) {
  auto map = std::make_unique<SheetMap>();
  EXPECT_TRUE(map->assign(settings).has_value());
  return map;
}

TEST(SheetMap, IsOpenWithinItsExtentAlone) {
  const auto map = map_of(*sheet());
  EXPECT_EQ(map->state({-2, 0}), TubeState::kOpen);
  EXPECT_EQ(map->state({10, 20}), TubeState::kOpen);
  EXPECT_EQ(map->state({-3, 0}), TubeState::kAbsent);
  EXPECT_EQ(map->state({11, 20}), TubeState::kAbsent);
  EXPECT_EQ(map->state({5, -1}), TubeState::kAbsent);
  EXPECT_EQ(map->state({5, 21}), TubeState::kAbsent);
  EXPECT_EQ(map->state({2147483647, 2147483647}), TubeState::kAbsent);
  EXPECT_EQ(map->state({-2147483647 - 1, -2147483647 - 1}), TubeState::kAbsent);
}

TEST(SheetMap, KnowsListedTubesInAnyOrder) {
  auto settings = sheet();
  for (const TubeAddress address : {TubeAddress{9, 3}, TubeAddress{-1, 7}, TubeAddress{4, 4}}) {
    ASSERT_TRUE(settings->missing.try_push_back(address));
  }
  for (const TubeAddress address : {TubeAddress{5, 5}, TubeAddress{0, 0}, TubeAddress{4, 4}}) {
    ASSERT_TRUE(settings->plugged.try_push_back(address));
  }
  const auto map = map_of(*settings);
  int absent = 0;
  int plugged = 0;
  for (int row = -2; row <= 10; ++row) {
    for (int column = 0; column <= 20; ++column) {
      absent += map->state({row, column}) == TubeState::kAbsent ? 1 : 0;
      plugged += map->state({row, column}) == TubeState::kPlugged ? 1 : 0;
    }
  }
  EXPECT_EQ(map->state({9, 3}), TubeState::kAbsent);
  EXPECT_EQ(map->state({-1, 7}), TubeState::kAbsent);
  EXPECT_EQ(map->state({5, 5}), TubeState::kPlugged);
  EXPECT_EQ(map->state({0, 0}), TubeState::kPlugged);
  EXPECT_EQ(map->state({4, 4}), TubeState::kAbsent) << "a void has no plug";
  EXPECT_EQ(absent, 3);
  EXPECT_EQ(plugged, 2);
}

TEST(SheetMap, LeavesOutEveryOtherAddress) {
  auto settings = sheet();
  settings->addresses = AddressParity::kEvenSum;
  const auto even = map_of(*settings);
  settings->addresses = AddressParity::kOddSum;
  const auto odd = map_of(*settings);
  for (const TubeAddress address : {TubeAddress{0, 0}, TubeAddress{1, 1}, TubeAddress{-1, 3}}) {
    EXPECT_EQ(even->state(address), TubeState::kOpen) << address.row;
    EXPECT_EQ(odd->state(address), TubeState::kAbsent) << address.row;
  }
  for (const TubeAddress address : {TubeAddress{0, 1}, TubeAddress{-1, 0}, TubeAddress{-2, 3}}) {
    EXPECT_EQ(even->state(address), TubeState::kAbsent) << address.row;
    EXPECT_EQ(odd->state(address), TubeState::kOpen) << address.row;
  }
}

TEST(SheetMap, HoldsFullLists) {
  auto settings = sheet();
  settings->rows = {0, 127};
  settings->columns = {0, 255};
  for (int i = 0; i < kMaxListedTubes; ++i) {
    ASSERT_TRUE(settings->missing.try_push_back({127 - i / 128, i % 128}));
  }
  ASSERT_TRUE(settings->missing.full());
  const auto map = map_of(*settings);
  EXPECT_EQ(map->state({0, 0}), TubeState::kAbsent);
  EXPECT_EQ(map->state({127, 127}), TubeState::kAbsent);
  EXPECT_EQ(map->state({64, 128}), TubeState::kOpen);
}

TEST(SheetMap, RefusesReversedExtents) {
  auto settings = sheet();
  auto map = std::make_unique<SheetMap>();
  settings->rows = {3, 2};
  Result<void> result = map->assign(*settings);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error(), Error::kInvalidArgument);
  settings = sheet();
  settings->columns = {0, -1};
  result = map->assign(*settings);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error(), Error::kInvalidArgument);
  settings->columns = {4, 4};
  EXPECT_TRUE(map->assign(*settings).has_value()) << "one column is a sheet";
}

TEST(SheetMap, ForgetsTheSheetBefore) {
  auto settings = sheet();
  ASSERT_TRUE(settings->plugged.try_push_back({1, 1}));
  const auto map = map_of(*settings);
  EXPECT_EQ(map->state({1, 1}), TubeState::kPlugged);
  EXPECT_TRUE(map->assign(*sheet()).has_value());
  EXPECT_EQ(map->state({1, 1}), TubeState::kOpen);
}

}  // namespace
}  // namespace tubesight::core::tubesheet
