#include "core/tubesheet/tubesheet_setup.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/base/instantiate.h"
#include "core/base/static_vector.h"
#include "core/tubesheet/sheet_places.h"

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

std::int32_t nearest_whole(double value) {
  return static_cast<std::int32_t>(value + (value < 0.0 ? -0.5 : 0.5));
}

// Gauss's reduction of a plane lattice: the result's first step is the shortest there is. A pair
// whose angle is between 5 and 175 degrees reduces in a few rounds; the bound is for bad input.
void reduce(Step& a, Step& b) {
  for (int round = 0; round < 64; ++round) {
    if (b.length2() < a.length2()) {
      std::swap(a, b);
    }
    const double share = (a.x * b.x + a.y * b.y) / a.length2();
    const std::int32_t count = nearest_whole(share);
    if (count == 0) {
      return;
    }
    b = combined(b, -count, a);
  }
}

// The short steps of a numbering, in double precision.
struct ShortSteps {
  // From tubes to tubes of their kind: a reduced basis, the shorter first.
  Step a;
  Step b;
  bool two_kinds = false;
  Step to_odd_rows;  // with two kinds: in the cell of the basis around zero
};

ShortSteps short_steps(const TubesheetSettings& settings) {
  const Step row{{1, 0}, settings.row_step_mm[0], settings.row_step_mm[1]};
  const Step column{{0, 1}, settings.column_step_mm[0], settings.column_step_mm[1]};
  const bool every_other = settings.addresses != AddressParity::kAll;
  ShortSteps steps;
  const auto spanning = spanning_steps(settings.addresses);
  steps.a = combined(combined({}, spanning[0].row, row), spanning[0].column, column);
  steps.b = combined(combined({}, spanning[1].row, row), spanning[1].column, column);
  if (settings.odd_row_shift != 0.0) {
    steps.two_kinds = true;
    steps.to_odd_rows = steps.a;
    steps.to_odd_rows.x += settings.odd_row_shift * column.x;
    steps.to_odd_rows.y += settings.odd_row_shift * column.y;
    steps.a = combined({}, 2, row);
    steps.b = combined({}, every_other ? 2 : 1, column);
  }
  reduce(steps.a, steps.b);
  if (steps.two_kinds) {
    const Step& a = steps.a;
    const Step& b = steps.b;
    const Step odd = steps.to_odd_rows;
    const double cell = a.x * b.y - a.y * b.x;
    const std::int32_t along_a = nearest_whole((odd.x * b.y - odd.y * b.x) / cell);
    const std::int32_t along_b = nearest_whole((a.x * odd.y - a.y * odd.x) / cell);
    steps.to_odd_rows = combined(combined(odd, -along_a, a), -along_b, b);
  }
  return steps;
}

// Tubes around a tube in an even row, among which are all that its cell may border on.
using StepList = StaticVector<Step, 33>;

StepList steps_around(const ShortSteps& steps) {
  StepList around;
  // A cell lies within that of the tube's own kind alone, whose neighbours are known.
  for (std::int32_t i = -1; i <= 1; ++i) {
    for (std::int32_t j = -1; j <= 1; ++j) {
      if (i != 0 || j != 0) {
        static_cast<void>(around.try_push_back(combined(combined({}, i, steps.a), j, steps.b)));
      }
    }
  }
  if (!steps.two_kinds) {
    return around;
  }
  // Of the other kind: the cells of one kind reach half of a to either side along a, so that
  // neighbours are within a whole a of each other in that direction; and no neighbour is farther
  // off than twice the way to a corner, the square root of a^2 + b^2 at most. In coordinates of the
  // basis (60 to 120 degrees apart) both stay below 2; the middle one is half a step off.
  for (std::int32_t i = -2; i <= 2; ++i) {
    for (std::int32_t j = -2; j <= 2; ++j) {
      static_cast<void>(
          around.try_push_back(combined(combined(steps.to_odd_rows, i, steps.a), j, steps.b)));
    }
  }
  return around;
}

// Whether the line halfway to `step` has a piece that is nearer to zero than to any other tube: a
// side of the cell. Its points are step / 2 + t u, with u across the step; another tube m leaves
// those with (step / 2 + t u) m <= m^2 / 2.
bool is_side(const StepList& around, const Step& step) {
  constexpr double kLeastSide = 1e-6;  // of the step; shorter sides are corners
  const double ux = -step.y;
  const double uy = step.x;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  for (const Step& m : around) {
    const double along = ux * m.x + uy * m.y;
    const double left = (m.length2() - (step.x * m.x + step.y * m.y)) / 2.0;
    if (std::abs(along) <= 1e-9 * step.length2()) {
      if (left < -1e-9 * step.length2()) {
        return false;
      }
    } else if (along > 0.0) {
      high = std::min(high, left / along);
    } else {
      low = std::max(low, left / along);
    }
  }
  return high - low > kLeastSide;
}

double shortest_of(const ShortSteps& steps, const StepList& around) {
  double least2 = steps.a.length2();
  if (steps.two_kinds) {
    for (const Step& step : around) {
      least2 = std::min(least2, step.length2());
    }
  }
  return std::sqrt(least2);
}

template <Scalar S>
void fill_neighbours(const ShortSteps& steps, const StepList& around,
                     typename Lattice<S>::Parameters& p) {
  std::size_t next = 0;
  for (const Step& step : around) {
    if (next == p.neighbours.size() || (steps.two_kinds && !is_side(around, step))) {
      continue;
    }
    const double length = std::sqrt(step.length2());
    p.neighbours[next++] = {
        step.address, {Unit<S>(step.x / length), Unit<S>(step.y / length)}, Mm<S>(length / 2.0)};
  }
  for (; next < p.neighbours.size(); ++next) {
    p.neighbours[next] = p.neighbours[0];
  }
}

}  // namespace

template <Scalar S>
Result<Lattice<S>> make_lattice(const TubesheetSettings& settings) {
  const Step row{{1, 0}, settings.row_step_mm[0], settings.row_step_mm[1]};
  const Step column{{0, 1}, settings.column_step_mm[0], settings.column_step_mm[1]};
  // Below 1 mm even every other address would leave steps under 2 mm; NaN is refused too.
  const auto fits = [](const Step& step) {
    return step.length2() >= kShortestStep_mm * kShortestStep_mm &&
           step.length2() <= kLongestStep_mm * kLongestStep_mm;
  };
  const double share = settings.odd_row_shift;
  if (!fits(row) || !fits(column) || !(share >= -kLargestShift && share <= kLargestShift)) {
    return Unexpected(Error::kOutOfRange);
  }
  const double area = row.x * column.y - row.y * column.x;
  if (!(area * area > 0.0075 * row.length2() * column.length2())) {  // sine of 5 degrees, squared
    return Unexpected(Error::kIllConditioned);
  }
  const ShortSteps steps = short_steps(settings);
  const StepList around = steps_around(steps);
  const double shortest = shortest_of(steps, around);
  if (!(shortest >= 2.0)) {
    return Unexpected(Error::kOutOfRange);
  }

  typename Lattice<S>::Parameters p;
  p.row_step = {Mm<S>(row.x), Mm<S>(row.y)};
  p.column_step = {Mm<S>(column.x), Mm<S>(column.y)};
  p.odd_row_shift = {Mm<S>(share * column.x), Mm<S>(share * column.y)};
  const Step& a = steps.a;
  const Step& b = steps.b;
  p.basis = {a.address, b.address};
  const double cell = a.x * b.y - a.y * b.x;
  p.inverse[0] = {Unit<S>(b.y / cell), Unit<S>(-b.x / cell)};
  p.inverse[1] = {Unit<S>(-a.y / cell), Unit<S>(a.x / cell)};
  p.two_kinds = steps.two_kinds;
  p.to_odd_rows = steps.to_odd_rows.address;
  p.shortest_step = Mm<S>(shortest);
  p.addresses = settings.addresses;
  fill_neighbours<S>(steps, around, p);
  return Lattice<S>(p);
}

std::array<double, 2> center_mm(const TubesheetSettings& settings, TubeAddress address) {
  const double columns = address.column;
  const double shift = in_odd_row(address) ? settings.odd_row_shift : 0.0;
  std::array<double, 2> at{};
  for (std::size_t i = 0; i < 2; ++i) {
    at[i] = settings.origin_mm[i] + address.row * settings.row_step_mm[i] +
            (columns + shift) * settings.column_step_mm[i];
  }
  return at;
}

std::array<double, 2> center_mm(const Lattice<double>& lattice,
                                const std::array<double, 2>& origin_mm, TubeAddress address) {
  const Lattice<double>::Parameters& p = lattice.parameters();
  const double shifted = in_odd_row(address) ? 1.0 : 0.0;
  return {origin_mm[0] + address.row * p.row_step.x + address.column * p.column_step.x +
              shifted * p.odd_row_shift.x,
          origin_mm[1] + address.row * p.row_step.y + address.column * p.column_step.y +
              shifted * p.odd_row_shift.y};
}

double shortest_step_mm(const TubesheetSettings& settings) {
  const ShortSteps steps = short_steps(settings);
  return shortest_of(steps, steps_around(steps));
}

#define TUBESIGHT_INSTANTIATE(S) \
  template Result<Lattice<S>> make_lattice<S>(const TubesheetSettings&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tubesheet
