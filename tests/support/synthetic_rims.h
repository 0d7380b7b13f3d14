#pragma once

#include <cstdint>
#include <vector>

#include "core/base/settings.h"
#include "core/base/tube_address.h"
#include "core/picture/rim.h"
#include "tests/support/synthetic_sheet.h"

namespace tubesight::tests {

/// Normal deviates, the same on every machine but for libm's last bit.
class Deviates {
 public:
  explicit Deviates(std::uint64_t seed) : state_(seed * 2654435769U + 88172645463325252U) {}

  [[nodiscard]] double uniform();  ///< 0 <= x < 1
  [[nodiscard]] double normal();   ///< mean 0, deviation 1

 private:
  std::uint64_t state_;
};

/// What measured rims are like.
struct RimLook {
  std::int32_t points = 64;      ///< of a whole rim
  double noise_px = 0.0;         ///< across the edge
  double sigma_px = 0.1;         ///< told of each point
  double offset_px = 0.0;        ///< of all edges, outwards
  double bore_sigma_mm = 0.0;    ///< of diameters
  double center_sigma_mm = 0.0;  ///< of centres from the lattice, each of x and y
  double height_sigma_mm = 0.0;  ///< of tube-ends out of the plane
  double arc_deg = 360.0;        ///< that is seen of each rim, from 0 degrees of the sheet on
  double outlier_share = 0.0;    ///< of points, up to 3 px off
};

/// Rim points of tube-ends as SyntheticSheet projects them, independent of core/pose. Rims that
/// don't lie wholly in the picture are left out.
void make_rims(const SyntheticSheet& sheet, const core::SessionSettings& settings,
               const ToolPlace& place, const std::vector<core::TubeAddress>& addresses,
               const RimLook& look, Deviates& deviates, core::picture::RimList& rims);

/// The addresses nearest to where the tool's axis meets the sheet, nearest first; `half` rows and
/// columns to every side are looked at.
[[nodiscard]] std::vector<core::TubeAddress> addresses_around(const SyntheticSheet& sheet,
                                                              const ToolPlace& place,
                                                              std::size_t count,
                                                              std::int32_t half = 4);

}  // namespace tubesight::tests
