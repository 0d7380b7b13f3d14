#pragma once

#include <cstdint>
#include <span>

#include "core/calibration/base_fit.h"
#include "core/calibration/base_pairs.h"

namespace tubesight::core::calibration {

/// Why pairs make no base.
enum class BaseRefusal : std::uint8_t {
  kNone,
  kTooFew,             ///< fewer than three in use
  kOnePlace,           ///< all within 20 mm: where the base is turned to is not told
  kCollinear,          ///< places in a line and no rotations: the lean about it, or which way up
  kOtherUnit,          ///< distances by vision are another multiple of the robot's
  kContradiction,      ///< places do not fit into one base
  kTurnContradiction,  ///< they do, and the rotations do not
  kNotLevel,           ///< known to be level, and the pairs say that it leans
  kVague,              ///< the tool would be known to 5 mm or worse somewhere in the generator
};

/// What a base is good for [Fallon sec. 5.3]: the tool to 0.5 mm over the generator, or to 1.25 mm.
enum class BaseVerdict : std::uint8_t { kCalibration, kPositioning, kZones };

/// Where a calibrated base puts the tool, one sigma.
struct ToolDeviation {
  double across_mm = 0.0;  ///< radially
  double along_mm = 0.0;
};

/// Places of the generator that the tool is judged at.
inline constexpr std::int32_t kMaxPlaces = 1024;
using PlaceList = StaticVector<Eigen::Vector2d, kMaxPlaces>;

/// What became of a pair.
struct PairOutcome {
  Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();  ///< vision less robot, sheet frame
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
  PairMiss miss;
  bool outlier = false;  ///< left out, though it was to be used
};

using PairOutcomes = StaticVector<PairOutcome, kMaxPairs>;

struct BaseCalibration {
  BaseRefusal refusal = BaseRefusal::kNone;
  BaseVerdict verdict = BaseVerdict::kZones;
  BaseFit fit;
  StaticVector<std::int32_t, kMaxPairs> good;  ///< pairs used, in an order of their own
  std::int32_t used = 0;
  std::int32_t outliers = 0;
  double worst_mm = 0.0;  ///< where pairs contradict: how far
  double scale = 1.0;     ///< distances by vision, of those of the robot
  double lean_rad = 0.0;  ///< of the base's z from the sheet's normal, by the pairs alone
  double lean_sigma_rad = 0.0;
  double height_mm = 0.0;  ///< middle z of the tools, sheet frame
  Eigen::Matrix3d R_sheet_tool = Eigen::Matrix3d::Identity();  ///< how one of them stood
  /// x, y, z in mm and alpha, beta, gamma in degrees, as in `[base]`, and their covariance.
  math::Vector6d values = math::Vector6d::Zero();
  math::Matrix6d covariance = math::Matrix6d::Zero();
  ToolDeviation mean;  ///< root mean square over the places
  ToolDeviation worst;
  Eigen::Vector2d worst_mm_at = Eigen::Vector2d::Zero();
};

/// The robot's base in the sheet frame [Fallon sec. 5.3] from pairs in any order: the result has
/// the same bits in each. First a base that most pairs agree with, then least squares; pairs beyond
/// what their scatter allows (one in 10^5 of good ones) are left out and named. `places`: where the
/// tool must be known, at least one. `outcomes`: of each pair, in the order given; empty where
/// there is no fit.
void calibrate_base(const BasePairs& pairs, const BaseKnowledge& knowledge,
                    std::span<const Eigen::Vector2d> places, BaseCalibration& result,
                    PairOutcomes& outcomes);

/// How well the calibrated base tells the tool's place there. The robot's own scatter is not in it.
[[nodiscard]] ToolDeviation deviation_at(const BaseCalibration& base, const Eigen::Vector2d& at_mm);

/// Where one more pair like those used would help most.
struct NextPlace {
  Eigen::Vector2d at_mm = Eigen::Vector2d::Zero();
  ToolDeviation mean;  ///< then
  ToolDeviation worst;
};

/// Of `candidates` the one behind which the tool's mean deviation over `places` is least.
[[nodiscard]] NextPlace next_place(const BaseCalibration& base, const BaseKnowledge& knowledge,
                                   bool turned, std::span<const Eigen::Vector2d> candidates,
                                   std::span<const Eigen::Vector2d> places);

}  // namespace tubesight::core::calibration
