#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "core/base/names.h"
#include "core/kinematics/tool_path.h"
#include "core/rendering/scene_ranges.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/table_keys.h"
#include "drivers/simulated/fault.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::drivers {

// The tables of a scenario beside those of a session (drivers/settings/session_keys.h), for their
// readers (scenario_file.cpp, _scene, _path, _events, _faults) and their writer
// (scenario_text.cpp).

using core::rendering::GuidetubeLook;
using core::rendering::kGuidetubeLookRanges;
using core::rendering::kLampLookRanges;
using core::rendering::kSensorLookRanges;
using core::rendering::kSheetLookRanges;
using core::rendering::LampLook;
using core::rendering::LookRange;
using core::rendering::SensorLook;
using core::rendering::SheetLook;
using drivers::Need;
using drivers::NumberKey;
using drivers::NumberRange;
using drivers::NumbersKey;
using drivers::SwitchKey;
using drivers::WholeKey;
using drivers::WordKey;

/// The key of a number of a look, within the renderer's range; one without is no constant and does
/// not compile.
template <typename Look, std::size_t N>
consteval NumberKey<Look> look_key(std::string_view key,
                                   const std::array<LookRange<Look>, N>& ranges,
                                   double Look::*member, const char* unit) {
  std::size_t at = 0;
  while (ranges[at].member != member) {
    ++at;
  }
  return {key, {ranges[at].least, ranges[at].most, unit}, member};
}

/// `[scenario]`
inline constexpr std::string_view kTitleKey = "title";
inline constexpr std::string_view kSeedKey = "seed";
inline constexpr std::string_view kSheetSeedKey = "sheet_seed";

/// `[look]`
inline constexpr std::array kSheetLookKeys = {
    look_key("plate", kSheetLookRanges, &SheetLook::plate, ""),
    look_key("gloss", kSheetLookRanges, &SheetLook::gloss, ""),
    look_key("texture", kSheetLookRanges, &SheetLook::texture, ""),
    look_key("stains", kSheetLookRanges, &SheetLook::stains, ""),
    look_key("weld", kSheetLookRanges, &SheetLook::weld, ""),
    look_key("weld_mm", kSheetLookRanges, &SheetLook::weld_mm, " mm"),
    look_key("fillet_mm", kSheetLookRanges, &SheetLook::fillet_mm, " mm"),
    look_key("fillet_height_mm", kSheetLookRanges, &SheetLook::fillet_height_mm, " mm"),
    look_key("land_mm", kSheetLookRanges, &SheetLook::land_mm, " mm"),
    look_key("wall", kSheetLookRanges, &SheetLook::wall, ""),
    look_key("bore_spread_mm", kSheetLookRanges, &SheetLook::bore_spread_mm, " mm"),
    look_key("nicked", kSheetLookRanges, &SheetLook::nicked, ""),
    look_key("nick_mm", kSheetLookRanges, &SheetLook::nick_mm, " mm"),
    look_key("boron", kSheetLookRanges, &SheetLook::boron, ""),
    look_key("plug", kSheetLookRanges, &SheetLook::plug, ""),
    look_key("plug_hole", kSheetLookRanges, &SheetLook::plug_hole, ""),
    look_key("plug_height_mm", kSheetLookRanges, &SheetLook::plug_height_mm, " mm"),
};

/// `[lamp]`, after kLightKeys
inline constexpr std::array kLampLookKeys = {
    look_key("ring_radius_mm", kLampLookRanges, &LampLook::ring_radius_mm, " mm"),
    look_key("below_tip_mm", kLampLookRanges, &LampLook::below_tip_mm, " mm"),
    look_key("strength", kLampLookRanges, &LampLook::strength, ""),
    look_key("tilt_deg", kLampLookRanges, &LampLook::tilt_deg, " degrees"),
    look_key("beam", kLampLookRanges, &LampLook::beam, ""),
    look_key("ambient", kLampLookRanges, &LampLook::ambient, ""),
    look_key("led_radius_mm", kLampLookRanges, &LampLook::led_radius_mm, " mm"),
    look_key("led_strength", kLampLookRanges, &LampLook::led_strength, ""),
};

/// `[sensor]`
inline constexpr std::array kSensorLookKeys = {
    look_key("blur_px", kSensorLookRanges, &SensorLook::blur_px, " px"),
    look_key("vignetting", kSensorLookRanges, &SensorLook::vignetting, ""),
    look_key("veil", kSensorLookRanges, &SensorLook::veil, ""),
    look_key("blooming", kSensorLookRanges, &SensorLook::blooming, ""),
    look_key("blooming_px", kSensorLookRanges, &SensorLook::blooming_px, " px"),
    look_key("gain", kSensorLookRanges, &SensorLook::gain, ""),
    look_key("offset", kSensorLookRanges, &SensorLook::offset, ""),
    look_key("saturation", kSensorLookRanges, &SensorLook::saturation, ""),
    look_key("shot_noise", kSensorLookRanges, &SensorLook::shot_noise, ""),
    look_key("read_noise", kSensorLookRanges, &SensorLook::read_noise, ""),
    look_key("emi_share", kSensorLookRanges, &SensorLook::emi_share, ""),
    look_key("emi_amplitude", kSensorLookRanges, &SensorLook::emi_amplitude, ""),
    look_key("salt_and_pepper", kSensorLookRanges, &SensorLook::salt_and_pepper, ""),
};

/// `[guidetube]`
inline constexpr std::array kGuidetubeLookKeys = {
    look_key("radius_mm", kGuidetubeLookRanges, &GuidetubeLook::radius_mm, " mm"),
    look_key("length_mm", kGuidetubeLookRanges, &GuidetubeLook::length_mm, " mm"),
    look_key("reflectance", kGuidetubeLookRanges, &GuidetubeLook::reflectance, ""),
    look_key("shadow", kGuidetubeLookRanges, &GuidetubeLook::shadow, ""),
};

/// `[lamp]`, before kLampLookKeys
inline constexpr std::tuple kLightKeys{
    WholeKey<drivers::SimulatedLight>{
        "lamp_permille", {0, 1000}, &drivers::SimulatedLight::lamp_permille},
    NumberKey<drivers::SimulatedLight>{
        "pwm_hz", {0.0, 100000.0, " Hz"}, &drivers::SimulatedLight::pwm_hz},
    NumberKey<drivers::SimulatedLight>{"lag_s", {0.0, 60.0, " s"}, &drivers::SimulatedLight::lag_s},
    NumberKey<drivers::SimulatedLight>{"ring", {0.0, 1.0, ""}, &drivers::SimulatedLight::ring},
};

/// `[calibration_error]`: true minus told.
struct CalibrationError {
  std::array<double, 3> tool_position_mm{};
  std::array<double, 3> tool_rotation_deg{};
  double focal_length_mm = 0.0;
  std::array<double, 2> center_px{};
  double horizontal_scale = 0.0;
  double distortion_per_mm2 = 0.0;
  double pitch_share = 0.0;  ///< both steps are longer by this share
  double bore_mm = 0.0;
};
inline constexpr std::tuple kCalibrationErrorKeys{
    NumbersKey<CalibrationError, 3>{
        "tool_position_mm", {-20.0, 20.0, " mm"}, &CalibrationError::tool_position_mm},
    NumbersKey<CalibrationError, 3>{
        "tool_rotation_deg", {-5.0, 5.0, " degrees"}, &CalibrationError::tool_rotation_deg},
    NumberKey<CalibrationError>{
        "focal_length_mm", {-1.0, 1.0, " mm"}, &CalibrationError::focal_length_mm},
    NumbersKey<CalibrationError, 2>{
        "center_px", {-50.0, 50.0, " px"}, &CalibrationError::center_px},
    NumberKey<CalibrationError>{
        "horizontal_scale", {-0.1, 0.1, ""}, &CalibrationError::horizontal_scale},
    NumberKey<CalibrationError>{
        "distortion_per_mm2", {-0.05, 0.05, " per mm2"}, &CalibrationError::distortion_per_mm2},
    NumberKey<CalibrationError>{
        "pitch_share", {-0.02, 0.02, ""}, &CalibrationError::pitch_share, Need::kOptional, 0.0},
    NumberKey<CalibrationError>{"bore_mm", {-2.0, 2.0, " mm"}, &CalibrationError::bore_mm},
};

/// `[sheet]`
inline constexpr std::string_view kVoidsKey = "voids";
inline constexpr std::string_view kDisplacedKey = "displaced";
struct PlugsKey {
  std::string_view key;
  core::rendering::PlugKind kind;
};
inline constexpr std::array kPlugsKeys = {
    PlugsKey{"rolled", core::rendering::PlugKind::kRolled},
    PlugsKey{"flush", core::rendering::PlugKind::kFlush},
};
/// An entry of `displaced`, after `row` and `column`
inline constexpr std::tuple kDisplacementKeys{
    NumbersKey<core::rendering::DisplacedTube, 3>{
        "by_mm", {-10.0, 10.0, " mm"}, &core::rendering::DisplacedTube::by_mm, Need::kNeeded},
};

/// `[video]`, after the rate
inline constexpr double kLongest_s = 86400.0;
inline constexpr std::string_view kRateKey = "rate_hz";
inline constexpr std::tuple kVideoKeys{
    NumberKey<drivers::SimulatedVideo>{
        "exposure_s", {0.0, 1.0, " s"}, &drivers::SimulatedVideo::exposure_s},
    NumberKey<drivers::SimulatedVideo>{
        "length_s", {0.0, kLongest_s, " s"}, &drivers::SimulatedVideo::length_s},
    WholeKey<drivers::SimulatedVideo>{"window_margin_px",
                                      {0, 4096},
                                      &drivers::SimulatedVideo::window_margin_px,
                                      Need::kOptional,
                                      -1},
};

/// `[path]` and `[[step]]`: places and motions
inline constexpr NumberRange kPathPlace{-drivers::kLargestSheet_mm, drivers::kLargestSheet_mm,
                                        " mm"};
inline constexpr NumberRange kHeight{0.0, 300.0, " mm"};
inline constexpr NumberRange kHeading{-360.0, 360.0, " degrees"};
inline constexpr NumberRange kLean{-10.0, 10.0, " degrees"};
inline constexpr NumberRange kRest{0.0, kLongest_s, " s"};
inline constexpr std::string_view kPlaceKey = "at_mm";
inline constexpr std::string_view kLeanKey = "lean_deg";
inline constexpr std::tuple kFromKeys{
    NumberKey<core::kinematics::ToolPlace>{"height_mm", kHeight,
                                           &core::kinematics::ToolPlace::height_mm},
    NumberKey<core::kinematics::ToolPlace>{"heading_deg", kHeading,
                                           &core::kinematics::ToolPlace::alpha_deg},
};
inline constexpr NumberKey<core::kinematics::PathSegment> kStepRest{
    "rest_s", kRest, &core::kinematics::PathSegment::rest_s, Need::kNeeded};
inline constexpr NumbersKey<core::kinematics::PathSegment, 2> kStepTo{
    "to_mm", kPathPlace, &core::kinematics::PathSegment::to_mm, Need::kNeeded};
inline constexpr NumberKey<core::kinematics::PathSegment> kStepHeight{
    "height_mm", kHeight, &core::kinematics::PathSegment::height_mm, Need::kNeeded};
inline constexpr NumberKey<core::kinematics::PathSegment> kStepDock{
    "dock_mm", kHeight, &core::kinematics::PathSegment::height_mm, Need::kNeeded};
inline constexpr NumberKey<core::kinematics::PathSegment> kStepHeading{
    "heading_deg", kHeading, &core::kinematics::PathSegment::alpha_deg, Need::kNeeded};
inline constexpr NumbersKey<core::kinematics::PathSegment, 2> kStepLean{
    kLeanKey, kLean, &core::kinematics::PathSegment::lean_deg, Need::kNeeded};

/// How a step moves.
inline constexpr std::array<std::string_view, 2> kProfileWords = {"trapezoid", "s-curve"};
inline constexpr std::string_view kProfileKey = "profile";
inline constexpr std::array kMoveKeys = {
    NumberKey<core::kinematics::SpeedLimits>{
        "speed_mm_s", {0.1, 5000.0, " mm/s"}, &core::kinematics::SpeedLimits::speed},
    NumberKey<core::kinematics::SpeedLimits>{"acceleration_mm_s2",
                                             {1.0, 1000000.0, " mm/s2"},
                                             &core::kinematics::SpeedLimits::acceleration},
    NumberKey<core::kinematics::SpeedLimits>{
        "jerk_mm_s3", {1.0, 1e9, " mm/s3"}, &core::kinematics::SpeedLimits::jerk},
};
inline constexpr std::array kTurnKeys = {
    NumberKey<core::kinematics::SpeedLimits>{
        "speed_deg_s", {0.01, 3600.0, " deg/s"}, &core::kinematics::SpeedLimits::speed},
    NumberKey<core::kinematics::SpeedLimits>{"acceleration_deg_s2",
                                             {0.01, 1e6, " deg/s2"},
                                             &core::kinematics::SpeedLimits::acceleration},
    NumberKey<core::kinematics::SpeedLimits>{
        "jerk_deg_s3", {0.01, 1e9, " deg/s3"}, &core::kinematics::SpeedLimits::jerk},
};

/// Wishes for clicks, which become clicks when they are read: in `[start]` and starts.
inline constexpr std::string_view kClickOnKey = "click_on";
inline constexpr std::string_view kOffCenterKey = "off_center";

/// `[[event]]`: the words of those that reach the box from outside.
enum class ToldKind : std::uint8_t { kClaim, kStart, kLamp, kPose, kPick, kAcknowledge };
inline constexpr std::array<std::string_view, 6> kEventWords = {"claim", "start", "lamp",
                                                                "pose",  "pick",  "acknowledge"};
inline constexpr NumberKey<drivers::ScenarioEvent> kEventTime{
    "at_s", {0.0, kLongest_s, " s"}, &drivers::ScenarioEvent::at_s, Need::kNeeded};
inline constexpr std::string_view kEventKindKey = "kind";
inline constexpr std::string_view kClaimedTubeKey = "tube";
inline constexpr WholeKey<core::LampCommand> kLampCommandKey{
    "lamp_permille", {0, 1000}, &core::LampCommand::permille, Need::kNeeded};
inline constexpr NumbersKey<core::Pick, 2> kPickPlaceKey{
    "at_px", {0.0, 4096.0, " px"}, &core::Pick::at_px, Need::kNeeded};

/// `[expect]`: the words of states and reasons are those of the tables of fields.
inline constexpr std::array kStateWords = {
    core::name_of(core::TrackState::kWaiting), core::name_of(core::TrackState::kTracking),
    core::name_of(core::TrackState::kDegraded), core::name_of(core::TrackState::kLost)};
inline constexpr auto kReasonWords = [] {
  std::array<std::string_view, static_cast<std::size_t>(core::count_of<core::Reason>())> words{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = core::name_of(static_cast<core::Reason>(i));
  }
  return words;
}();
inline constexpr drivers::WholeRange kCounted{0, 10000};
inline constexpr std::tuple kExpectationKeys{
    NumberKey<Expectation>{"answered", {0.0, 1.0, ""}, &Expectation::answered},
    NumberKey<Expectation>{"missed", {0.0, 1.0, ""}, &Expectation::missed},
    WordKey<Expectation, core::TrackState>{"end", kStateWords, &Expectation::end},
    WordKey<Expectation, core::Reason>{"lost", kReasonWords, &Expectation::lost},
    WordKey<Expectation, core::Reason>{"degraded", kReasonWords, &Expectation::degraded},
    WholeKey<Expectation>{"false_aligned", kCounted, &Expectation::false_aligned},
    WholeKey<Expectation>{"contradicted", kCounted, &Expectation::contradicted},
    WholeKey<Expectation>{"confirmed", kCounted, &Expectation::confirmed},
    WholeKey<Expectation>{"tubes", kCounted, &Expectation::tubes},
    SwitchKey<Expectation>{"undetectable", &Expectation::undetectable},
};

}  // namespace tubesight::drivers
