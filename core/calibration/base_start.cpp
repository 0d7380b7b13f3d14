#include "core/calibration/base_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/assert.h"
#include "core/math/rotation.h"
#include "core/math/small_matrix.h"
#include "core/math/split_mix.h"

namespace tubesight::core::calibration {
namespace {

// What a place and an axis of a robot are roughly known to [docs/kinematics.md]: their weights
// here.
constexpr double kPlace_mm = 0.5;
constexpr double kAxis_rad = 1e-3;

/// Sum of weights times (in the base frame) (in the sheet frame)^T, and what is behind it.
struct Correlation {
  Eigen::Vector3d middle_base = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle_sheet = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
};

Correlation correlation_of(const BasePairs& pairs, std::span<const std::int32_t> chosen,
                           const BaseKnowledge& knowledge) {
  Correlation c;
  for (const std::int32_t i : chosen) {
    c.middle_base += pairs[i].T_base_tool.translation_mm();
    c.middle_sheet += pairs[i].T_sheet_tool.translation_mm();
  }
  c.middle_base /= static_cast<double>(chosen.size());
  c.middle_sheet /= static_cast<double>(chosen.size());
  for (const std::int32_t i : chosen) {
    const BasePair& pair = pairs[i];
    const Eigen::Vector3d base = pair.T_base_tool.translation_mm() - c.middle_base;
    const Eigen::Vector3d sheet = pair.T_sheet_tool.translation_mm() - c.middle_sheet;
    c.sum += base * sheet.transpose() / (kPlace_mm * kPlace_mm);
    // Of an unknown turn about z the z axes know nothing.
    const bool turned = pair.turned && !knowledge.places_only;
    for (int axis = knowledge.tool_known ? 0 : 2; turned && axis < 3; ++axis) {
      c.sum += pair.T_base_tool.rotation().col(axis) *
               pair.T_sheet_tool.rotation().col(axis).transpose() / (kAxis_rad * kAxis_rad);
    }
  }
  return c;
}

/// The rotation R with the greatest sum of sheet^T R base: the quaternion is the eigenvector of the
/// greatest eigenvalue of Horn's matrix.
Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& s) {
  Eigen::Matrix4d n;
  n << s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),  //
      s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),   //
      s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),   //
      s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
  const Eigen::Vector4d q = math::SymmetricEigen<4>(n).vector_of_greatest();
  const double w = q(0);
  const Eigen::Vector3d v = q.tail<3>();
  const Eigen::Matrix3d cross = math::skew(v);
  return (w * w - v.squaredNorm()) * Eigen::Matrix3d::Identity() + 2.0 * v * v.transpose() +
         2.0 * w * cross;
}

/// The turn about z whose sine and cosine are as these; none where both are 0.
Eigen::Matrix3d turn_about_z(double sine, double cosine) {
  const double size = std::hypot(sine, cosine);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (size > 0.0) {
    turn(0, 0) = turn(1, 1) = cosine / size;
    turn(1, 0) = sine / size;
    turn(0, 1) = -sine / size;
  }
  return turn;
}

/// The best turn about the sheet's z behind a sense of the base's z.
Eigen::Matrix3d level_rotation(const Eigen::Matrix3d& s, bool up) {
  Eigen::Matrix3d sense = Eigen::Matrix3d::Identity();
  if (!up) {
    sense(1, 1) = -1.0;  // half a turn about x
    sense(2, 2) = -1.0;
  }
  const Eigen::Matrix3d seen = sense * s;
  const double sine = seen(0, 1) - seen(1, 0);
  const double cosine = seen(0, 0) + seen(1, 1);
  return turn_about_z(sine, cosine) * sense;
}

double squares_of(const BasePairs& pairs, std::span<const std::int32_t> chosen,
                  const BaseKnowledge& knowledge, const BasePose& pose) {
  double sum = 0.0;
  for (const std::int32_t i : chosen) {
    sum += place_miss(pairs[i], pose).squaredNorm() / (kPlace_mm * kPlace_mm);
    if (!knowledge.places_only) {
      sum += turn_miss(pairs[i], pose).squaredNorm() / (kAxis_rad * kAxis_rad);
    }
  }
  return sum;
}

BasePose pose_with(const BasePairs& pairs, std::span<const std::int32_t> chosen,
                   const BaseKnowledge& knowledge, const Correlation& c, const Eigen::Matrix3d& R) {
  BasePose pose;
  pose.T_sheet_base = {R, c.middle_sheet - R * c.middle_base};
  if (!knowledge.tool_known) {
    pose.X = turn_of_tool(pairs, chosen, R);
  }
  return pose;
}

/// Picks of three out of `count`: all of them where they are few, else drawn, the same ones each
/// time.
class Triples {
 public:
  explicit Triples(std::int32_t count) : count_(count), all_(count <= kAllUpTo) {}

  [[nodiscard]] bool next(std::array<std::int32_t, 3>& triple) {
    if (all_) {
      if (!started_) {
        started_ = true;
        triple_ = {0, 1, 2};
      } else if (!advance()) {
        return false;
      }
    } else if (drawn_++ == kDraws) {
      return false;
    } else {
      do {
        for (std::int32_t& index : triple_) {
          index = static_cast<std::int32_t>(draws_.next() % static_cast<std::uint64_t>(count_));
        }
      } while (triple_[0] == triple_[1] || triple_[1] == triple_[2] || triple_[0] == triple_[2]);
    }
    triple = triple_;
    return true;
  }

 private:
  static constexpr std::int32_t kAllUpTo = 20;  // 1140 of them
  static constexpr std::int32_t kDraws = 1000;  // with half of the pairs wrong 1e-58 to miss
  bool advance() {
    for (std::int32_t place = 2; place >= 0; --place) {
      const auto at = static_cast<std::size_t>(place);
      if (triple_[at] < count_ - 3 + place) {
        ++triple_[at];
        for (std::size_t behind = at + 1; behind < 3; ++behind) {
          triple_[behind] = triple_[behind - 1] + 1;
        }
        return true;
      }
    }
    return false;
  }

  std::int32_t count_;
  bool all_;
  bool started_ = false;
  std::int32_t drawn_ = 0;
  math::SplitMix64 draws_{1};
  std::array<std::int32_t, 3> triple_{};
};

}  // namespace

Eigen::Matrix3d turn_of_tool(const BasePairs& pairs, std::span<const std::int32_t> chosen,
                             const Eigen::Matrix3d& R_sheet_base) {
  double sine = 0.0;
  double cosine = 0.0;
  for (const std::int32_t i : chosen) {
    if (pairs[i].turned) {
      const Eigen::Matrix3d left = (R_sheet_base * pairs[i].T_base_tool.rotation()).transpose() *
                                   pairs[i].T_sheet_tool.rotation();
      sine += left(1, 0) - left(0, 1);
      cosine += left(0, 0) + left(1, 1);
    }
  }
  return turn_about_z(sine, cosine);
}

Eigen::Vector3d place_miss(const BasePair& pair, const BasePose& pose) {
  return pair.T_sheet_tool.translation_mm() - pose.T_sheet_base * pair.T_base_tool.translation_mm();
}

Eigen::Vector3d turn_miss(const BasePair& pair, const BasePose& pose) {
  if (!pair.turned) {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Matrix3d expected =
      pose.T_sheet_base.rotation() * pair.T_base_tool.rotation() * pose.X;
  return math::log_rotation(pair.T_sheet_tool.rotation() * expected.transpose());
}

BasePose base_in_closed_form(const BasePairs& pairs, std::span<const std::int32_t> chosen,
                             const BaseKnowledge& knowledge) {
  TUBESIGHT_ASSERT(chosen.size() >= 2);
  const Correlation c = correlation_of(pairs, chosen, knowledge);
  if (!knowledge.level) {
    return pose_with(pairs, chosen, knowledge, c, best_rotation(c.sum));
  }
  const BasePose up = pose_with(pairs, chosen, knowledge, c, level_rotation(c.sum, true));
  const BasePose down = pose_with(pairs, chosen, knowledge, c, level_rotation(c.sum, false));
  return squares_of(pairs, chosen, knowledge, up) <= squares_of(pairs, chosen, knowledge, down)
             ? up
             : down;
}

BasePose base_of_most(const BasePairs& pairs, std::span<const std::int32_t> chosen,
                      const BaseKnowledge& knowledge, double& scatter_mm) {
  const auto count = static_cast<std::int32_t>(chosen.size());
  TUBESIGHT_ASSERT(count >= 3 && count <= kMaxPairs);
  const auto rank = static_cast<std::size_t>(count - most_outliers(count) - 1);
  BasePose best;
  double least = std::numeric_limits<double>::infinity();
  std::array<double, kMaxPairs> squares{};
  std::array<std::int32_t, 3> triple{};
  for (Triples triples(count); triples.next(triple);) {
    std::array<std::int32_t, 3> picked{};
    for (std::size_t k = 0; k < 3; ++k) {
      picked[k] = chosen[static_cast<std::size_t>(triple[k])];
    }
    const BasePose pose = base_in_closed_form(pairs, picked, knowledge);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      squares[k] = place_miss(pairs[chosen[k]], pose).squaredNorm();
    }
    std::nth_element(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(rank),
                     squares.begin() + count);
    if (squares[rank] < least) {
      least = squares[rank];
      best = pose;
    }
  }
  // Between the median of three axes' misses (1.54 sigma) and their 95th centile (2.80); few pairs
  // lie too near to a base that three of them made.
  const double share = static_cast<double>(rank + 1) / count;
  const double sigmas = 1.54 + 2.5 * std::max(0.0, share - 0.5);
  scatter_mm = std::sqrt(least) / sigmas * (1.0 + 5.0 / count);
  return best;
}

}  // namespace tubesight::core::calibration
