#include "core/tracking/tube_measurement.h"

#include <array>
#include <optional>

#include "core/base/constant.h"
#include "core/base/instantiate.h"

namespace tubesight::core::tracking {
namespace {

// The sums of the weighted least squares for (du, dv, growth), not yet narrowed.
template <Scalar S>
struct Sums {
  using M = Mm<S>;
  using Sum = decltype(product(M{}, M{}));
  Sum uu{}, uv{}, vv{}, ug{}, vg{}, gg{}, u{}, v{}, g{};

  void add(const RimEquation<S>& e) {
    const M one = e.weight;
    const M tilt = times(e.weight, e.slope);
    const M grow = times(e.weight, e.reach);
    Sum& straight = e.along_line ? uu : vv;
    Sum& aside = e.along_line ? vv : uu;
    Sum& straight_grow = e.along_line ? ug : vg;
    Sum& aside_grow = e.along_line ? vg : ug;
    Sum& straight_value = e.along_line ? u : v;
    Sum& aside_value = e.along_line ? v : u;
    straight += product(one, M(1));
    uv -= product(tilt, M(1));
    aside += product(tilt, e.slope);
    straight_grow += product(grow, M(1));
    aside_grow -= product(tilt, e.reach);
    gg += product(grow, e.reach);
    straight_value += product(one, e.distance);
    aside_value -= product(tilt, e.distance);
    g += product(grow, e.distance);
  }
};

template <Scalar S>
struct Shift {
  Mm<S> du{}, dv{}, growth{};
  Mm<S> uu{}, uv{}, vv{};  // information of (du, dv) with the growth free
};

// Eliminates the growth, then solves the two by two. Empty when the rim points found do not
// determine both directions.
template <Scalar S>
std::optional<Shift<S>> solve(const Sums<S>& sums) {
  using M = Mm<S>;
  const M ug = narrow<M>(sums.ug);
  const M vg = narrow<M>(sums.vg);
  const M g = narrow<M>(sums.g);
  // A growth of 0.5 px per 32 px (bores, blur, glare) is as likely as an edge off by 0.2 px.
  const M gg = narrow<M>(sums.gg) + constant<M>(0.125);
  const M share_u = quotient<M>(ug, gg);
  const M share_v = quotient<M>(vg, gg);
  const M uu = narrow<M>(sums.uu - product(ug, share_u));
  const M uv = narrow<M>(sums.uv - product(ug, share_v));
  const M vv = narrow<M>(sums.vv - product(vg, share_v));
  const M u = narrow<M>(sums.u - product(g, share_u));
  const M v = narrow<M>(sums.v - product(g, share_v));
  const M half = constant<M>(0.5);
  if (uu < half || vv < half) {
    return std::nullopt;
  }
  const M share = quotient<M>(uv, uu);
  const M rest = vv - times(uv, share);
  if (rest < half) {
    return std::nullopt;
  }
  Shift<S> shift;
  shift.dv = quotient<M>(v - times(u, share), rest);
  shift.du = quotient<M>(u, uu) - times(share, shift.dv);
  shift.growth = quotient<M>(narrow<M>(sums.g - product(ug, shift.du) - product(vg, shift.dv)), gg);
  shift.uu = uu;
  shift.uv = uv;
  shift.vv = vv;
  return shift;
}

// The squared distance of a found edge from the fitted rim across it, px^2. Distances beyond 16 px
// count as 16: it does not matter how far.
template <Scalar S>
Mm<S> squared_distance(const RimEquation<S>& e, const Shift<S>& shift) {
  using M = Mm<S>;
  const M straight = e.along_line ? shift.du : shift.dv;
  const M aside = e.along_line ? shift.dv : shift.du;
  const M r = narrow<M>(product(e.distance - straight, M(1)) + product(e.slope, aside) -
                        product(e.reach, shift.growth));
  const M limit = constant<M>(16.0);
  const M bounded = r > limit ? limit : (r < -limit ? -limit : r);
  return times(times(bounded, bounded), e.weight);
}

// The equations of one rim and their least squares.
template <Scalar S>
class RimFit {
 public:
  [[nodiscard]] RimEquation<S>& next() { return equations_[static_cast<std::size_t>(count_)]; }
  void keep() { ++count_; }
  [[nodiscard]] std::int32_t count() const { return count_; }

  [[nodiscard]] std::optional<Shift<S>> solve_all() const {
    Sums<S> sums;
    for (std::int32_t i = 0; i < count_; ++i) {
      sums.add(equations_[static_cast<std::size_t>(i)]);
    }
    return solve(sums);
  }

  // Leaves out edges far from the fitted rim: nicks, glints, the guidetube, a neighbour's shadow.
  // Says whether there were any.
  bool drop_outliers(const Shift<S>& shift) {
    using M = Mm<S>;
    std::array<M, kRimPoints> squares{};
    M sum{};
    M largest{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
      squares[i] = squared_distance(equations_[i], shift);
      sum += squares[i];
      largest = largest < squares[i] ? squares[i] : largest;
    }
    mean_square_ = quotient<M>(sum, from_scaled<M>(count_, 0));
    const M floor = constant<M>(0.125);
    M limit = times(mean_square_, constant<M>(4.0));
    limit = limit < floor ? floor : limit;
    if (largest <= limit) {
      return false;
    }
    std::int32_t kept = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
      if (squares[i] <= limit) {
        equations_[static_cast<std::size_t>(kept++)] = equations_[i];
      }
    }
    count_ = kept;
    return true;
  }

  [[nodiscard]] Mm<S> mean_square() const { return mean_square_; }

 private:
  std::array<RimEquation<S>, kRimPoints> equations_;
  std::int32_t count_ = 0;
  Mm<S> mean_square_{};
};

// Whether the rim that was found is the tube-end's.
template <Scalar S>
bool is_its_rim(const Shift<S>& shift, Mm<S> mean_square, const MeasurementBounds& bounds) {
  using M = Mm<S>;
  const M range = from_scaled<M>(bounds.range_px, 0);
  // A rim 2.75 px wider per 32 px is not: a plug's hole, the outside of a weld.
  const M widest = constant<M>(2.75);
  // What makes a rim ragged is of the sheet: as many more pixels as the picture has more.
  const M ragged = times(constant<M>(0.5), from_scaled<M>(bounds.step_px * bounds.step_px, 0));
  return absolute(shift.du) <= range && absolute(shift.dv) <= range &&
         absolute(shift.growth) <= widest && mean_square <= ragged;
}

constexpr std::int32_t kLeastEdges = kRimPoints * 5 / 8;

}  // namespace

template <Scalar S>
Finding measure_tube(const FieldView& field, const RimOutline<S>& outline,
                     const MeasurementBounds& bounds, edges::DynamicThreshold& threshold,
                     TubeMeasurement<S>& result) {
  RimFit<S> rim;
  std::int32_t outside = 0;
  std::int32_t missed = 0;
  std::int32_t contrast = 0;
  // Five steps at a time go round all points and far apart ones first, so that a tube-end that is
  // not there is given up early.
  static_assert(kRimPoints % 5 != 0);
  for (int i = 0, index = 0; i < kRimPoints; ++i, index = (index + 5) % kRimPoints) {
    const RimMiss miss =
        search_rim<S>(field, outline.points[static_cast<std::size_t>(index)],
                      outline.tangent(index), outline.middle, bounds, threshold, rim.next());
    if (miss == RimMiss::kNone) {
      contrast += rim.next().contrast;
      rim.keep();
    } else if (miss == RimMiss::kNoEdge) {
      ++missed;
    } else {
      ++outside;
    }
    if (missed > kRimPoints - kLeastEdges) {
      return Finding::kDisagrees;
    }
  }
  const std::int32_t found = rim.count();
  if (found < kLeastEdges) {
    return outside > missed ? Finding::kOutside : Finding::kDisagrees;
  }
  std::optional<Shift<S>> shift = rim.solve_all();
  constexpr int kRounds = 3;
  for (int round = 0; shift && rim.drop_outliers(*shift); ++round) {
    if (round == kRounds || rim.count() < kLeastEdges) {
      return Finding::kDisagrees;
    }
    shift = rim.solve_all();
  }
  if (!shift) {
    return Finding::kDisagrees;
  }
  if (!is_its_rim<S>(*shift, rim.mean_square(), bounds)) {
    return Finding::kDisagrees;
  }
  result.center_px = {result.predicted_px.x + convert<Px<S>>(shift->du),
                      result.predicted_px.y + convert<Px<S>>(shift->dv)};
  result.information_uu = shift->uu;
  result.information_uv = shift->uv;
  result.information_vv = shift->vv;
  result.edges = rim.count();
  result.contrast_q4 = 16 * contrast / found;
  result.rms_px = convert<Px<S>>(square_root(rim.mean_square()));
  result.growth_px = convert<Px<S>>(shift->growth);
  result.used = true;
  return Finding::kMeasured;
}

#define TUBESIGHT_INSTANTIATE(S)                                                       \
  template Finding measure_tube<S>(const FieldView&, const RimOutline<S>&,             \
                                   const MeasurementBounds&, edges::DynamicThreshold&, \
                                   TubeMeasurement<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
