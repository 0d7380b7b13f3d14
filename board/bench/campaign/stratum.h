#pragma once

#include <cstdint>
#include <string>

namespace tubesight::board::campaign {

/// How the tube-ends are laid out.
enum class Pitch : std::uint8_t { kSquare, kTriangular };
/// How the camera is turned about its optical axis [Fallon 6.4].
enum class Mounting : std::uint8_t { kUpright, kTurned };
/// How the tube-ends are welded.
enum class WeldKind : std::uint8_t { kFlush, kFillet };
/// What goes wrong in a move; random_fault.cpp tells the kinds of each.
enum class FaultGroup : std::uint8_t {
  kNone,
  kStream,     ///< fields dropped, repeated, torn, in the wrong order; a cut in time
  kPicture,    ///< black, saturated or noise
  kLamp,       ///< the lamp fails or drifts, single lamps are dead
  kMechanics,  ///< the camera knocked loose, bursts of vibration
  kJump,       ///< the sheet moves by lattice steps from one field to the next, a part of the path
               ///< is left out, or the tool stands off at once
};
/// How fast the tool moves.
enum class SpeedBand : std::uint8_t {
  kSlow,  ///< 30 to 150 mm/s
  kFast,  ///< 150 mm/s to the limit of [motion], 1000 mm/s at most
};

inline constexpr std::int32_t kFaultGroups = 6;
inline constexpr std::int32_t kSpeedBands = 2;
/// All combinations. Each gets every 96th move, 1.04 % of them.
inline constexpr std::int32_t kStrata = 2 * 2 * 2 * kFaultGroups * kSpeedBands;

/// A kind of move. Moves are spread evenly over all kinds.
struct Stratum {
  Pitch pitch = Pitch::kSquare;
  Mounting mounting = Mounting::kUpright;
  WeldKind weld = WeldKind::kFlush;
  FaultGroup fault = FaultGroup::kNone;
  SpeedBand speed = SpeedBand::kSlow;

  friend bool operator==(const Stratum&, const Stratum&) = default;
};

/// The kind with a number from 0 to kStrata - 1.
[[nodiscard]] Stratum stratum_at(std::int32_t index);

/// The number of the kind of a move: move number modulo kStrata.
[[nodiscard]] std::int32_t stratum_of_move(std::int64_t move);

/// In files: "square/upright/flush/none/slow".
[[nodiscard]] std::string name_of(const Stratum& stratum);

/// The number that belongs to a name; -1 for what is none.
[[nodiscard]] std::int32_t find_stratum(const std::string& name);

}  // namespace tubesight::board::campaign
