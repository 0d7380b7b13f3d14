#include "core/detection/portrait.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <Eigen/LU>

#include "core/detection/element_edge.h"

namespace tubesight::core::detection {
namespace {

// The cells are those of a square grid inside so many radii: with the rim, a weld and its shadow,
// without the next tube-end. Beyond kAround there is the sheet, or a weld.
constexpr double kReach = 1.45;
constexpr double kAround = 1.15;
constexpr int kHalfSide = 7;
constexpr std::size_t kParts = 8;

struct Cell {
  double x = 0.0;
  double y = 0.0;
  int part = -1;  ///< of what is around, an eighth; -1: nearer
};

template <std::size_t kCount>
constexpr std::array<Cell, kCount> make_cells() {
  std::array<Cell, kCount> cells{};
  std::size_t count = 0;
  for (int j = -kHalfSide; j <= kHalfSide; ++j) {
    for (int i = -kHalfSide; i <= kHalfSide; ++i) {
      if (i * i + j * j <= kHalfSide * kHalfSide) {
        const double x = kReach * i / kHalfSide;
        const double y = kReach * j / kHalfSide;
        const int part = (i < 0 ? 4 : 0) + (j < 0 ? 2 : 0) + (i * i > j * j ? 1 : 0);
        cells[count++] = {x, y, x * x + y * y > kAround * kAround ? part : -1};
      }
    }
  }
  return cells;
}
constexpr auto kGrid = make_cells<149>();

Eigen::Vector3d row_of(const Cell& cell) { return {1.0, cell.x, cell.y}; }

Eigen::Vector2d place_of(const Sitting& sitting, const Cell& cell) {
  return sitting.center_px + sitting.radius_px * Eigen::Vector2d(cell.x, cell.y);
}

// level_at() is the mean of five pixels.
constexpr double kOfPixel = 0.2;

/// The variance of a level's noise, by what pixels differ from those beside them in their line.
double noise_around(const picture::AveragedPicture& picture, const Sitting& place) {
  constexpr double kMostOff = 4.0;       // grey levels; more is an edge
  constexpr double kOfMean = 0.9772050;  // of that difference's size, for noise of one
  double sum = 0.0;
  double count = 0.0;
  for (const Cell& cell : kGrid) {
    const Eigen::Vector2d at = place_of(place, cell);
    const auto u = static_cast<std::int32_t>(std::lround(at.x()));
    const auto v = static_cast<std::int32_t>(std::lround(at.y()));
    if (u >= 1 && v >= 0 && u <= picture.width_px - 2 && v <= picture.height_px - 1) {
      const double off = picture.at(u, v) - 0.5 * (picture.at(u - 1, v) + picture.at(u + 1, v));
      sum += std::min(kMostOff, std::abs(off) / picture::kGreyScale);
      count += 1.0;
    }
  }
  const double sigma = count > 0.0 ? sum / count / kOfMean : 0.0;
  return kOfPixel * sigma * sigma;
}

/// Puts a value where it belongs among the first so many, which are in order.
template <typename Value, std::size_t kSize>
void insert(std::array<Value, kSize>& values, std::size_t count, Value value) {
  for (; count > 0 && values[count - 1] > value; --count) {
    values[count] = values[count - 1];
  }
  values[count] = value;
}

}  // namespace

Sitting sitting_of(const Ellipse& ellipse, const Eigen::Matrix2d& radius_px) {
  // Any turn of the unit circle before the root gives the ellipse; the one nearest to what is asked
  // for, mirrored if that is.
  const Eigen::Matrix2d root = root_of(ellipse.shape_px2);
  const Eigen::Matrix2d turn = root.inverse() * radius_px;
  const double side = radius_px.determinant() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector2d way =
      Eigen::Vector2d(turn(0, 0) + side * turn(1, 1), turn(1, 0) - side * turn(0, 1)).normalized();
  Eigen::Matrix2d nearest;
  nearest << way.x(), -side * way.y(), way.y(), side * way.x();
  return {ellipse.center_px, root * nearest};
}

void PortraitGallery::take(const picture::AveragedPicture& picture, const Sitting& sitting,
                           Portrait& portrait) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < kCells; ++k) {
    const Eigen::Vector2d at = place_of(sitting, kGrid[k]);
    portrait.seen[k] = at.minCoeff() >= 0.0 && at.x() <= picture.width_px - 1.0 &&
                       at.y() <= picture.height_px - 1.0;
    if (portrait.seen[k]) {
      const double level = level_at(picture, at);
      portrait.level[k] = static_cast<float>(level);
      const Eigen::Vector3d row = row_of(kGrid[k]);
      normal += row * row.transpose();
      right += level * row;
    }
  }
  portrait.count = normal(0, 0);
  const double determinant = normal.determinant();
  const Eigen::Vector3d plane =
      determinant > 0.0 ? Eigen::Vector3d(normal.inverse() * right) : Eigen::Vector3d::Zero();
  double square = 0.0;
  for (std::size_t k = 0; k < kCells; ++k) {
    const double light = portrait.seen[k]
                             ? static_cast<double>(portrait.level[k]) - plane.dot(row_of(kGrid[k]))
                             : 0.0;
    portrait.light[k] = static_cast<float>(light);
    square += light * light;
  }
  portrait.square = determinant > 0.0 ? square / portrait.count : 0.0;
  measure_around(portrait);
}

void PortraitGallery::measure_around(Portrait& portrait) {
  std::array<double, kParts> sum{};
  std::array<double, kParts> count{};
  for (std::size_t k = 0; k < kCells; ++k) {
    if (portrait.seen[k] && kGrid[k].part >= 0) {
      const auto part = static_cast<std::size_t>(kGrid[k].part);
      sum[part] += static_cast<double>(portrait.level[k]);
      count[part] += 1.0;
    }
  }
  std::array<double, kParts> means{};
  std::size_t parts = 0;
  double all = 0.0;
  double cells = 0.0;
  for (std::size_t i = 0; i < kParts; ++i) {
    if (count[i] > 0.0) {
      insert(means, parts++, sum[i] / count[i]);
      all += sum[i];
      cells += count[i];
    }
  }
  portrait.around = cells > 0.0 ? all / cells : 0.0;
  const double median = means[parts / 2 < kParts ? parts / 2 : 0];
  portrait.evenness = median > 0.0 ? means[0] / median : 0.0;
}

bool PortraitGallery::hang(const picture::AveragedPicture& picture,
                           std::span<const Sitting> sitters) {
  std::size_t count = 0;
  contrast_ = 0.0;
  evenness_ = 0.0;
  for (const Sitting& sitter : sitters) {
    if (count == kMost) {
      break;
    }
    Portrait& portrait = portraits_[count];
    take(picture, sitter, portrait);
    const double square = portrait.square - noise_around(picture, sitter);
    if (!(square > 0.0 && portrait.around > 0.0)) {
      continue;
    }
    const double contrast = std::sqrt(square);
    contrast_ += contrast / portrait.around;
    evenness_ += portrait.evenness;
    for (float& light : portrait.light) {
      light = static_cast<float>(static_cast<double>(light) / contrast);
    }
    ++count;
  }
  if (count < 2) {
    return false;
  }
  contrast_ /= static_cast<double>(count);
  evenness_ /= static_cast<double>(count);
  find_usual(count);
  return true;
}

/// The median of each cell: what hides one of the neighbours is not in it.
void PortraitGallery::find_usual(std::size_t count) {
  for (std::size_t k = 0; k < kCells; ++k) {
    std::array<float, kMost> lights{};
    std::size_t some = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (portraits_[i].seen[k]) {
        insert(lights, some++, portraits_[i].light[k]);
      }
    }
    usual_.seen[k] = 2 * some >= count;
    usual_.light[k] = usual_.seen[k] ? 0.5F * (lights[(some - 1) / 2] + lights[some / 2]) : 0.0F;
  }
}

double PortraitGallery::alike(const Portrait& portrait) const {
  float both = 0.0F;
  float own = 0.0F;
  float usual = 0.0F;
  for (std::size_t k = 0; k < kCells; ++k) {
    if (portrait.seen[k] && usual_.seen[k]) {
      both += portrait.light[k] * usual_.light[k];
      own += portrait.light[k] * portrait.light[k];
      usual += usual_.light[k] * usual_.light[k];
    }
  }
  return own > 0.0F && usual > 0.0F ? static_cast<double>(both / std::sqrt(own * usual)) : 0.0;
}

Resemblance PortraitGallery::compare(const picture::AveragedPicture& picture, const Sitting& place,
                                     double reach_px) {
  // Where the neighbours let expect it a place is to a pixel, or to a share of a large one's size.
  constexpr double kLeastSigma_px = 1.0;
  constexpr double kSigma = 0.05;
  constexpr double kPerSigma2 = 0.05;    // of the correlation
  constexpr double kWorthLooking = 0.2;  // below, a pixel more or less does not make it one
  const double radius_px = std::sqrt(std::abs(place.radius_px.determinant()));
  const double sigma_px = std::max(kLeastSigma_px, kSigma * radius_px);
  const double noise = noise_around(picture, place);
  Resemblance best;
  double most = -1e9;
  const auto look = [&](const Eigen::Vector2d& shift_px) {
    take(picture, {place.center_px + shift_px, place.radius_px}, trial_);
    const double there = alike(trial_);
    const double weighed = there - kPerSigma2 * shift_px.squaredNorm() / (sigma_px * sigma_px);
    if (weighed <= most) {
      return;
    }
    most = weighed;
    best.seen = trial_.count / static_cast<double>(kCells);
    best.alike = there;
    const double of_noise = trial_.square > 0.0 ? noise / trial_.square : 1.0;
    constexpr double kLeastRest = 0.05;
    best.without_noise = there / std::sqrt(std::max(kLeastRest, 1.0 - of_noise));
    best.depth = there * std::sqrt(trial_.square) / std::max(1.0, trial_.around) / contrast_;
    constexpr double kLeastEvenness = 0.1;
    best.evenness = trial_.evenness / std::max(kLeastEvenness, evenness_);
    best.shift_px = shift_px;
  };
  look(Eigen::Vector2d::Zero());
  for (const double step : {2.0, 1.0}) {
    for (bool better = true; better;) {
      const Eigen::Vector2d from = best.shift_px;
      for (int i = 0; i < 9; ++i) {
        const Eigen::Vector2d there = from + step * Eigen::Vector2d(i % 3 - 1, i / 3 - 1);
        if (i != 4 && there.norm() <= reach_px) {
          look(there);
        }
      }
      better = best.shift_px != from;
    }
    if (best.alike < kWorthLooking) {
      break;
    }
  }
  // Independent levels are no more than the cells, and one in some three pixels: a pixel's noise is
  // in five of the means.
  constexpr double kOfPixels = 0.4;
  const double pixels = std::numbers::pi * kReach * kReach * radius_px * radius_px;
  best.sigmas =
      best.alike * std::sqrt(best.seen * std::min(kOfPixels * pixels, static_cast<double>(kCells)));
  return best;
}

HalfResemblance PortraitGallery::compare_halves(const picture::AveragedPicture& picture,
                                                const Sitting& place) {
  take(picture, place, trial_);
  HalfResemblance best;
  constexpr int kWays = 16;
  for (int way = 0; way < kWays; ++way) {
    const double angle = 2.0 * std::numbers::pi * way / kWays;
    const HalfResemblance half = compare_half({std::cos(angle), std::sin(angle)});
    if (half.alike > best.alike) {
      best = half;
    }
  }
  return best;
}

/// The half of the place on one side of its middle; its own mean and slope are left out of both.
HalfResemblance PortraitGallery::compare_half(const Eigen::Vector2d& towards) const {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d own = Eigen::Vector3d::Zero();
  Eigen::Vector3d usual = Eigen::Vector3d::Zero();
  double own2 = 0.0;
  double both = 0.0;
  double usual2 = 0.0;
  for (std::size_t k = 0; k < kCells; ++k) {
    const Cell& cell = kGrid[k];
    if (trial_.seen[k] && usual_.seen[k] && cell.x * towards.x() + cell.y * towards.y() >= 0.0) {
      const Eigen::Vector3d row = row_of(cell);
      const auto level = static_cast<double>(trial_.level[k]);
      const auto light = static_cast<double>(usual_.light[k]);
      normal += row * row.transpose();
      own += level * row;
      usual += light * row;
      own2 += level * level;
      both += level * light;
      usual2 += light * light;
    }
  }
  constexpr double kLeastCells = 0.35;
  if (normal(0, 0) < kLeastCells * static_cast<double>(kCells)) {
    return {};
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  own2 -= own.dot(inverse * own);
  both -= own.dot(inverse * usual);
  usual2 -= usual.dot(inverse * usual);
  if (!(own2 > 0.0 && usual2 > 0.0)) {
    return {};
  }
  const double level = std::max(1.0, own(0) / normal(0, 0));
  return {both / std::sqrt(own2 * usual2), both / usual2 / level / contrast_};
}

}  // namespace tubesight::core::detection
