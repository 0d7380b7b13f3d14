#pragma once

#include <array>
#include <cstdint>

#include "core/base/scalar.h"
#include "core/base/tube_address.h"
#include "core/base/vector3.h"

namespace tubesight::core::tubesheet {

/// The regular grid of tube-ends: addresses to millimetres and back, for square, triangular and
/// oblique pitches, left-handed steps and numberings that leave out every other address.
///
/// Millimetres are counted from the centre of an anchor address, parallel to the sheet frame, so
/// that numbers stay small wherever on the sheet the tool is: |x|, |y| up to 1500 mm.
template <Scalar S>
class Lattice {
 public:
  /// A neighbour of every existing address: the line halfway to it bounds the tube's own cell.
  struct Neighbour {
    TubeAddress offset;
    Vector2<Unit<S>> direction;  ///< unit vector towards it
    Mm<S> half_distance{};
  };

  /// All that the path needs; see make_lattice() in tubesheet_setup.h.
  struct Parameters {
    Vector2<Mm<S>> row_step;
    Vector2<Mm<S>> column_step;
    /// The shortest two steps between existing addresses, and the rows of their inverse (per mm).
    std::array<TubeAddress, 2> basis{};
    std::array<Vector2<Unit<S>>, 2> inverse{};
    /// Cells of a plane lattice have at most six sides; eight neighbours cover them.
    std::array<Neighbour, 8> neighbours{};
    Mm<S> shortest_step{};
    bool every_other = false;  ///< only addresses whose row + column has `parity` exist
    std::int32_t parity = 0;
  };

  Lattice() = default;
  explicit Lattice(const Parameters& parameters) : parameters_(parameters) {}

  /// Whether the numbering has this address at all (its parity fits).
  [[nodiscard]] bool has(TubeAddress address) const {
    return !parameters_.every_other || ((address.row + address.column) & 1) == parameters_.parity;
  }

  /// Centre of `address` seen from the centre of `anchor`, mm. Addresses up to 1500 mm apart.
  [[nodiscard]] Vector2<Mm<S>> offset(TubeAddress anchor, TubeAddress address) const;

  /// The existing address nearest to a point given from the centre of the existing `anchor`.
  [[nodiscard]] TubeAddress nearest(TubeAddress anchor, const Vector2<Mm<S>>& point) const;

  /// How far `point` (from the centre of a tube, within its cell) is from the nearest edge of that
  /// tube's cell: the distance to the rounding limit of the address, mm; negative outside.
  [[nodiscard]] Mm<S> distance_to_cell_edge(const Vector2<Mm<S>>& point) const;

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

 private:
  Parameters parameters_{};
};

}  // namespace tubesight::core::tubesheet
