#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/detection/ellipse.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// Where a portrait is taken.
struct Sitting {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  /// Turns the lattice's own plane, in radii of an element, into pixels.
  Eigen::Matrix2d radius_px = Eigen::Matrix2d::Identity();
};

/// The sitting of an element that shows as this ellipse, turned as nearly as `radius_px` is.
[[nodiscard]] Sitting sitting_of(const Ellipse& ellipse, const Eigen::Matrix2d& radius_px);

/// How a place looks beside what the tube-ends around it let expect.
struct Resemblance {
  double seen = 0.0;           ///< of the place, that is in the picture
  double alike = 0.0;          ///< correlation with the neighbours' common look, -1 to 1
  double without_noise = 0.0;  ///< the same without what the picture's noise takes from it
  double sigmas = 0.0;         ///< of the correlation that noise alone gives
  double depth = 0.0;          ///< its contrasts over the neighbours', for the light there
  double evenness = 0.0;  ///< the darkest eighth around over the median one, by the neighbours'
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  ///< to where it is most alike
};

/// The same of the half of a place that is most alike.
struct HalfResemblance {
  double alike = -1.0;
  double depth = 0.0;
};

/// Portraits of neighbours. What all have in common is what a tube-end that is hardly seen looks
/// like between them: rim, weld, the weld's shadow, and the slope of the light inside, lit from
/// where they are lit and seen from where they are seen. Compared all over, a place shows itself at
/// a contrast of half the noise of a pixel.
///
/// A portrait is the light in 149 cells of the lattice's plane, less its mean and its slope. Some
/// 10 KB: in a workspace.
class PortraitGallery {
 public:
  static constexpr std::size_t kMost = 6;

  /// Takes the portraits of up to kMost neighbours. False: fewer than two show anything.
  [[nodiscard]] bool hang(const picture::AveragedPicture& picture,
                          std::span<const Sitting> sitters);

  /// Compares a place, and those up to `reach_px` off it: the farther off, the more alike it has to
  /// be. In a picture whose darkest is zero. After hang().
  [[nodiscard]] Resemblance compare(const picture::AveragedPicture& picture, const Sitting& place,
                                    double reach_px);

  /// Compares the halves of a place, cut in sixteen directions.
  [[nodiscard]] HalfResemblance compare_halves(const picture::AveragedPicture& picture,
                                               const Sitting& place);

 private:
  static constexpr std::size_t kCells = 149;
  struct Portrait {
    std::array<bool, kCells> seen{};
    std::array<float, kCells> level{};  ///< grey levels
    std::array<float, kCells> light{};  ///< less mean and slope; of the neighbours, over contrast
    double count = 0.0;                 ///< of cells seen
    double square = 0.0;                ///< mean of the squares of the light
    double around = 0.0;                ///< level beside the rim
    double evenness = 0.0;              ///< there, the darkest eighth over the median one
  };
  static void take(const picture::AveragedPicture& picture, const Sitting& sitting,
                   Portrait& portrait);
  static void measure_around(Portrait& portrait);
  void find_usual(std::size_t count);
  [[nodiscard]] double alike(const Portrait& portrait) const;
  [[nodiscard]] HalfResemblance compare_half(const Eigen::Vector2d& towards) const;

  std::array<Portrait, kMost> portraits_;
  Portrait usual_;         ///< the neighbours' median, cell by cell
  Portrait trial_;         ///< the place compared
  double contrast_ = 0.0;  ///< of the neighbours: RMS of the light over the level around
  double evenness_ = 0.0;  ///< of the neighbours
};

}  // namespace tubesight::core::detection
