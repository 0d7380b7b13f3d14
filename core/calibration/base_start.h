#pragma once

#include <cstdint>
#include <span>

#include "core/calibration/base_pairs.h"

namespace tubesight::core::calibration {

/// The base from some pairs in closed form: the rotation that turns the robot's places, seen from
/// their middle, and its tool axes best into those of vision [Horn1987], then the turn X, then the
/// position. `chosen` are indices into `pairs`, at least two. A level base takes of its two senses
/// (z up or down) the one that leaves the lesser misses.
[[nodiscard]] BasePose base_in_closed_form(const BasePairs& pairs,
                                           std::span<const std::int32_t> chosen,
                                           const BaseKnowledge& knowledge);

/// X as the rotations of these pairs tell it where the base's is known: a turn about z.
[[nodiscard]] Eigen::Matrix3d turn_of_tool(const BasePairs& pairs,
                                           std::span<const std::int32_t> chosen,
                                           const Eigen::Matrix3d& R_sheet_base);

/// How far a pair's place by vision is from where the robot's comes to lie, mm.
[[nodiscard]] Eigen::Vector3d place_miss(const BasePair& pair, const BasePose& pose);

/// How far its rotation is: a vector in the sheet frame, rad; zero where the pair has none.
[[nodiscard]] Eigen::Vector3d turn_miss(const BasePair& pair, const BasePose& pose);

/// A base that most pairs agree with, whatever the others say: of many sets of three pairs the one
/// whose closed form leaves the least middle miss [Rousseeuw1984]. `chosen`: three pairs at least.
/// `scatter_mm` becomes the misses' one sigma an axis, as the better half tells it.
[[nodiscard]] BasePose base_of_most(const BasePairs& pairs, std::span<const std::int32_t> chosen,
                                    const BaseKnowledge& knowledge, double& scatter_mm);

/// Pairs that a set of `count` can have wrong and still be found out: less than half of what is
/// beyond the three that any base fits.
[[nodiscard]] constexpr std::int32_t most_outliers(std::int32_t count) {
  return count > 4 ? (count - 3) / 2 : 0;
}

}  // namespace tubesight::core::calibration
