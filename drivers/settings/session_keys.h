#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "core/base/settings.h"
#include "core/tubesheet/sheet_places.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/table_keys.h"

namespace tubesight::drivers {

// The tables of a session's settings, for their reader (session_tables.cpp) and their writer
// (session_text.cpp). The limits are wide enough for any plant, narrow enough to catch a wrong unit
// or a slipped point.

inline constexpr WholeRange kSide_px{64, 4096};
inline constexpr WholeRange kCells{16, 16384};           // cells or samples of a line
inline constexpr NumberRange kCell{0.0005, 0.1, " mm"};  // half a micrometre to 100
inline constexpr NumberRange kPicturePlace{0.0, static_cast<double>(kSide_px.most), " px"};
inline constexpr NumberRange kAngle{-360.0, 360.0, " degrees"};
inline constexpr NumberRange kStep{-core::tubesheet::kLongestStep_mm,
                                   core::tubesheet::kLongestStep_mm, " mm"};
inline constexpr WholeRange kAddress{-9999, 9999};
inline constexpr NumberRange kClaimSpan{0.001, 1.0, " s"};  // the last second of fields is kept

// In the order of the enumerators.
inline constexpr std::array<std::string_view, 3> kScanWords = {"even-first", "odd-first",
                                                               "progressive"};
inline constexpr std::array<std::string_view, 2> kWeldWords = {"flush", "fillet"};
inline constexpr std::array<std::string_view, 3> kAddressWords = {"all", "even-sum", "odd-sum"};
/// What an address must have to exist, for messages.
inline constexpr std::array<std::string_view, kAddressWords.size()> kAddressRules = {
    "any", "an even sum of row and column", "an odd sum of row and column"};

/// `[camera]`
inline constexpr std::tuple kCameraKeys{
    WholeKey<core::CameraSettings>{"width_px", kSide_px, &core::CameraSettings::width_px,
                                   Need::kNeeded},
    WholeKey<core::CameraSettings>{"height_px", kSide_px, &core::CameraSettings::height_px,
                                   Need::kNeeded},
    WordKey<core::CameraSettings, core::Scan>{"scan", kScanWords, &core::CameraSettings::scan,
                                              Need::kNeeded},
    NumberKey<core::CameraSettings>{"focal_length_mm",
                                    {0.1, 1000.0, " mm"},
                                    &core::CameraSettings::focal_length_mm,
                                    Need::kNeeded},
    NumberKey<core::CameraSettings>{"cell_width_mm", kCell, &core::CameraSettings::cell_width_mm,
                                    Need::kNeeded},
    NumberKey<core::CameraSettings>{"cell_height_mm", kCell, &core::CameraSettings::cell_height_mm,
                                    Need::kNeeded},
    WholeKey<core::CameraSettings>{"sensor_columns", kCells, &core::CameraSettings::sensor_columns,
                                   Need::kNeeded},
    WholeKey<core::CameraSettings>{"frame_columns", kCells, &core::CameraSettings::frame_columns,
                                   Need::kNeeded},
    NumberKey<core::CameraSettings>{
        "horizontal_scale", {0.5, 2.0, ""}, &core::CameraSettings::horizontal_scale, Need::kNeeded},
    NumbersKey<core::CameraSettings, 2>{"center_px", kPicturePlace,
                                        &core::CameraSettings::center_px, Need::kNeeded},
    NumberKey<core::CameraSettings>{"distortion_per_mm2",
                                    {-10.0, 10.0, " per mm2"},
                                    &core::CameraSettings::distortion_per_mm2,
                                    Need::kNeeded},
    NumberKey<core::CameraSettings>{"distortion2_per_mm4",
                                    {-10.0, 10.0, " per mm4"},
                                    &core::CameraSettings::distortion2_per_mm4},
};

/// `[tool]`
inline constexpr std::tuple kToolKeys{
    NumbersKey<core::ToolSettings, 3>{
        "position_mm", {-1000.0, 1000.0, " mm"}, &core::ToolSettings::position_mm, Need::kNeeded},
    NumbersKey<core::ToolSettings, 3>{"rotation_deg", kAngle, &core::ToolSettings::rotation_deg,
                                      Need::kNeeded},
};

/// `[tubesheet]`, beside the lists below
inline constexpr std::tuple kTubesheetKeys{
    NumbersKey<core::TubesheetSettings, 2>{"origin_mm",
                                           {-kLargestSheet_mm, kLargestSheet_mm, " mm"},
                                           &core::TubesheetSettings::origin_mm},
    NumbersKey<core::TubesheetSettings, 2>{"row_step_mm", kStep,
                                           &core::TubesheetSettings::row_step_mm, Need::kNeeded},
    NumbersKey<core::TubesheetSettings, 2>{"column_step_mm", kStep,
                                           &core::TubesheetSettings::column_step_mm, Need::kNeeded},
    NumberKey<core::TubesheetSettings>{
        "bore_mm", {1.0, 200.0, " mm"}, &core::TubesheetSettings::bore_mm, Need::kNeeded},
    WordKey<core::TubesheetSettings, core::Weld>{"weld", kWeldWords,
                                                 &core::TubesheetSettings::weld},
    WholesKey<core::TubesheetSettings, 2>{"rows", kAddress, &core::TubesheetSettings::rows,
                                          Need::kNeeded},
    WholesKey<core::TubesheetSettings, 2>{"columns", kAddress, &core::TubesheetSettings::columns,
                                          Need::kNeeded},
    WordKey<core::TubesheetSettings, core::AddressParity>{"addresses", kAddressWords,
                                                          &core::TubesheetSettings::addresses},
    NumberKey<core::TubesheetSettings>{
        "odd_row_shift",
        {-core::tubesheet::kLargestShift, core::tubesheet::kLargestShift, " of a column step"},
        &core::TubesheetSettings::odd_row_shift,
        Need::kOptional,
        0.0},
};

/// A list of addresses, `[[row, column], ...]`.
struct AddressesKey {
  std::string_view key;
  core::StaticVector<core::TubeAddress, core::kMaxListedTubes> core::TubesheetSettings::*member;
};
inline constexpr std::array kTubesheetLists = {
    AddressesKey{"missing", &core::TubesheetSettings::missing},
    AddressesKey{"plugged", &core::TubesheetSettings::plugged},
};

/// `row` and `column` of an inline table.
inline constexpr std::tuple kAddressKeys{
    WholeKey<core::TubeAddress>{"row", kAddress, &core::TubeAddress::row, Need::kNeeded},
    WholeKey<core::TubeAddress>{"column", kAddress, &core::TubeAddress::column, Need::kNeeded},
};

/// `[start]`: its clicks are inline tables of an address and a place in the picture.
inline constexpr std::string_view kClicksKey = "tubes";
inline constexpr std::string_view kClickPlaceKey = "at_px";
inline constexpr WholesKey<core::StartSettings, 4> kStartWindowKey{
    "window_px", {0, kSide_px.most - 1}, &core::StartSettings::window_px, Need::kNeeded};
inline constexpr NumbersKey<core::StartSettings, 2> kStartOptimumKey{
    "optimum_px", kPicturePlace, &core::StartSettings::optimum_px};

inline constexpr std::string_view kStartHeadingKey = "heading_deg";

/// `[motion]`
inline constexpr std::array kMotionKeys = {
    NumberKey<core::MotionSettings>{
        "max_speed_mm_s", {1.0, 1600.0, " mm/s"}, &core::MotionSettings::max_speed_mm_s},
    NumberKey<core::MotionSettings>{"max_acceleration_mm_s2",
                                    {1.0, 1000000.0, " mm/s2"},
                                    &core::MotionSettings::max_acceleration_mm_s2},
    NumberKey<core::MotionSettings>{"max_height_speed_mm_s",
                                    {0.0, 1600.0, " mm/s"},
                                    &core::MotionSettings::max_height_speed_mm_s},
    NumberKey<core::MotionSettings>{"max_height_acceleration_mm_s2",
                                    {0.0, 1000000.0, " mm/s2"},
                                    &core::MotionSettings::max_height_acceleration_mm_s2},
    NumberKey<core::MotionSettings>{"max_turn_speed_deg_s",
                                    {1.0, 3600.0, " degrees/s"},
                                    &core::MotionSettings::max_turn_speed_deg_s},
    NumberKey<core::MotionSettings>{"max_turn_acceleration_deg_s2",
                                    {1.0, 100000.0, " degrees/s2"},
                                    &core::MotionSettings::max_turn_acceleration_deg_s2},
    NumberKey<core::MotionSettings>{"max_lean_speed_deg_s",
                                    {1.0, 3600.0, " degrees/s"},
                                    &core::MotionSettings::max_lean_speed_deg_s},
    NumberKey<core::MotionSettings>{"max_lean_acceleration_deg_s2",
                                    {1.0, 100000.0, " degrees/s2"},
                                    &core::MotionSettings::max_lean_acceleration_deg_s2},
};

/// `[edges]`
inline constexpr std::array kEdgeKeys = {
    WholeKey<core::EdgeSettings>{"initial_threshold",
                                 {0, 24 * 255},  // a sum of 24 grey values
                                 &core::EdgeSettings::initial_threshold},
    WholeKey<core::EdgeSettings>{
        "region_threshold", {0, 255}, &core::EdgeSettings::region_threshold},
};

/// `[verification]`
inline constexpr std::array kVerificationKeys = {
    NumberKey<core::VerificationSettings>{
        "aligned_within_mm", {0.1, 50.0, " mm"}, &core::VerificationSettings::aligned_within_mm},
    NumberKey<core::VerificationSettings>{"claim_within_s", kClaimSpan,
                                          &core::VerificationSettings::claim_within_s},
    NumberKey<core::VerificationSettings>{"claim_oldest_s", kClaimSpan,
                                          &core::VerificationSettings::claim_oldest_s},
};

}  // namespace tubesight::drivers
