#pragma once

#include <array>
#include <cstdint>

#include "core/base/image_view.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core {

/// How a camera delivers its lines.
enum class Scan : std::uint8_t { kEvenFirst, kOddFirst, kProgressive };

/// Which lines the earlier or the later field of a frame has.
[[nodiscard]] constexpr Parity parity_of(Scan scan, bool later) {
  if (scan == Scan::kProgressive) {
    return Parity::kProgressive;
  }
  return (scan == Scan::kOddFirst) != later ? Parity::kOdd : Parity::kEven;
}

/// Internal parameters of the camera [Fallon eq. 4.5-4.9]; the table `[camera]`.
struct CameraSettings {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  Scan scan = Scan::kEvenFirst;
  double focal_length_mm = 0.0;       ///< EFL
  double cell_width_mm = 0.0;         ///< dx
  double cell_height_mm = 0.0;        ///< dy
  std::int32_t sensor_columns = 0;    ///< N_cx
  std::int32_t frame_columns = 0;     ///< N_fx
  double horizontal_scale = 1.0;      ///< h_sx
  std::array<double, 2> center_px{};  ///< (c_u, c_v)
  double distortion_per_mm2 = 0.0;    ///< k
  double distortion2_per_mm4 = 0.0;   ///< k2
};

/// T_camera_tool from the tool calibration; the table `[tool]`.
struct ToolSettings {
  std::array<double, 3> position_mm{};   ///< tip of the guidetube in the camera frame
  std::array<double, 3> rotation_deg{};  ///< alpha, beta, gamma: R = Rz(alpha) Ry(beta) Rx(gamma)
};

/// How tube-ends are welded to the sheet.
enum class Weld : std::uint8_t { kFlush, kFillet };

/// Which addresses of the lattice exist at all.
enum class AddressParity : std::uint8_t { kAll, kEvenSum, kOddSum };

/// Addresses that a tubesheet may list as missing or plugged. A large sheet (130 by 130 positions
/// in a round outline) leaves out some 3,600 corner positions; this is over four times as many.
inline constexpr std::int32_t kMaxListedTubes = 16384;

/// The tubesheet; the table `[tubesheet]`.
struct TubesheetSettings {
  std::array<double, 2> origin_mm{};       ///< centre of tube (0, 0), present or not, sheet frame
  std::array<double, 2> row_step_mm{};     ///< from a tube to that of the next row
  std::array<double, 2> column_step_mm{};  ///< from a tube to that of the next column
  double bore_mm = 0.0;                    ///< inside diameter of a tube-end
  Weld weld = Weld::kFlush;
  std::array<std::int32_t, 2> rows{};     ///< first and last, inclusive
  std::array<std::int32_t, 2> columns{};  ///< first and last, inclusive
  AddressParity addresses = AddressParity::kAll;
  double odd_row_shift = 0.0;  ///< rows of odd number stand this share of a column step further
  StaticVector<TubeAddress, kMaxListedTubes> missing;
  StaticVector<TubeAddress, kMaxListedTubes> plugged;
};

/// An operator's click inside the dark of a tube-end, with the address that he gives it.
struct StartPoint {
  TubeAddress address;
  std::array<double, 2> at_px{};  ///< full-frame pixels
};

/// Clicks in one start; three are needed.
inline constexpr std::int32_t kMaxStartPoints = 8;

/// The operator's start; the table `[start]`.
struct StartSettings {
  StaticVector<StartPoint, kMaxStartPoints> tubes;
  std::array<std::int32_t, 4> window_px{};  ///< left, top, right, bottom, inclusive
  std::array<double, 2> optimum_px{};       ///< where the light is best
};

/// What the robot can do; the table `[motion]`.
struct MotionSettings {
  double max_speed_mm_s = 300.0;
  double max_acceleration_mm_s2 = 3000.0;
  // Of the height; zero: as over the sheet.
  double max_height_speed_mm_s = 0.0;
  double max_height_acceleration_mm_s2 = 0.0;
  // Of the heading.
  double max_turn_speed_deg_s = 360.0;
  double max_turn_acceleration_deg_s2 = 1500.0;
  // Of the lean, in any direction.
  double max_lean_speed_deg_s = 30.0;
  double max_lean_acceleration_deg_s2 = 1000.0;
};

/// Start values of the dynamic thresholds; the table `[edges]`. Zero: the program's own.
struct EdgeSettings {
  std::int32_t initial_threshold = 200;  ///< sum of 24 grey values' differences [Fallon eq. 6.1]
  std::int32_t region_threshold = 0;     ///< mean grey value of the 16-pixel cross-hair
};

/// The alignment gate and the instants of claims; the table `[verification]`.
struct VerificationSettings {
  double aligned_within_mm = 2.5;
  double claim_within_s = 0.05;  ///< longest way in time from a claim to the field it is judged by
  double claim_oldest_s = 0.25;  ///< age beyond which a claim is answered "unknown"
};

/// Everything that a session is started with. About 260 KB: static or heap, never on a stack.
struct SessionSettings {
  CameraSettings camera;
  ToolSettings tool;
  TubesheetSettings tubesheet;
  StartSettings start;
  MotionSettings motion;
  EdgeSettings edges;
  VerificationSettings verification;
};

}  // namespace tubesight::core
