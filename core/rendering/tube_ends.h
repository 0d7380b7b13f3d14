#pragma once

#include <array>
#include <cstdint>

#include "core/base/result.h"
#include "core/base/tube_address.h"
#include "core/rendering/scene.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::rendering {

/// What stands at an address; the states of a truth file.
enum class TubeEndKind : std::uint8_t { kOpen, kPlugRolled, kPlugFlush, kVoid };

/// One tube-end as it truly is.
struct TubeEnd {
  TubeEndKind kind = TubeEndKind::kVoid;
  std::array<double, 3> center_mm{};  ///< of the rim, sheet frame; z is 0 unless displaced
  double radius_mm = 0.0;             ///< of the bore, with its own spread
};

/// An address and how far its centre is away.
struct NearestTube {
  TubeAddress address;
  TubeEndKind kind = TubeEndKind::kVoid;
  std::array<double, 2> off_mm{};  ///< from the tube's centre to the point, sheet frame
  double offset_mm = 0.0;          ///< its length
};

/// The true tube-ends of a scene by address. About 400 KB: static or heap.
class TubeEnds {
 public:
  /// Takes the scene's sheet over. kInvalidArgument: first address beyond last, parallel steps, a
  /// shift of odd rows above a step or a bore not above zero.
  [[nodiscard]] Result<void> configure(const Scene& scene);

  /// What stands at `address`.
  [[nodiscard]] TubeEnd at(TubeAddress address) const;
  /// The address of the lattice nearest to a point of the sheet, mm, whatever stands there (kVoid
  /// when it is missing or outside the sheet; addresses that the parity leaves out are never
  /// named).
  [[nodiscard]] NearestTube nearest(const std::array<double, 2>& point_mm) const;
  /// Centre of an address by the lattice alone, sheet frame.
  [[nodiscard]] std::array<double, 2> lattice_point(TubeAddress address) const;

 private:
  [[nodiscard]] TubeEndKind kind_at(TubeAddress address) const;

  tubesheet::SheetMap map_;
  StaticVector<Plug, kMaxPlugs> plugs_;                        // sorted by address
  StaticVector<DisplacedTube, kMaxDisplacedTubes> displaced_;  // sorted by address
  std::array<double, 2> origin_mm_{};
  std::array<double, 2> row_step_mm_{};
  std::array<double, 2> column_step_mm_{};
  AddressParity addresses_ = AddressParity::kAll;
  double odd_row_shift_ = 0.0;
  double bore_mm_ = 0.0;
  double bore_spread_mm_ = 0.0;
  std::uint64_t seed_ = 0;
};

}  // namespace tubesight::core::rendering
