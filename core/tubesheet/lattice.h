#pragma once

#include <array>
#include <cstdint>

#include "core/base/scalar.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"
#include "core/tubesheet/addresses.h"

namespace tubesight::core::tubesheet {

/// The regular grid of tube-ends: addresses to millimetres and back, for square, triangular and
/// oblique pitches, left-handed steps, numberings that leave out every other address, and rows of
/// odd number that stand a share of a column step further.
///
/// With such a shift the tubes are of two kinds, those of even and of odd rows: each kind is a
/// lattice by itself, and turned by 180 degrees the one is the other. A step from tube to tube then
/// is no symmetry unless its number of rows is even.
///
/// Millimetres are counted from the centre of an anchor address, parallel to the sheet frame, so
/// that numbers stay small wherever on the sheet the tool is: |x|, |y| up to 1500 mm.
template <Scalar S>
class Lattice {
 public:
  /// A neighbour of a tube: the line halfway to it bounds the tube's own cell.
  struct Neighbour {
    TubeAddress offset;
    Vector2<Unit<S>> direction;  ///< unit vector towards it
    Mm<S> half_distance{};
  };

  /// All that the path needs; see make_lattice() in tubesheet_setup.h.
  struct Parameters {
    Vector2<Mm<S>> row_step;
    Vector2<Mm<S>> column_step;
    Vector2<Mm<S>> odd_row_shift;  ///< how much further rows of odd number stand
    /// The shortest two steps that lead from tubes to tubes of their kind, and the rows of their
    /// inverse (per mm).
    std::array<TubeAddress, 2> basis{};
    std::array<Vector2<Unit<S>>, 2> inverse{};
    /// A short step from tubes of even rows to tubes of odd rows; none without a shift, when all
    /// tubes are of one kind.
    TubeAddress to_odd_rows{};
    bool two_kinds = false;
    /// Those of a tube in an even row; a tube in an odd row has them on the opposite sides. Cells
    /// have six sides at most, for such are the means over both kinds and the kinds are alike;
    /// eight neighbours cover them.
    std::array<Neighbour, 8> neighbours{};
    Mm<S> shortest_step{};  ///< between any two tubes
    AddressParity addresses = AddressParity::kAll;
  };

  Lattice() = default;
  explicit Lattice(const Parameters& parameters) : parameters_(parameters) {}

  /// Whether the numbering has this address at all (its parity fits).
  [[nodiscard]] bool has(TubeAddress address) const {
    return exists(parameters_.addresses, address);
  }

  /// Centre of `address` seen from the centre of `anchor`, mm. Addresses up to 1500 mm apart.
  [[nodiscard]] Vector2<Mm<S>> offset(TubeAddress anchor, TubeAddress address) const;

  /// The existing address nearest to a point given from the centre of the existing `anchor`.
  [[nodiscard]] TubeAddress nearest(TubeAddress anchor, const Vector2<Mm<S>>& point) const;

  /// How far `point` (from the centre of `tube`, within its cell) is from the nearest edge of that
  /// tube's cell: the distance to the rounding limit of the address, mm; negative outside.
  [[nodiscard]] Mm<S> distance_to_cell_edge(TubeAddress tube, const Vector2<Mm<S>>& point) const;

  /// An existing address of the other kind beside the existing `address`; only with two kinds.
  [[nodiscard]] TubeAddress other_kind(TubeAddress address) const {
    return in_odd_row(address) ? difference(address, parameters_.to_odd_rows)
                               : sum(address, parameters_.to_odd_rows);
  }

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

 private:
  struct Distance;
  [[nodiscard]] Distance nearest_of_kind(TubeAddress anchor, TubeAddress first,
                                         const Vector2<Mm<S>>& point) const;

  Parameters parameters_{};
};

}  // namespace tubesight::core::tubesheet
