#include "board/bench/cold_start/lattice_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace tubesight::board {
namespace {

using core::detection::LatticeElement;

constexpr int kLeastNeighbours = 5;
/// Of the way from the neighbours' inside to what surrounds them.
constexpr double kBright = 0.6;
/// The middle of an element, in its shorter half axes.
constexpr double kMiddle = 0.4;

using Table = std::map<std::pair<std::int32_t, std::int32_t>, const LatticeElement*>;

/// Mean grey level of a disc.
double level(const core::picture::AveragedPicture& picture, const Eigen::Vector2d& middle,
             double radius_px) {
  double sum = 0.0;
  double count = 0.0;
  const auto reach = static_cast<std::int32_t>(std::ceil(radius_px));
  const auto u0 = static_cast<std::int32_t>(std::lround(middle.x()));
  const auto v0 = static_cast<std::int32_t>(std::lround(middle.y()));
  for (std::int32_t v = v0 - reach; v <= v0 + reach; ++v) {
    for (std::int32_t u = u0 - reach; u <= u0 + reach; ++u) {
      if (u >= 0 && v >= 0 && u < picture.width_px && v < picture.height_px &&
          std::hypot(u - middle.x(), v - middle.y()) <= radius_px) {
        sum += static_cast<double>(picture.at(u, v)) / core::picture::kGreyScale;
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

bool is_gap(const Table& table, const core::picture::AveragedPicture& picture, LatticePlace at) {
  constexpr std::array<std::array<std::int32_t, 2>, 4> kWays = {{{0, 1}, {1, 0}, {1, 1}, {1, -1}}};
  const auto element = [&](std::int32_t row, std::int32_t column) {
    const auto found = table.find({at.row + row, at.column + column});
    return found == table.end() ? nullptr : found->second;
  };
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  int pairs = 0;
  int count = 0;
  double inside = 0.0;
  double contrast = 0.0;
  double half = 1e9;
  for (const auto& way : kWays) {
    const std::array both = {element(way[0], way[1]), element(-way[0], -way[1])};
    for (const LatticeElement* const one : both) {
      if (one != nullptr && one->contrast > 0.0) {
        const double radius = core::detection::half_axes(one->ellipse).y();
        inside += level(picture, one->center_px, kMiddle * radius);
        contrast += one->contrast;
        half = std::min(half, radius);
        ++count;
      }
    }
    if (both[0] != nullptr && both[1] != nullptr) {
      place += 0.5 * (both[0]->center_px + both[1]->center_px);
      ++pairs;
    }
  }
  return count >= kLeastNeighbours && pairs > 0 &&
         level(picture, place / pairs, kMiddle * half) > (inside + kBright * contrast) / count;
}

}  // namespace

std::vector<LatticePlace> find_gaps(const core::detection::FoundLattice& found,
                                    const core::picture::AveragedPicture& picture) {
  Table table;
  LatticePlace last;
  for (const LatticeElement& element : found.elements) {
    table[{element.row, element.column}] = &element;
    last.row = std::max(last.row, element.row);
    last.column = std::max(last.column, element.column);
  }
  std::vector<LatticePlace> gaps;
  for (std::int32_t row = 0; row <= last.row; ++row) {
    for (std::int32_t column = 0; column <= last.column; ++column) {
      if (table.count({row, column}) == 0 && is_gap(table, picture, {row, column})) {
        gaps.push_back({row, column});
      }
    }
  }
  return gaps;
}

}  // namespace tubesight::board
