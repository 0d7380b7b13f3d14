#include "core/tubesheet/lattice.h"

#include "core/base/instantiate.h"

namespace tubesight::core::tubesheet {
namespace {

template <typename T>
std::int32_t nearest_integer(T value) {
  return to_scaled(value, 0);
}

// Whole numbers of two steps, never rounded: in fixed point the two shares of a skewed numbering
// may each be larger than the format, though their sum is not.
template <typename T>
T combination(T row_step, std::int32_t rows, T column_step, std::int32_t columns) {
  if constexpr (std::floating_point<T>) {
    return row_step * static_cast<T>(rows) + column_step * static_cast<T>(columns);
  } else {
    return T::from_wide_raw(std::int64_t{row_step.raw()} * rows +
                            std::int64_t{column_step.raw()} * columns);
  }
}

}  // namespace

template <Scalar S>
Vector2<Mm<S>> Lattice<S>::offset(TubeAddress anchor, TubeAddress address) const {
  const std::int32_t rows = address.row - anchor.row;
  const std::int32_t columns = address.column - anchor.column;
  const auto& p = parameters_;
  return {combination(p.row_step.x, rows, p.column_step.x, columns),
          combination(p.row_step.y, rows, p.column_step.y, columns)};
}

template <Scalar S>
TubeAddress Lattice<S>::nearest(TubeAddress anchor, const Vector2<Mm<S>>& point) const {
  const auto& p = parameters_;
  const auto coordinate = [&point](const Vector2<Unit<S>>& row) {
    return nearest_integer(narrow<Mm<S>>(product(row.x, point.x) + product(row.y, point.y)));
  };
  const std::int32_t i = coordinate(p.inverse[0]);
  const std::int32_t j = coordinate(p.inverse[1]);
  const TubeAddress start{anchor.row + i * p.basis[0].row + j * p.basis[1].row,
                          anchor.column + i * p.basis[0].column + j * p.basis[1].column};
  // Rounding in a reduced basis lands on the nearest point or on a neighbour of it.
  TubeAddress best = start;
  auto best_distance = [&] {
    const auto d = point - offset(anchor, start);
    return product(d.x, d.x) + product(d.y, d.y);
  }();
  for (const Neighbour& neighbour : p.neighbours) {
    const TubeAddress candidate{start.row + neighbour.offset.row,
                                start.column + neighbour.offset.column};
    const auto d = point - offset(anchor, candidate);
    const auto distance = product(d.x, d.x) + product(d.y, d.y);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

template <Scalar S>
Mm<S> Lattice<S>::distance_to_cell_edge(const Vector2<Mm<S>>& point) const {
  Mm<S> least = parameters_.neighbours[0].half_distance + parameters_.neighbours[0].half_distance;
  for (const Neighbour& neighbour : parameters_.neighbours) {
    const Mm<S> along = narrow<Mm<S>>(product(neighbour.direction.x, point.x) +
                                      product(neighbour.direction.y, point.y));
    const Mm<S> distance = neighbour.half_distance - along;
    if (distance < least) {
      least = distance;
    }
  }
  return least;
}

TUBESIGHT_INSTANTIATE_CLASS(Lattice)

}  // namespace tubesight::core::tubesheet
