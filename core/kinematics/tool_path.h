#pragma once

#include <array>
#include <cstdint>

#include "core/base/frames.h"
#include "core/base/result.h"
#include "core/base/static_vector.h"
#include "core/base/transform.h"
#include "core/kinematics/speed_profile.h"

namespace tubesight::core::kinematics {

/// Where the tool stands, in the words of a path: the six numbers of T_sheet_tool.
struct ToolPlace {
  double x_mm = 0.0;       ///< tip in the sheet frame
  double y_mm = 0.0;       ///< tip in the sheet frame
  double height_mm = 0.0;  ///< tip below the plane of the tube-ends: the sheet's z is -height_mm
  double alpha_deg = 0.0;  ///< heading; R = Rz(alpha) Ry(beta) Rx(gamma) [Fallon eq. 4.1]
  double beta_deg = 0.0;   ///< lean
  double gamma_deg = 0.0;  ///< lean

  friend constexpr bool operator==(const ToolPlace&, const ToolPlace&) = default;
};

/// T_sheet_tool of a place. Angles within 50,000 degrees.
[[nodiscard]] Transform<frames::Sheet, frames::Tool> transform_of(const ToolPlace& place);

/// What a segment of a path does; each begins where the one before ended and ends at rest.
enum class SegmentKind : std::uint8_t {
  kRest,    ///< stays for a time
  kMove,    ///< moves the tip straight over the sheet to a point
  kHeight,  ///< changes the height
  kDock,    ///< to the dock height, under the point where the tool is: ends square (no lean)
  kTurn,    ///< turns the heading about the guidetube's axis
  kLean,    ///< leans about the tip to beta and gamma
  kJump,    ///< is at another place at once, which no robot can: for faults
};

/// One segment; only the members of its kind are valid.
struct PathSegment {
  SegmentKind kind = SegmentKind::kRest;
  double rest_s = 0.0;               ///< kRest: 0 or more
  std::array<double, 2> to_mm{};     ///< kMove: the point
  double height_mm = 0.0;            ///< kHeight, kDock: the height reached
  double alpha_deg = 0.0;            ///< kTurn: the heading reached, by way of all between
  std::array<double, 2> lean_deg{};  ///< kLean: beta, gamma
  ToolPlace place{};                 ///< kJump
  SpeedShape shape = SpeedShape::kTrapezoid;
  SpeedLimits limits{};  ///< mm for kMove, kHeight, kDock; degrees for kTurn, kLean
};

/// Where a segment ends that begins at `from`.
[[nodiscard]] ToolPlace end_of(const PathSegment& segment, const ToolPlace& from);

/// Where the tool is at an instant and how it moves.
struct ToolState {
  Transform<frames::Sheet, frames::Tool> T_sheet_tool;
  ToolPlace place{};                           ///< the same in numbers
  std::array<double, 3> velocity_mm_s{};       ///< of the tip, sheet frame
  std::array<double, 3> acceleration_mm_s2{};  ///< of the tip, sheet frame
  double speed_mm_s = 0.0;                     ///< magnitude of velocity_mm_s
  std::int32_t segment = -1;                   ///< -1 before the first, size() after the last
};

/// Segments of one path: 250 tubes visited with move, rest, docking, rest and undocking are 1,250.
inline constexpr std::int32_t kMaxPathSegments = 4096;

/// A tool path: segments one after the other. What shakes the tool besides is a fault of the
/// simulated world (drivers/simulated).
///
/// A pure function of time: state_at() may be asked for any instant in any order, by several
/// threads. Only + - x /, square roots and our own sine: the same bits on every machine. Some
/// 700 KB: static or heap, never on a stack.
class ToolPath {
 public:
  /// Forgets everything and begins at `start` at time 0. kInvalidArgument: a number is not finite.
  [[nodiscard]] Result<void> begin(const ToolPlace& start);

  /// Appends a segment. After an error the path is as before.
  ///
  /// Errors: kBufferTooSmall kMaxPathSegments are there, kInvalidArgument a time is negative, a
  /// limit is not above 0 or a number is not finite.
  [[nodiscard]] Result<void> add(const PathSegment& segment);

  [[nodiscard]] std::int32_t size() const { return segments_.size(); }
  [[nodiscard]] double duration_s() const { return duration_s_; }
  /// Start of a segment, 0..size()-1.
  [[nodiscard]] double start_s(std::int32_t segment) const { return segments_[segment].start_s; }

  [[nodiscard]] const ToolPlace& start() const { return start_; }
  /// Where the path ends.
  [[nodiscard]] const ToolPlace& end() const { return end_; }

  /// Where the tool is. At the start before time 0, at the end after duration_s(). At the
  /// instant between two segments, the later one.
  [[nodiscard]] ToolState state_at(double time_s) const;

 private:
  struct Segment {
    double start_s = 0.0;
    double duration_s = 0.0;
    ToolPlace from{};
    ToolPlace to{};
    SpeedProfile profile;  ///< along the way from `from` to `to`; of length 0 for rests and jumps
  };

  [[nodiscard]] std::int32_t segment_at(double time_s) const;

  ToolPlace start_{};
  ToolPlace end_{};
  double duration_s_ = 0.0;
  StaticVector<Segment, kMaxPathSegments> segments_;
};

}  // namespace tubesight::core::kinematics
