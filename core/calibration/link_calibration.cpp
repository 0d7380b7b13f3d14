#include "core/calibration/link_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/calibration/base_start.h"
#include "core/math/rotation.h"

namespace tubesight::core::calibration {
namespace {

using kinematics::JointVector;
using kinematics::Link;
using kinematics::LinkFrame;
using kinematics::SerialArm;
using BaseToTool = Transform<frames::Base, frames::Tool>;

constexpr std::int32_t kPoseNumbers = 7;  // of base and X: place, turn, turn of the tool
constexpr std::int32_t kLeastPairs = 12;
constexpr double kLeastTravel_rad = 0.35;
constexpr double kForeign_mm = 50.0;  // arms sink by some 7 mm; another arm is a link off
constexpr double kForeign_rad = 0.1;
constexpr double kBetter = 0.8;
constexpr double kNothing_mm = 0.1;  // as well as a robot comes back: nothing is to be gained
constexpr int kSteps = 3;            // what is looked for is small

using Numbers = std::array<double, kArmNumbers>;

/// The arm with its numbers changed. What is small and finite makes an arm.
SerialArm changed(const SerialArm& given, const Numbers& by) {
  StaticVector<Link, kinematics::kMaxJoints> links;
  std::size_t at = 0;
  for (const Link& link : given.links()) {
    Link next = link;
    next.a_mm += by[at];
    next.d_mm += by[at + 1];
    next.twist_rad += by[at + 2];
    next.offset_rad += by[at + 3];
    at += kLinkNumbers;
    static_cast<void>(links.try_push_back(next));
  }
  const Eigen::Vector3d tip(by[at], by[at + 1], by[at + 2]);
  const Transform<LinkFrame, frames::Tool> T_last_tool{given.T_last_tool().rotation(),
                                                       given.T_last_tool().translation_mm() + tip};
  const auto arm = SerialArm::make(links.view(), T_last_tool);
  return arm.value_or(given);
}

std::int32_t numbers_of(const SerialArm& arm) { return kLinkNumbers * arm.joints() + 3; }

Numbers expected_of(const SerialArm& arm, const LinkExpectation& expectation) {
  Numbers expected{};
  std::size_t at = 0;
  for (std::int32_t i = 0; i < arm.joints(); ++i) {
    expected[at] = expected[at + 1] = expectation.length_mm;
    expected[at + 2] = expectation.twist_rad;
    expected[at + 3] = expectation.zero_rad;
    at += kLinkNumbers;
  }
  expected[at] = expected[at + 1] = expected[at + 2] = expectation.tool_mm;
  return expected;
}

/// What one fit has: base, X and the arm's numbers.
struct State {
  BasePose pose;
  Numbers numbers{};
};

class LinkFit {
 public:
  LinkFit(const SerialArm& given, const BasePairs& pairs, const PairJoints& joints,
          const LinkExpectation& expectation, DenseNormal& normal)
      : given_(given),
        pairs_(pairs),
        joints_(joints),
        expectation_(expectation),
        expected_(expected_of(given, expectation)),
        normal_(normal),
        count_(numbers_of(given)) {}

  /// From `state` to the likeliest; without links only base and X move. False: not told.
  [[nodiscard]] bool run(std::span<const std::int32_t> chosen, bool links, State& state) {
    for (int step = 0; step < kSteps; ++step) {
      if (!gather(chosen, links, state)) {
        return false;
      }
      std::array<double, kPoseNumbers + kArmNumbers> move{};
      normal_.solve(move.data());
      const Eigen::Map<const Eigen::Vector3d> place(move.data());
      const Eigen::Map<const Eigen::Vector3d> turn(move.data() + 3);
      state.pose.T_sheet_base = {
          math::orthonormal(math::exp_rotation(turn) * state.pose.T_sheet_base.rotation()),
          state.pose.T_sheet_base.translation_mm() + place};
      state.pose.X =
          math::orthonormal(state.pose.X * math::exp_rotation({0.0, 0.0, move[kPoseNumbers - 1]}));
      for (std::int32_t i = 0; links && i < count_; ++i) {
        state.numbers[static_cast<std::size_t>(i)] +=
            move[static_cast<std::size_t>(kPoseNumbers + i)];
      }
    }
    return gather(chosen, links, state);
  }

  /// Of the fit just run.
  [[nodiscard]] double sigma(std::int32_t number) const {
    std::array<double, kPoseNumbers + kArmNumbers> column{};
    normal_.inverse_column(kPoseNumbers + number, column.data());
    return std::sqrt(std::max(0.0, column[static_cast<std::size_t>(kPoseNumbers + number)]));
  }

  /// How far a pair's place is from where this state has it.
  [[nodiscard]] Eigen::Vector3d miss(std::int32_t i, const State& state) const {
    return place_miss(corrected(i, changed(given_, state.numbers)), state.pose);
  }

 private:
  /// The pair with the robot's pose as this arm has it.
  [[nodiscard]] BasePair corrected(std::int32_t i, const SerialArm& arm) const {
    BasePair pair = pairs_[i];
    pair.T_base_tool =
        pair.T_base_tool * (given_.forward(joints_[i]).inverse() * arm.forward(joints_[i]));
    return pair;
  }

  bool gather(std::span<const std::int32_t> chosen, bool links, const State& state) {
    const std::int32_t unknowns = kPoseNumbers + (links ? count_ : 0);
    normal_.reset(unknowns);
    for (std::int32_t i = 0; i < unknowns; ++i) {
      where_[static_cast<std::size_t>(i)] = i;
    }
    const SerialArm arm = changed(given_, state.numbers);
    for (const std::int32_t i : chosen) {
      add_pair(i, arm, links, state);
    }
    for (std::int32_t i = 0; links && i < count_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const std::int32_t place = kPoseNumbers + i;
      const double weight = 1.0 / expected_[at];
      normal_.add(&place, &weight, 1, -weight * state.numbers[at]);
    }
    return normal_.factor(0.0);
  }

  void add_pair(std::int32_t i, const SerialArm& arm, bool links, const State& state) {
    const BasePair pair = corrected(i, arm);
    const Eigen::Matrix3d R = state.pose.T_sheet_base.rotation();
    const Eigen::Vector3d place = state.pose.T_sheet_base * pair.T_base_tool.translation_mm();
    const Eigen::Vector3d miss = place_miss(pair, state.pose);
    const Eigen::Vector3d turn = turn_miss(pair, state.pose);
    slopes_.setZero();
    slopes_.block<3, 3>(0, 0).setIdentity();
    slopes_.block<3, 3>(0, 3) = -math::skew(place - state.pose.T_sheet_base.translation_mm());
    slopes_.block<3, 3>(3, 3).setIdentity();
    slopes_.block<3, 1>(3, 6) = R * pair.T_base_tool.rotation() * state.pose.X.col(2);
    for (std::int32_t k = 0; links && k < count_; ++k) {
      Numbers more = state.numbers;
      const auto at = static_cast<std::size_t>(k);
      const double step = 0.01 * expected_[at];
      more[at] += step;
      const BaseToTool there = corrected(i, changed(given_, more)).T_base_tool;
      slopes_.block<3, 1>(0, kPoseNumbers + k) =
          R * (there.translation_mm() - pair.T_base_tool.translation_mm()) / step;
      slopes_.block<3, 1>(3, kPoseNumbers + k) =
          R * math::log_rotation(there.rotation() * pair.T_base_tool.rotation().transpose()) / step;
    }
    const std::int32_t unknowns = kPoseNumbers + (links ? count_ : 0);
    for (int row = 0; row < (pair.turned ? 6 : 3); ++row) {
      const double sigma =
          row < 3 ? std::hypot(expectation_.place_mm, pair.sigma_mm(row)) : expectation_.turn_rad;
      std::array<double, kPoseNumbers + kArmNumbers> values{};
      for (std::int32_t k = 0; k < unknowns; ++k) {
        values[static_cast<std::size_t>(k)] = slopes_(row, k) / sigma;
      }
      normal_.add(where_.data(), values.data(), unknowns,
                  (row < 3 ? miss(row) : turn(row - 3)) / sigma);
    }
  }

  const SerialArm& given_;
  const BasePairs& pairs_;
  const PairJoints& joints_;
  const LinkExpectation& expectation_;
  Numbers expected_;
  DenseNormal& normal_;
  std::int32_t count_;
  std::array<std::int32_t, kPoseNumbers + kArmNumbers> where_{};
  Eigen::Matrix<double, 6, kPoseNumbers + kArmNumbers> slopes_;
};

/// Why joints or pairs carry nothing, before any fit.
LinkRefusal look(const SerialArm& given, const BasePairs& pairs, const PairJoints& joints,
                 std::span<const std::int32_t> good, LinkCalibration& result) {
  if (static_cast<std::int32_t>(good.size()) < kLeastPairs) {
    return LinkRefusal::kTooFew;
  }
  for (const std::int32_t i : good) {
    const BaseToTool by_arm = given.forward(joints[i]);
    const BaseToTool& told = pairs[i].T_base_tool;
    const double off = (by_arm.translation_mm() - told.translation_mm()).norm();
    const double turn = math::log_rotation(by_arm.rotation() * told.rotation().transpose()).norm();
    if (off > kForeign_mm || (pairs[i].turned && turn > kForeign_rad)) {
      result.pair = i;
      return LinkRefusal::kForeignJoints;
    }
  }
  for (std::int32_t joint = 0; joint < given.joints(); ++joint) {
    const auto at = static_cast<std::size_t>(joint);
    double least = joints[good[0]][at];
    double most = least;
    for (const std::int32_t i : good) {
      least = std::min(least, joints[i][at]);
      most = std::max(most, joints[i][at]);
    }
    // No reason to refuse: a wrist that keeps the tool square stands still for ever.
    result.standing[at] = most - least < kLeastTravel_rad;
  }
  return LinkRefusal::kNone;
}

/// The same without the lean of X: here the last link's twist and zero are what leans the tool.
BasePose upright(const BasePose& pose) {
  const double angle = std::atan2(pose.X(1, 0), pose.X(0, 0));
  return {pose.T_sheet_base, math::exp_rotation({0.0, 0.0, angle})};
}

/// Every other pair fitted, without links and with them, foretells the rest. False: a half does not
/// tell the base.
bool foretell_halves(LinkFit& fit, std::span<const std::int32_t> good, const BasePose& start,
                     LinkMisses& misses) {
  std::array<StaticVector<std::int32_t, kMaxPairs>, 2> halves;
  for (std::size_t k = 0; k < good.size(); ++k) {
    static_cast<void>(halves[k % 2].try_push_back(good[k]));
    static_cast<void>(misses.try_push_back({good[k]}));
  }
  for (std::size_t half = 0; half < halves.size(); ++half) {
    State alone{upright(start), {}};
    State with_links = alone;
    if (!fit.run(halves[half].view(), false, alone) ||
        !fit.run(halves[half].view(), true, with_links)) {
      misses.clear();
      return false;
    }
    for (std::int32_t k = 1 - static_cast<std::int32_t>(half); k < misses.size(); k += 2) {
      misses[k].base_alone_mm = fit.miss(misses[k].pair, alone);
      misses[k].with_links_mm = fit.miss(misses[k].pair, with_links);
    }
  }
  return true;
}

}  // namespace

void calibrate_links(const SerialArm& given, const BasePairs& pairs, const PairJoints& joints,
                     std::span<const std::int32_t> good, const BasePose& start,
                     const LinkExpectation& expectation, LinkWorkspace& workspace,
                     LinkCalibration& result) {
  result = {};
  workspace.misses.clear();
  result.refusal = look(given, pairs, joints, good, result);
  if (result.refusal != LinkRefusal::kNone) {
    return;
  }
  LinkFit fit(given, pairs, joints, expectation, workspace.normal);
  if (!foretell_halves(fit, good, start, workspace.misses)) {
    result.refusal = LinkRefusal::kTooFew;
    return;
  }
  double alone = 0.0;
  double with_links = 0.0;
  for (const LinkMiss& miss : workspace.misses) {
    alone += miss.base_alone_mm.squaredNorm();
    with_links += miss.with_links_mm.squaredNorm();
  }
  result.base_alone_mm = std::sqrt(alone / workspace.misses.size());
  result.with_links_mm = std::sqrt(with_links / workspace.misses.size());
  State state{upright(start), {}};
  if (result.base_alone_mm < kNothing_mm || result.with_links_mm > kBetter * result.base_alone_mm ||
      !fit.run(good, true, state)) {
    result.refusal = LinkRefusal::kNoBetter;
    return;
  }
  result.arm = changed(given, state.numbers);
  result.pose = state.pose;
  result.values = state.numbers;
  result.expected = expected_of(given, expectation);
  result.count = numbers_of(given);
  for (std::int32_t i = 0; i < result.count; ++i) {
    result.sigmas[static_cast<std::size_t>(i)] = fit.sigma(i);
  }
}

}  // namespace tubesight::core::calibration
