#include "core/tubesheet/lattice.h"

#include "core/base/instantiate.h"

namespace tubesight::core::tubesheet {
namespace {

template <typename T>
std::int32_t nearest_integer(T value) {
  return to_scaled(value, 0);
}

// Whole numbers of two steps and what is added, never rounded: in fixed point the two shares of a
// skewed numbering may each be larger than the format, though their sum is not.
template <typename T>
T combination(T row_step, std::int32_t rows, T column_step, std::int32_t columns, T added) {
  if constexpr (std::floating_point<T>) {
    return row_step * static_cast<T>(rows) + column_step * static_cast<T>(columns) + added;
  } else {
    return T::from_wide_raw(std::int64_t{row_step.raw()} * rows +
                            std::int64_t{column_step.raw()} * columns + added.raw());
  }
}

}  // namespace

template <Scalar S>
Vector2<Mm<S>> Lattice<S>::offset(TubeAddress anchor, TubeAddress address) const {
  const std::int32_t rows = address.row - anchor.row;
  const std::int32_t columns = address.column - anchor.column;
  const auto& p = parameters_;
  Vector2<Mm<S>> shift{};
  if (in_odd_row({rows, columns})) {
    shift = in_odd_row(address) ? p.odd_row_shift : shift - p.odd_row_shift;
  }
  return {combination(p.row_step.x, rows, p.column_step.x, columns, shift.x),
          combination(p.row_step.y, rows, p.column_step.y, columns, shift.y)};
}

// An address and the square of a point's distance from it, not yet narrowed.
template <Scalar S>
struct Lattice<S>::Distance {
  TubeAddress address;
  decltype(product(Mm<S>{}, Mm<S>{})) square{};
};

// The nearest to a point (from the anchor) among the addresses of the kind of `first`.
template <Scalar S>
auto Lattice<S>::nearest_of_kind(TubeAddress anchor, TubeAddress first,
                                 const Vector2<Mm<S>>& point) const -> Distance {
  const auto& p = parameters_;
  const auto from_first = point - offset(anchor, first);
  const auto coordinate = [&from_first](const Vector2<Unit<S>>& row) {
    return nearest_integer(
        narrow<Mm<S>>(product(row.x, from_first.x) + product(row.y, from_first.y)));
  };
  const std::int32_t i = coordinate(p.inverse[0]);
  const std::int32_t j = coordinate(p.inverse[1]);
  const auto candidate = [&](std::int32_t more_i, std::int32_t more_j) {
    const std::int32_t a = i + more_i;
    const std::int32_t b = j + more_j;
    const TubeAddress address{first.row + a * p.basis[0].row + b * p.basis[1].row,
                              first.column + a * p.basis[0].column + b * p.basis[1].column};
    const auto d = point - offset(anchor, address);
    return Distance{address, product(d.x, d.x) + product(d.y, d.y)};
  };
  // Rounding in a reduced basis lands on the nearest point or on a neighbour of it.
  Distance best = candidate(0, 0);
  for (std::int32_t more_i = -1; more_i <= 1; ++more_i) {
    for (std::int32_t more_j = -1; more_j <= 1; ++more_j) {
      const Distance other = candidate(more_i, more_j);
      best = other.square < best.square ? other : best;
    }
  }
  return best;
}

template <Scalar S>
TubeAddress Lattice<S>::nearest(TubeAddress anchor, const Vector2<Mm<S>>& point) const {
  const Distance same = nearest_of_kind(anchor, anchor, point);
  if (!parameters_.two_kinds) {
    return same.address;
  }
  const Distance other = nearest_of_kind(anchor, other_kind(anchor), point);
  return other.square < same.square ? other.address : same.address;
}

template <Scalar S>
Mm<S> Lattice<S>::distance_to_cell_edge(TubeAddress tube, const Vector2<Mm<S>>& point) const {
  const bool turned = parameters_.two_kinds && in_odd_row(tube);
  const Vector2<Mm<S>> in_even_row = turned ? Vector2<Mm<S>>{-point.x, -point.y} : point;
  Mm<S> least = parameters_.neighbours[0].half_distance + parameters_.neighbours[0].half_distance;
  for (const Neighbour& neighbour : parameters_.neighbours) {
    const Mm<S> along = narrow<Mm<S>>(product(neighbour.direction.x, in_even_row.x) +
                                      product(neighbour.direction.y, in_even_row.y));
    const Mm<S> distance = neighbour.half_distance - along;
    if (distance < least) {
      least = distance;
    }
  }
  return least;
}

TUBESIGHT_INSTANTIATE_CLASS(Lattice)

}  // namespace tubesight::core::tubesheet
