#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/settings/table_reader.h"

namespace tubesight::drivers {

/// Points that an edge of the guidetube's outline may have.
inline constexpr std::size_t kMostSilhouettePoints = 64;

/// One edge of the outline, full-frame pixels; no points: it is outside the picture.
struct SilhouetteEdgeSettings {
  std::vector<std::array<double, 2>> points_px;
  double sigma_px = 0.0;  ///< across the edge
  bool measured = false;  ///< found in the docked picture; else computed from tip, axis and size
};

/// Where the guidetube's outline stands in the picture: the table `[silhouette]`, which
/// `calibrate tool` writes.
struct SilhouetteSettings {
  double diameter_mm = 0.0;  ///< of the guidetube; 0: there is no table
  double length_mm = 0.0;    ///< as far as it is seen below the tip
  /// Left, tip, right: sides from the tip down, the tip's rim from left to right, with the tip
  /// upwards.
  std::array<SilhouetteEdgeSettings, 3> edges;
};

/// The words for the edges: keys `left_px`, `tip_px`, `right_px`, and entries of `measured`.
inline constexpr std::array<std::string_view, 3> kSilhouetteEdges = {"left", "tip", "right"};

/// `[silhouette]`. Replaces everything in `silhouette`.
void read_silhouette(TableReader& table, SilhouetteSettings& silhouette);

/// The table's text, which reads back as the same to a thousandth of a pixel.
[[nodiscard]] std::string silhouette_text(const SilhouetteSettings& silhouette);

}  // namespace tubesight::drivers
