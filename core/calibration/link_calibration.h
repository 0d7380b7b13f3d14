#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/calibration/base_pairs.h"
#include "core/calibration/dense_normal.h"
#include "core/kinematics/serial_arm.h"

namespace tubesight::core::calibration {

/// Numbers of a link in the order of LinkNumbers: a and d in mm, twist and the joint's zero in rad.
inline constexpr std::int32_t kLinkNumbers = 4;
/// Of all links, and the tool's tip in the frame behind the last joint.
inline constexpr std::int32_t kArmNumbers = kLinkNumbers * kinematics::kMaxJoints + 3;

/// The joints' angles of pairs, in their order.
using PairJoints = StaticVector<kinematics::JointVector, kMaxPairs>;

/// How far an arm's numbers are from those on paper, one sigma: what is expected beforehand, twice
/// what arms measured part by part have [docs/kinematics.md].
struct LinkExpectation {
  double length_mm = 0.4;
  double twist_rad = 4e-4;
  double zero_rad = 7e-4;
  double tool_mm = 0.6;
  double place_mm = 0.2;   ///< of a pair beside its own sigma: play, and what gives way
  double turn_rad = 5e-4;  ///< the same, of its rotation
};

/// Why pairs carry no link parameters.
enum class LinkRefusal : std::uint8_t {
  kNone,
  kTooFew,         ///< fewer pairs in use than 12
  kForeignJoints,  ///< the arm at these angles is not where the robot says: another arm, or order
  kNoBetter,       ///< half of the pairs, fitted, tell the other half no better than the base alone
};

struct LinkCalibration {
  LinkRefusal refusal = LinkRefusal::kNone;
  /// Joints that move by less than 20 degrees: their numbers stay about as expected.
  std::array<bool, static_cast<std::size_t>(kinematics::kMaxJoints)> standing{};
  std::int32_t pair = 0;      ///< kForeignJoints: the first such, index into the pairs
  kinematics::SerialArm arm;  ///< with the numbers found
  BasePose pose;
  /// True less given, and one sigma: the links' numbers one link after the other, then the tip.
  std::array<double, kArmNumbers> values{};
  std::array<double, kArmNumbers> sigmas{};
  std::array<double, kArmNumbers> expected{};  ///< one sigma beforehand
  std::int32_t count = 0;                      ///< of them
  double base_alone_mm = 0.0;                  ///< misses of a half by the other, RMS of a place
  double with_links_mm = 0.0;
};

/// How far one pair's place, by vision, is from where the other half of the pairs foretells it,
/// sheet frame.
struct LinkMiss {
  std::int32_t pair = 0;  ///< index into the pairs
  Eigen::Vector3d base_alone_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d with_links_mm = Eigen::Vector3d::Zero();
};

using LinkMisses = StaticVector<LinkMiss, kMaxPairs>;

/// Room for the fit: 0.7 MB.
struct LinkWorkspace {
  DenseNormal normal;
  /// Of the last calibration: a row for each pair of `good`, where the halves were fitted (kNone
  /// and kNoBetter), and none otherwise.
  LinkMisses misses;
};

/// Base and all numbers of an arm together by maximum a posteriori likelihood, from pairs whose
/// joint angles are known. The robot's own T_base_tool, in which it may have compensated what gives
/// way, is corrected by what the numbers change: T_base_tool F_given(q)^-1 F(q). `good`: pairs that
/// a base calibration kept; `start`: its pose. Refused unless every other pair foretells the rest
/// better by a fifth with the numbers than without.
void calibrate_links(const kinematics::SerialArm& given, const BasePairs& pairs,
                     const PairJoints& joints, std::span<const std::int32_t> good,
                     const BasePose& start, const LinkExpectation& expectation,
                     LinkWorkspace& workspace, LinkCalibration& result);

}  // namespace tubesight::core::calibration
