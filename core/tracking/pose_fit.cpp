#include "core/tracking/pose_fit.h"

#include <algorithm>
#include <array>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {
namespace {

// Where the measured centres are on the image plane at unit distance: the same in all steps.
template <Scalar S>
using MeasuredPlane = std::array<Vector2<Ratio<S>>, kMaxTubesInView>;

// A tube-end's centre in the camera frame, and its image by the pose.
template <Scalar S>
struct Modelled {
  bool valid = false;
  Vector3<Mm<S>> arm{};  // from the anchor's centre
  Vector2<Ratio<S>> plane{};
  Mm<S> u{};  // measured minus modelled, px of the undistorted picture
  Mm<S> v{};
  Mm<S> depth{};
};

template <Scalar S>
Modelled<S> modelled(const TrackingModel<S>& model, const SheetPose<S>& pose,
                     const Vector2<Mm<S>>& local, const Vector2<Ratio<S>>& measured) {
  Modelled<S> m;
  m.arm = pose.along(local);
  const Vector3<Mm<S>> p = pose.origin + m.arm;
  const auto plane = to_plane<S>(p);
  if (!plane) {
    return m;
  }
  const auto& scale = model.camera.parameters().scale_px;
  m.plane = *plane;
  m.u = narrow<Mm<S>>(product(scale.x, measured.x - plane->x));
  m.v = narrow<Mm<S>>(product(scale.y, measured.y - plane->y));
  m.depth = p.z;
  m.valid = true;
  return m;
}

// The derivatives of a centre's image by the unknowns. With P = origin + q, x = P_x / P_z,
// y = P_y / P_z and the step dP = w x q + t,
//
//   du = s_u / P_z (dP_x - x dP_z),   dP_x = w_y q_z - w_z q_y + t_x,
//   dv = s_v / P_z (dP_y - y dP_z),   dP_y = w_z q_x - w_x q_z + t_y,
//                                     dP_z = w_x q_y - w_y q_x + t_z,
//
// so that the rows, in the order w_x w_y w_z t_x t_y t_z and w in 1/128 rad, are
//
//   s_u / P_z [ -x q_y          q_z + x q_x   -q_y   1   0   -x ]
//   s_v / P_z [ -q_z - y q_y    y q_x          q_x   0   1   -y ].
template <Scalar S>
void add_tube(const TrackingModel<S>& model, const TubeMeasurement<S>& tube, const Modelled<S>& m,
              NormalEquations<S>& equations) {
  using M = Mm<S>;
  const auto& scale = model.camera.parameters().scale_px;
  const M su = quotient<M>(scale.x, m.depth);  // px per mm across the line of sight
  const M sv = quotient<M>(scale.y, m.depth);
  const M turn_u = times(su, constant<M>(1.0 / 128.0));
  const M turn_v = times(sv, constant<M>(1.0 / 128.0));
  const Vector3<M>& q = m.arm;
  const Ratio<S> x = m.plane.x;
  const Ratio<S> y = m.plane.y;
  const typename NormalEquations<S>::Pair pair{
      {-times(turn_u, times(q.y, x)), times(turn_u, q.z + times(q.x, x)), -times(turn_u, q.y), su,
       M{}, -times(su, x)},
      {-times(turn_v, q.z + times(q.y, y)), times(turn_v, times(q.x, y)), times(turn_v, q.x), M{},
       sv, -times(sv, y)},
      m.u,
      m.v,
      tube.information_uu,
      tube.information_uv,
      tube.information_vv};
  equations.add(pair);
}

// The squared distance, px^2. Components beyond 30 px count as 30, so that the sum stays in range:
// it does not matter how far.
template <typename M>
M squared_distance(M u, M v) {
  const M limit = constant<M>(30.0);
  const M a = std::min(absolute(u), limit);
  const M b = std::min(absolute(v), limit);
  return narrow<M>(product(a, a) + product(b, b));
}

// What is known without the picture; `moved` is the move since the prediction.
//
// Lean: a turn w takes the normal n to n + w x n, whose part along an axis e of the virtual plane
// shall be 0: (n x e) . w = -n . e. Turn: w = -moved. Height: n . t = -n . moved.
template <Scalar S>
void add_prior(const TrackingModel<S>& model, const PosePrior<S>& prior, const SheetPose<S>& pose,
               const PoseVector<S>& moved, NormalEquations<S>& equations) {
  using M = Mm<S>;
  for (const auto* axis : {&model.virtual_plane.x_axis(), &model.virtual_plane.y_axis()}) {
    const auto lever = cross<Unit<S>>(pose.normal, *axis);
    const M lean = narrow<M>(dot(pose.normal, *axis));
    // In the unknowns' 1/128 rad.
    const PoseVector<S> row{
        convert<M>(lever.x), convert<M>(lever.y), convert<M>(lever.z), M{}, M{}, M{}};
    const M lean_scaled = times(lean, constant<M>(128.0));
    equations.add(row, -lean_scaled, prior.lean_weight);
  }
  for (int turn = 0; turn < 3; ++turn) {
    equations.add(turn, -moved[static_cast<std::size_t>(turn)], prior.turn_weight);
  }
  const PoseVector<S> row{M{},
                          M{},
                          M{},
                          convert<M>(pose.normal.x),
                          convert<M>(pose.normal.y),
                          convert<M>(pose.normal.z)};
  const M approached =
      narrow<M>(product(pose.normal.x, moved[3]) + product(pose.normal.y, moved[4]) +
                product(pose.normal.z, moved[5]));
  equations.add(row, -approached, prior.height_weight);
}

// Whether another step would change nothing that matters: the error left is of the square of this
// step's size, below 0.1 um and 1e-6 rad.
template <Scalar S>
bool settled(const PoseVector<S>& delta) {
  const Mm<S> small_turn = constant<Mm<S>>(0.125);  // 0.001 rad, in 1/128
  const Mm<S> small_shift = constant<Mm<S>>(0.125);
  for (std::size_t i = 0; i < 3; ++i) {
    if (absolute(delta[i]) > small_turn || absolute(delta[i + 3]) > small_shift) {
      return false;
    }
  }
  return true;
}

// What the tube-ends' distances from their fitted places say.
template <Scalar S>
struct Agreement {
  bool changed = false;  // another set of tube-ends counts as agreeing
  std::int32_t used = 0;
  Mm<S> mean_square{};
};

// Marks the tube-ends that lie too far from the fitted plane.
template <Scalar S>
Agreement<S> mark_outliers(const TrackingModel<S>& model, const SheetPose<S>& pose,
                           const MeasuredPlane<S>& measured, MeasurementList<S>& tubes) {
  using M = Mm<S>;
  std::array<M, kMaxTubesInView> off{};
  for (std::int32_t i = 0; i < tubes.size(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const auto m = modelled<S>(model, pose, tubes[i].local, measured[index]);
    off[index] = m.valid ? squared_distance(m.u, m.v) : constant<M>(1800.0);
  }
  std::array<M, kMaxTubesInView> sorted = off;
  auto* const middle = sorted.data() + tubes.size() / 2;
  std::nth_element(sorted.data(), middle, sorted.data() + tubes.size());
  // 4 medians of a Rayleigh distribution are 4.7 sigma; below 0.5 px nothing is an outlier.
  const M median = std::min(*middle, constant<M>(100.0));
  const M limit = std::max(times(median, constant<M>(16.0)), constant<M>(0.25));
  Agreement<S> agreement;
  const M per_kilo = constant<M>(1.0 / 1024.0);
  auto sum = product(M{}, M{});
  for (std::int32_t i = 0; i < tubes.size(); ++i) {
    const M d2 = off[static_cast<std::size_t>(i)];
    const bool used = d2 <= limit;
    agreement.changed = agreement.changed || used != tubes[i].used;
    tubes[i].used = used;
    if (used) {
      ++agreement.used;
      sum += product(d2, per_kilo);  // a sum of many squares leaves the format, a 1024th does not
    }
  }
  if (agreement.used > 0) {
    agreement.mean_square = quotient<M>(narrow<M>(sum), from_scaled<M>(agreement.used, 10));
  }
  return agreement;
}

}  // namespace

template <Scalar S>
PoseFit<S> fit_pose(const TrackingModel<S>& model, const PosePrior<S>& prior,
                    MeasurementList<S>& tubes, NormalEquations<S>& equations, SheetPose<S>& pose) {
  using M = Mm<S>;
  PoseFit<S> fit;
  if (tubes.empty()) {
    return fit;
  }
  MeasuredPlane<S> measured{};
  for (std::int32_t i = 0; i < tubes.size(); ++i) {
    measured[static_cast<std::size_t>(i)] = model.camera.to_plane(tubes[i].center_px);
  }
  // Gauss-Newton: each step solves (sum J^T W J) delta = sum J^T W r, r measured minus modelled and
  // W the information of the measured centre.
  PoseVector<S> moved{};
  constexpr int kSteps = 4;
  for (int step = 0; step < kSteps; ++step) {
    equations.clear();
    add_prior<S>(model, prior, pose, moved, equations);
    for (std::int32_t i = 0; i < tubes.size(); ++i) {
      if (tubes[i].used) {
        const auto m =
            modelled<S>(model, pose, tubes[i].local, measured[static_cast<std::size_t>(i)]);
        if (m.valid) {
          add_tube<S>(model, tubes[i], m, equations);
        }
      }
    }
    if (!equations.factor()) {
      return fit;
    }
    const PoseVector<S> delta = equations.solve();
    const M per_unknown = constant<M>(1.0 / 128.0);
    move<S>(
        pose,
        {times(delta[0], per_unknown), times(delta[1], per_unknown), times(delta[2], per_unknown)},
        {delta[3], delta[4], delta[5]});
    for (std::size_t i = 0; i < delta.size(); ++i) {
      moved[i] += delta[i];
    }
    const Agreement<S> agreement = mark_outliers<S>(model, pose, measured, tubes);
    fit.used = agreement.used;
    fit.rms_px = convert<Px<S>>(square_root(agreement.mean_square));
    if (!agreement.changed && settled<S>(delta)) {
      break;
    }
  }
  fit.solved = fit.used > 0;
  return fit;
}

#define TUBESIGHT_INSTANTIATE(S)                                                \
  template PoseFit<S> fit_pose<S>(const TrackingModel<S>&, const PosePrior<S>&, \
                                  MeasurementList<S>&, NormalEquations<S>&, SheetPose<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
