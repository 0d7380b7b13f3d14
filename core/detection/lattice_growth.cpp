#include "core/detection/lattice_growth.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tubesight::core::detection {
namespace {

// Neighbours are looked for up to so many radii away: a pitch of six diameters.
constexpr double kFarthest = 12.0;
// Circles that touch are two radii apart.
constexpr double kNearest = 1.7;
// Areas of neighbours differ less, even close to a wide-angle camera.
constexpr double kLikeArea = 4.0;
// A neighbour stands where the steps say to this share of the shorter one. Half of it and the
// ellipses' noise would matter; twice, and the diagonal neighbour of an oblique lattice.
constexpr double kAgree = 0.25;
// Two steps that are this near to one line (sine of the angle) are one direction.
constexpr double kLeastSine = 0.4;

// Spots this much alike by area may be of one lattice.
constexpr double kLeastLike = 0.5;
// Between one in so many elements of a lattice there may be a false one.
constexpr std::int32_t kShareBetween = 8;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// a turned by the angle whose cosine and sine `turn` has.
Eigen::Vector2d turned(const Eigen::Vector2d& a, const Eigen::Vector2d& turn) {
  return {turn.x() * a.x() - turn.y() * a.y(), turn.y() * a.x() + turn.x() * a.y()};
}
Eigen::Vector2d turned_back(const Eigen::Vector2d& a, const Eigen::Vector2d& turn) {
  return turned(a, {turn.x(), -turn.y()});
}

/// The turn that brings `from` into the direction of `to`.
Eigen::Vector2d turn_between(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return Eigen::Vector2d(from.dot(to), cross(from, to)).normalized();
}

/// The neighbours by index, those across corners last: they lead past one that is missing.
struct Side {
  std::int32_t row;
  std::int32_t column;
};
constexpr std::array<Side, 8> kSides = {
    {{0, 1}, {0, -1}, {1, 0}, {-1, 0}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

Eigen::Vector2d step_to(const Side& side, const Steps& steps) {
  return side.column * steps.column + side.row * steps.row;
}

/// Makes the steps as short as they can be, the row's by whole column steps and the reverse, and
/// tells how (column, row) by the new steps follow from those by the old ones.
Eigen::Matrix2i shorten(Steps& steps) {
  Eigen::Matrix2i change = Eigen::Matrix2i::Identity();
  constexpr int kRounds = 16;
  for (int round = 0; round < kRounds; ++round) {
    const bool by_column = steps.column.squaredNorm() <= steps.row.squaredNorm();
    Eigen::Vector2d& shorter = by_column ? steps.column : steps.row;
    Eigen::Vector2d& longer = by_column ? steps.row : steps.column;
    // The angle may stay a little beyond what is shortest: noise must not turn it to and fro.
    const double share = longer.dot(shorter) / shorter.squaredNorm();
    const int times = std::abs(share) < 0.55 ? 0 : static_cast<int>(std::lround(share));
    if (times == 0) {
      break;
    }
    longer -= times * shorter;
    Eigen::Matrix2i once = Eigen::Matrix2i::Identity();
    once(by_column ? 0 : 1, by_column ? 1 : 0) = times;
    change = once * change;
  }
  return change;
}

constexpr std::int32_t kLeastElements = 5;

bool is_plane(const Growth& growth) {
  bool rows = false;
  bool columns = false;
  for (const Place& place : growth.places) {
    rows = rows || place.row != growth.places[0].row;
    columns = columns || place.column != growth.places[0].column;
  }
  return rows && columns && growth.places.size() >= kLeastElements;
}

}  // namespace

void LatticeGrowth::grow(const BlobList& blobs, bool dark, Growth& growth) {
  growth.places.clear();
  const std::int32_t candidates = link_all(blobs, dark);
  // Seeds that have neighbours on both sides first; where there are none, at the edge of a small
  // lattice, any two neighbours will do.
  for (const bool symmetric : {true, false}) {
    for (std::int32_t seed = 0; seed < count_; ++seed) {
      Steps steps;
      if (node(seed).other_kind || node(seed).placed ||
          !choose_steps(node(seed), symmetric, steps)) {
        continue;
      }
      grow_from(seed, steps, trial_);
      if (!is_plane(trial_) || trial_.places.size() <= growth.places.size()) {
        continue;
      }
      average_steps(trial_);
      if (leaves_out_some(blobs, trial_)) {
        continue;
      }
      growth = trial_;
      const Eigen::Matrix2i change = shorten(growth.steps);
      for (Place& place : growth.places) {
        const Eigen::Vector2i index = change * Eigen::Vector2i(place.column, place.row);
        place.column = index.x();
        place.row = index.y();
      }
      for (const Place& place : growth.places) {
        node(place.blob).placed = true;
      }
      if (2 * growth.places.size() > candidates) {
        break;  // no other can be larger
      }
    }
    if (!growth.places.empty()) {
      lay_out(blobs, growth);
      return;
    }
  }
}

/// Finds the nearest neighbours of all spots of the kind, and counts these.
std::int32_t LatticeGrowth::link_all(const BlobList& blobs, bool dark) {
  count_ = blobs.size();
  std::int32_t candidates = 0;
  for (std::int32_t i = 0; i < count_; ++i) {
    node(i) = {};
    node(i).other_kind = blobs[i].dark != dark;
    candidates += node(i).other_kind ? 0 : 1;
  }
  for (std::int32_t i = 0; i < count_; ++i) {
    if (node(i).other_kind) {
      continue;
    }
    for (std::int32_t k = i + 1; k < count_; ++k) {
      if (!node(k).other_kind) {
        link(blobs, i, k);
      }
    }
  }
  return candidates;
}

/// Links two spots with each other when they may be neighbours.
void LatticeGrowth::link(const BlobList& blobs, std::int32_t from, std::int32_t to) {
  const Ellipse& a = blobs[from].ellipse;
  const Ellipse& b = blobs[to].ellipse;
  const Eigen::Vector2d offset = b.center_px - a.center_px;
  // The trace is at least the longer half axis' square.
  const double bound = a.shape_px2.trace() + b.shape_px2.trace();
  if (offset.squaredNorm() > 0.5 * kFarthest * kFarthest * bound) {
    return;
  }
  const double area = a.shape_px2.determinant() / b.shape_px2.determinant();
  if (area > kLikeArea * kLikeArea || area * kLikeArea * kLikeArea < 1.0) {
    return;
  }
  const double distance = 2.0 * offset.norm() / (reach_along(a, offset) + reach_along(b, offset));
  if (distance < kNearest || distance > kFarthest) {
    return;
  }
  const auto insert = [&](std::int32_t at, std::int32_t other, const Eigen::Vector2d& way) {
    auto& links = node(at).links;
    if (links.full() && links[kLinks - 1].distance <= distance) {
      return;
    }
    const Eigen::Vector2d straight = root_of(blobs[at].ellipse.shape_px2).inverse() * way;
    if (links.full()) {
      links.truncate(kLinks - 1);
    }
    static_cast<void>(links.try_push_back({other, distance * straight.normalized(), distance}));
    for (std::int32_t i = links.size() - 1; i > 0 && links[i - 1].distance > distance; --i) {
      std::swap(links[i - 1], links[i]);
    }
  };
  insert(from, to, offset);
  insert(to, from, -offset);
}

/// The two shortest steps from an element; `symmetric`: those with a neighbour behind, too.
bool LatticeGrowth::choose_steps(const Node& seed, bool symmetric, Steps& steps) {
  StaticVector<Eigen::Vector2d, kLinks> ways;
  for (const Link& link : seed.links) {
    Eigen::Vector2d way = link.offset;
    if (symmetric) {
      const auto* const behind =
          std::find_if(seed.links.begin(), seed.links.end(), [&](const Link& other) {
            return (other.offset + link.offset).norm() < kAgree * link.distance;
          });
      if (behind == seed.links.end()) {
        continue;
      }
      way = 0.5 * (link.offset - behind->offset);
    }
    static_cast<void>(ways.try_push_back(way));
  }
  for (std::int32_t i = 1; i < ways.size(); ++i) {
    if (std::abs(cross(ways[0], ways[i])) > kLeastSine * ways[0].norm() * ways[i].norm()) {
      steps = {ways[0], ways[i]};
      static_cast<void>(shorten(steps));
      return true;
    }
  }
  return false;
}

void LatticeGrowth::grow_from(std::int32_t seed, const Steps& steps, Growth& growth) {
  growth.places.clear();
  growth.steps = steps;
  taken_.fill(-1);
  for (std::int32_t i = 0; i < count_; ++i) {
    node(i).here = false;
  }
  Node& first = node(seed);
  first.row = 0;
  first.column = 0;
  first.turn = Eigen::Vector2d::UnitX();
  first.here = true;
  taken(0, 0) = static_cast<std::int16_t>(seed);
  static_cast<void>(growth.places.try_push_back({0, 0, seed}));
  // The list is the queue: what is found at one element is looked around from later.
  for (std::int32_t i = 0; i < growth.places.size(); ++i) {
    look_around(growth.places[i].blob, steps, growth);
  }
}

/// Takes the neighbours of an element that stand where the steps say.
void LatticeGrowth::look_around(std::int32_t from, const Steps& steps, Growth& growth) {
  const Node& here = node(from);
  const double gate = kAgree * std::min(steps.column.norm(), steps.row.norm());
  for (const Side& side : kSides) {
    const std::int32_t row = here.row + side.row;
    const std::int32_t column = here.column + side.column;
    if (std::max(std::abs(row), std::abs(column)) > kMaxIndex) {
      continue;
    }
    const Eigen::Vector2d step = step_to(side, steps);
    const Link* best = nullptr;
    double best_off = gate;
    for (const Link& link : here.links) {
      const double off = (turned_back(link.offset, here.turn) - step).norm();
      if (off < best_off) {
        best = &link;
        best_off = off;
      }
    }
    if (best == nullptr) {
      continue;
    }
    Node& next = node(best->other);
    const auto* const back = std::find_if(next.links.begin(), next.links.end(),
                                          [&](const Link& link) { return link.other == from; });
    if (back == next.links.end()) {
      continue;
    }
    const Eigen::Vector2d turn = turn_between(-step, back->offset);
    if (next.here) {
      if (next.row == row && next.column == column) {
        next.turn = (next.turn + 0.3 * turn).normalized();  // several say it better than one
      }
      continue;
    }
    if (taken(row, column) >= 0 || !growth.places.try_push_back({row, column, best->other})) {
      continue;
    }
    taken(row, column) = static_cast<std::int16_t>(best->other);
    next.row = row;
    next.column = column;
    next.turn = turn;
    next.here = true;
  }
}

/// The steps again, as the mean of all that were found.
void LatticeGrowth::average_steps(Growth& growth) const {
  Steps sum{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  double columns = 0.0;
  double rows = 0.0;
  for (const Place& place : growth.places) {
    const Node& here = node(place.blob);
    for (const Link& link : here.links) {
      const Node& other = node(link.other);
      if (!other.here) {
        continue;
      }
      const Eigen::Vector2d way = turned_back(link.offset, here.turn);
      const std::int32_t down = other.row - here.row;
      const std::int32_t right = other.column - here.column;
      if (down == 0 && std::abs(right) == 1) {
        sum.column += right * way;
        columns += 1.0;
      } else if (right == 0 && std::abs(down) == 1) {
        sum.row += down * way;
        rows += 1.0;
      }
    }
  }
  growth.steps.column = columns > 0.0 ? Eigen::Vector2d(sum.column / columns) : growth.steps.column;
  growth.steps.row = rows > 0.0 ? Eigen::Vector2d(sum.row / rows) : growth.steps.row;
}

/// Whether like spots stand between the elements: these are then a part of the lattice only, every
/// other row of it, say, where those between were missing beside the seed.
bool LatticeGrowth::leaves_out_some(const BlobList& blobs, const Growth& growth) const {
  Eigen::Matrix2d steps;
  steps << growth.steps.column, growth.steps.row;
  const Eigen::Matrix2d to_index = steps.inverse();
  const double gate = kAgree * std::min(growth.steps.column.norm(), growth.steps.row.norm());
  std::int32_t between = 0;
  for (std::int32_t i = 0; i < count_; ++i) {
    if (node(i).other_kind || node(i).here) {
      continue;
    }
    for (const Link& link : node(i).links) {
      const Node& other = node(link.other);
      const double area = std::sqrt(blobs[i].ellipse.shape_px2.determinant() /
                                    blobs[link.other].ellipse.shape_px2.determinant());
      const auto* const back = std::find_if(other.links.begin(), other.links.end(),
                                            [&](const Link& from) { return from.other == i; });
      if (!other.here || back == other.links.end() || area < kLeastLike ||
          area > 1.0 / kLeastLike) {
        continue;
      }
      const Eigen::Vector2d way = turned_back(back->offset, other.turn);
      const Eigen::Vector2d index = to_index * way;
      const Eigen::Vector2d whole = index.array().round();
      if (index.cwiseAbs().maxCoeff() < 1.0 && (way - steps * whole).norm() > gate) {
        ++between;
        break;
      }
    }
  }
  return between * kShareBetween > growth.places.size();
}

/// Turns rows and columns so that columns go right, rows down, and both count from 0.
void LatticeGrowth::lay_out(const BlobList& blobs, Growth& growth) {
  // The picture's mean steps, by the covariance of places with indices.
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d with_picture = Eigen::Matrix2d::Zero();
  Eigen::Vector2d mean_index = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_px = Eigen::Vector2d::Zero();
  for (const Place& place : growth.places) {
    mean_index += Eigen::Vector2d(place.column, place.row) / growth.places.size();
    mean_px += blobs[place.blob].ellipse.center_px / growth.places.size();
  }
  for (const Place& place : growth.places) {
    const Eigen::Vector2d index = Eigen::Vector2d(place.column, place.row) - mean_index;
    spread += index * index.transpose();
    with_picture += (blobs[place.blob].ellipse.center_px - mean_px) * index.transpose();
  }
  const Eigen::Matrix2d map = with_picture * spread.inverse();
  const Eigen::Vector2d column = map.col(0).normalized();
  const Eigen::Vector2d row = map.col(1).normalized();
  const bool swap = std::abs(row.x()) > std::abs(column.x());
  const Eigen::Vector2d right = swap ? row : column;
  const Eigen::Vector2d down = swap ? column : row;
  const int right_sign = right.x() < 0.0 ? -1 : 1;
  const int down_sign = right_sign * cross(right, down) < 0.0 ? -1 : 1;
  std::int32_t least_row = kMaxIndex;
  std::int32_t least_column = kMaxIndex;
  for (Place& place : growth.places) {
    const std::int32_t along = swap ? place.row : place.column;
    const std::int32_t across = swap ? place.column : place.row;
    place.column = right_sign * along;
    place.row = down_sign * across;
    least_row = std::min(least_row, place.row);
    least_column = std::min(least_column, place.column);
  }
  for (Place& place : growth.places) {
    place.row -= least_row;
    place.column -= least_column;
  }
  if (swap) {
    std::swap(growth.steps.column, growth.steps.row);
  }
  growth.steps.column *= right_sign;
  growth.steps.row *= down_sign;
}

}  // namespace tubesight::core::detection
