#pragma once

#include <array>
#include <cstdint>

#include "core/base/field.h"
#include "core/base/tube_address.h"

namespace tubesight::core {

/// How far the box knows where it is; the column `state`.
enum class TrackState : std::uint8_t {
  kWaiting,   ///< no start yet
  kTracking,  ///< known from this field
  kDegraded,  ///< an answer that needs care: coasting, two tubes left
  kLost,      ///< ends only by a new start
};

/// Why the state is not tracking; the column `reason`. docs/messages.md explains each.
enum class Reason : std::uint8_t {
  kNone,
  kNoStart,       ///< waiting: nobody has named tubes yet
  kStartRefused,  ///< waiting: the clicks contradict the lattice or the picture
  kFewTubes,      ///< degraded: two tube-ends left
  kDark,          ///< coasting: the picture shows no light
  kWashedOut,     ///< coasting: the picture is saturated
  kNoTubes,       ///< there is light and no tube-end where the motion says they are
  kDamagedField,  ///< coasting: the field's pixels are not to be used
  kUncertain,     ///< degraded: the picture determines the tool's place to over 0.75 mm only
  kCoasted,       ///< lost: the region the tool can have reached grew too large
  kJump,          ///< the picture contradicts any motion within the limits
  kSpeed,         ///< lost: faster than the limits of [motion]
  kGap,           ///< lost: too many fields are missing
  kTime,          ///< lost: time ran backwards
  kSequence,      ///< lost: the counter of the fields went back
  kRate,          ///< lost: fields come too seldom for [motion] and the pitch
  kFieldOrder,    ///< lost: the fields of a frame come in another order than the settings say
  kArithmetic,    ///< lost: a number left the range of the fixed-point format
  kNoField,       ///< coasting: no field came in time
  kMap,           ///< lost: plugs or places without a tube look like open tube-ends
  kNotLive,       ///< lost: the picture does not follow the lamp
};
inline constexpr Reason kLastReason = Reason::kNotLive;  ///< of the list

/// Whether the picture is known to be live; the column `liveness`.
enum class Liveness : std::uint8_t {
  kUnknown,  ///< nothing has shown it
  kProved,   ///< the picture follows what the box does to the lamp
  kFailed,   ///< it does not
};

/// A position in full-frame pixels, in 1/65536 px: the same bits on every machine.
struct ImagePoint {
  std::int32_t u_q16 = 0;
  std::int32_t v_q16 = 0;
};

/// The box's answer for one field; a row of `--fields`.
///
/// Numbers are integers of stated scale, so that files printed from them agree to the byte.
struct Sighting {
  FieldTime time{0};        ///< mid-exposure; of a missing field, when it was given up
  std::int64_t field = -1;  ///< number of the field
  FieldStatus status = FieldStatus::kMissing;
  bool judged = false;  ///< tube-ends of this very field were measured and believed
  /// Fields judged since the session began. It grows with them alone: whoever sees it stand still
  /// for two field times knows that the box sees nothing new, whatever else it says.
  std::int64_t judged_fields = 0;
  FieldTime age{0};  ///< since the field that was judged last; 0 before the first
  TrackState state = TrackState::kWaiting;
  Reason reason = Reason::kNoStart;
  std::int32_t tracked = 0;  ///< tube-ends measured in this field and used

  bool primary_known = false;
  TubeAddress primary{};    ///< the tube-end nearest to the optimum point
  ImagePoint primary_px{};  ///< its centre

  bool axis_known = false;        ///< the members below are valid
  ImagePoint axis_px{};           ///< image of the point where the guidetube's axis meets the sheet
  std::int32_t height_um_q8 = 0;  ///< tip below the plane of the tube-ends, 1/256 um

  bool tool_known = false;        ///< `tool` stands there and is the nearest beyond doubt
  TubeAddress tool{};             ///< the tube nearest to the guidetube's axis
  ImagePoint tool_px{};           ///< image of that tube's centre
  std::int32_t offset_um_q8 = 0;  ///< its distance from the axis, 1/256 um
  std::array<std::int32_t, 2> displacement_um_q8{};  ///< from its centre to the axis, sheet x, y
  bool aligned = false;                              ///< the box vouches for `tool`

  bool velocity_known = false;
  std::array<std::int32_t, 2> velocity_um_s{};  ///< of the axis over the sheet, sheet x and y
  std::int32_t velocity_span_us = 0;            ///< between the fields that it is the mean of

  bool margin_known = false;
  std::int32_t margin_permyriad = 0;  ///< distance from the rounding limit in sigma, 1/10000

  std::int32_t residual_px_q16 = 0;  ///< RMS of the tube-ends used, 1/65536 px; valid when judged
  Liveness liveness = Liveness::kUnknown;
};

/// Everything known about one measured tube-end; a row of `--centers`.
struct TubeSighting {
  TubeAddress address;
  ImagePoint center_px;                ///< image of the tube-end's centre
  std::int32_t quality_permyriad = 0;  ///< 0..10000; 0: measured but rejected from the fit
  bool plug = false;                   ///< recognised as a plug
  std::int32_t contrast_q4 = 0;        ///< from its dark inside to its bright rim, 1/16 grey level
};

/// Tube-ends that a field can yield: a 640 by 480 picture of the smallest pitch (17 mm at 200 mm
/// distance) shows some 60 of 16 px height or more inside a full-frame window.
inline constexpr std::int32_t kMaxTubesInView = 96;

}  // namespace tubesight::core
