#include "core/tubesheet/tubesheet_setup.h"

#include <cmath>
#include <utility>

#include "core/base/instantiate.h"

namespace tubesight::core::tubesheet {
namespace {

struct Step {
  TubeAddress address;
  double x = 0.0;
  double y = 0.0;

  [[nodiscard]] double length2() const { return x * x + y * y; }
};

Step combined(const Step& a, std::int32_t count, const Step& b) {
  const auto n = static_cast<double>(count);
  return {{a.address.row + count * b.address.row, a.address.column + count * b.address.column},
          a.x + n * b.x,
          a.y + n * b.y};
}

// Gauss's reduction of a plane lattice: the result's first step is the shortest there is. A pair
// whose angle is between 5 and 175 degrees reduces in a few rounds; the bound is for bad input.
void reduce(Step& a, Step& b) {
  for (int round = 0; round < 64; ++round) {
    if (b.length2() < a.length2()) {
      std::swap(a, b);
    }
    const double share = (a.x * b.x + a.y * b.y) / a.length2();
    const auto count = static_cast<std::int32_t>(share + (share < 0.0 ? -0.5 : 0.5));
    if (count == 0) {
      return;
    }
    b = combined(b, -count, a);
  }
}

}  // namespace

template <Scalar S>
Result<Lattice<S>> make_lattice(const TubesheetSettings& settings) {
  const Step row{{1, 0}, settings.row_step_mm[0], settings.row_step_mm[1]};
  const Step column{{0, 1}, settings.column_step_mm[0], settings.column_step_mm[1]};
  // Below 1 mm even every other address would leave steps under 2 mm; NaN is refused too.
  const auto fits = [](const Step& step) {
    return step.length2() >= 1.0 && step.length2() <= 250000.0;
  };
  if (!fits(row) || !fits(column)) {
    return Unexpected(Error::kOutOfRange);
  }
  const double area = row.x * column.y - row.y * column.x;
  if (!(area * area > 0.0075 * row.length2() * column.length2())) {  // sine of 5 degrees, squared
    return Unexpected(Error::kIllConditioned);
  }
  const bool every_other = settings.addresses != AddressParity::kAll;
  Step a = every_other ? combined(row, 1, column) : row;
  Step b = every_other ? combined(row, -1, column) : column;
  reduce(a, b);
  const double shortest = std::sqrt(a.length2());
  if (!(shortest >= 2.0)) {
    return Unexpected(Error::kOutOfRange);
  }

  typename Lattice<S>::Parameters p;
  p.row_step = {Mm<S>(row.x), Mm<S>(row.y)};
  p.column_step = {Mm<S>(column.x), Mm<S>(column.y)};
  p.basis = {a.address, b.address};
  const double cell = a.x * b.y - a.y * b.x;
  p.inverse[0] = {Unit<S>(b.y / cell), Unit<S>(-b.x / cell)};
  p.inverse[1] = {Unit<S>(-a.y / cell), Unit<S>(a.x / cell)};
  p.shortest_step = Mm<S>(shortest);
  p.every_other = every_other;
  p.parity = settings.addresses == AddressParity::kOddSum ? 1 : 0;
  std::size_t next = 0;
  for (std::int32_t i = -1; i <= 1; ++i) {
    for (std::int32_t j = -1; j <= 1; ++j) {
      if (i == 0 && j == 0) {
        continue;
      }
      const Step step = combined(combined({}, i, a), j, b);
      const double length = std::sqrt(step.length2());
      p.neighbours[next++] = {
          step.address, {Unit<S>(step.x / length), Unit<S>(step.y / length)}, Mm<S>(length / 2.0)};
    }
  }
  return Lattice<S>(p);
}

#define TUBESIGHT_INSTANTIATE(S) \
  template Result<Lattice<S>> make_lattice<S>(const TubesheetSettings&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tubesheet
