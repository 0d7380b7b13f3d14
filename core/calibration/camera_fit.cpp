#include "core/calibration/camera_fit.h"

#include <cmath>

#include <Eigen/Geometry>

namespace tubesight::core::calibration {
namespace {

constexpr std::int32_t kPoseUnknowns = 6;     // a turn about the camera's axes, a shift
constexpr std::int32_t kAxisUnknowns = 2;     // of the stage's axis
constexpr std::int32_t kSharedUnknowns = 11;  // the camera, tangential distortion, the bow
constexpr std::int32_t kLocalUnknowns =
    kSharedUnknowns + kPoseUnknowns + kAxisUnknowns;  // of one dot

/// What all views have in common, as one list.
using SharedValues = Eigen::Matrix<double, kSharedUnknowns, 1>;

SharedValues shared_of(const CalibrationState& state) {
  SharedValues values;
  values << state.camera, state.tangential, state.bow_mm;
  return values;
}

void set_shared(const SharedValues& values, CalibrationState& state) {
  state.camera = values.head<6>();
  state.tangential = values.segment<2>(6);
  state.bow_mm = values.tail<3>();
}

/// Where the unknowns stand in the equations.
class Layout {
 public:
  Layout(const FitOptions& options, const CalibrationData& data) : axis_(options.stage_axis) {
    std::array<bool, kSharedUnknowns> free = {true,
                                              options.center_and_scale,
                                              options.center_and_scale,
                                              options.center_and_scale,
                                              options.distortion,
                                              options.distortion2,
                                              options.tangential,
                                              options.tangential,
                                              options.bow,
                                              options.bow,
                                              options.bow};
    for (std::size_t i = 0; i < free.size(); ++i) {
      shared_[i] = free[i] ? count_++ : -1;
    }
    for (std::int32_t i = 0; i < data.views.size(); ++i) {
      if (data.views[i].staged && stage_ < 0) {
        stage_ = count_;
        count_ += of_stage();
      }
    }
    for (std::int32_t i = 0; i < data.views.size(); ++i) {
      views_[static_cast<std::size_t>(i)] = data.views[i].staged ? stage_ : count_;
      count_ += data.views[i].staged ? 0 : kPoseUnknowns;
    }
  }

  [[nodiscard]] std::int32_t count() const { return count_; }
  [[nodiscard]] std::int32_t stage() const { return stage_; }
  [[nodiscard]] bool axis() const { return axis_; }
  /// Unknowns of the stage.
  [[nodiscard]] std::int32_t of_stage() const {
    return kPoseUnknowns + (axis_ ? kAxisUnknowns : 0);
  }
  [[nodiscard]] std::int32_t of_shared(std::int32_t i) const {
    return shared_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] std::int32_t of_view(std::int32_t i) const {
    return views_[static_cast<std::size_t>(i)];
  }

 private:
  std::array<std::int32_t, kSharedUnknowns> shared_{};
  std::array<std::int32_t, kMaxViews> views_{};
  bool axis_ = false;
  std::int32_t stage_ = -1;
  std::int32_t count_ = 0;
};

/// A pose turned and shifted by the first six of `by`.
TargetPose moved(const TargetPose& pose, const double* by) {
  const Eigen::Vector3d turn(by[0], by[1], by[2]);
  const double angle = turn.norm();
  TargetPose result = pose;
  if (angle > 0.0) {
    result.R_camera_target =
        Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * pose.R_camera_target;
  }
  result.t_camera_target += Eigen::Vector3d(by[3], by[4], by[5]);
  return result;
}

/// The stage's axis tipped by two small steps across itself.
Eigen::Vector3d tipped(const Eigen::Vector3d& axis, double a, double b) {
  const Eigen::Vector3d across = axis.unitOrthogonal();
  return (axis + a * across + b * axis.cross(across)).normalized();
}

/// The stage moved by the first unknowns of `by`, its axis with it.
void move_stage(const Layout& layout, const double* by, CalibrationState& state) {
  state.stage = moved(state.stage, by);
  state.stage_axis = layout.axis() ? tipped(state.stage_axis, by[6], by[7])
                                   : Eigen::Vector3d(state.stage.R_camera_target.col(2));
}

void set_staged_poses(const CalibrationData& data, CalibrationState& state) {
  for (std::int32_t i = 0; i < data.views.size(); ++i) {
    if (data.views[i].staged) {
      state.poses[i] = pose_at(state, data.views[i].height_mm);
    }
  }
}

void take_step(const Layout& layout, const CalibrationData& data, const CalibrationState& from,
               const double* step, CalibrationState& to) {
  to = from;
  SharedValues values = shared_of(from);
  for (std::int32_t i = 0; i < kSharedUnknowns; ++i) {
    values(i) += layout.of_shared(i) >= 0 ? step[layout.of_shared(i)] : 0.0;
  }
  set_shared(values, to);
  if (layout.stage() >= 0) {
    move_stage(layout, step + layout.stage(), to);
  }
  for (std::int32_t i = 0; i < data.views.size(); ++i) {
    if (!data.views[i].staged) {
      to.poses[i] = moved(from.poses[i], step + layout.of_view(i));
    }
  }
  set_staged_poses(data, to);
}

/// The template's middle and half of its extent.
struct Extent {
  Eigen::Vector2d middle_mm;
  Eigen::Vector2d half_mm;
};

Extent extent_of(const CalibrationData& data) {
  Eigen::Array2d least = Eigen::Array2d::Constant(HUGE_VAL);
  Eigen::Array2d most = -least;
  for (const SeenDot& dot : data.dots) {
    least = least.min(dot.place_mm.head<2>().array());
    most = most.max(dot.place_mm.head<2>().array());
  }
  return {0.5 * (least + most), (0.5 * (most - least)).max(1e-6)};
}

/// A dot's centroid by the fit: P = place + bow(place) along the normal.
Eigen::Vector2d image_of(const CalibrationData& data, const Extent& extent,
                         const CalibrationState& state, const TargetPose& pose,
                         const SeenDot& dot) {
  const Eigen::Vector2d at =
      (dot.place_mm.head<2>() - extent.middle_mm).cwiseQuotient(extent.half_mm);
  Eigen::Vector3d place = dot.place_mm;
  place.z() += state.bow_mm.dot(Eigen::Vector3d(at.x() * at.x(), at.x() * at.y(), at.y() * at.y()));
  return centroid_of(data.sensor, state.camera, pose, place, data.dot_radius_mm, state.tangential);
}

/// Sets the residuals; the sum of their squares, or infinity when a dot has no image.
double residuals(CalibrationData& data, const CalibrationState& state) {
  double sum = 0.0;
  const Extent extent = extent_of(data);
  for (std::int32_t v = 0; v < data.views.size(); ++v) {
    const CalibrationView& view = data.views[v];
    for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
      SeenDot& dot = data.dots[i];
      dot.residual_px = dot.seen_px - image_of(data, extent, state, state.poses[v], dot);
      sum += dot.used ? dot.residual_px.squaredNorm() : 0.0;
    }
  }
  return std::isfinite(sum) ? sum : HUGE_VAL;
}

// Of central differences: far above rounding, far below where the third derivative shows.
constexpr std::array<double, kSharedUnknowns> kSharedSteps = {1e-5, 1e-6, 1e-4, 1e-4, 1e-6, 1e-7,
                                                              1e-6, 1e-6, 1e-4, 1e-4, 1e-4};
constexpr double kTurnStep = 1e-6;
constexpr double kShiftStep_mm = 1e-5;

/// One dot's derivatives by what it depends on.
struct DotRows {
  std::array<std::int32_t, kLocalUnknowns> at{};
  std::array<double, kLocalUnknowns> u{};
  std::array<double, kLocalUnknowns> v{};
  std::int32_t count = 0;

  void add(std::int32_t where, const Eigen::Vector2d& derivative) {
    at[static_cast<std::size_t>(count)] = where;
    u[static_cast<std::size_t>(count)] = derivative.x();
    v[static_cast<std::size_t>(count)] = derivative.y();
    ++count;
  }
};

void derive(const Layout& layout, const CalibrationData& data, const Extent& extent,
            const CalibrationState& state, std::int32_t view, const SeenDot& dot, DotRows& rows,
            CalibrationState& off) {
  rows.count = 0;
  const SharedValues values = shared_of(state);
  const auto image = [&](const SharedValues& shared, const TargetPose& pose) {
    set_shared(shared, off);
    return image_of(data, extent, off, pose, dot);
  };
  for (std::int32_t i = 0; i < kSharedUnknowns; ++i) {
    if (layout.of_shared(i) >= 0) {
      const double step = kSharedSteps[static_cast<std::size_t>(i)];
      const SharedValues by = step * SharedValues::Unit(i);
      rows.add(layout.of_shared(i),
               (image(values + by, state.poses[view]) - image(values - by, state.poses[view])) /
                   (2.0 * step));
    }
  }
  const bool staged = data.views[view].staged;
  const std::int32_t count = staged ? layout.of_stage() : kPoseUnknowns;
  for (std::int32_t i = 0; i < count; ++i) {
    const double step = i < 3 || i >= kPoseUnknowns ? kTurnStep : kShiftStep_mm;
    const auto pose = [&](double sign) {
      std::array<double, kPoseUnknowns + kAxisUnknowns> by{};
      by[static_cast<std::size_t>(i)] = sign * step;
      if (!staged) {
        return moved(state.poses[view], by.data());
      }
      const TargetPose stage = moved(state.stage, by.data());
      const Eigen::Vector3d axis = layout.axis() ? tipped(state.stage_axis, by[6], by[7])
                                                 : Eigen::Vector3d(stage.R_camera_target.col(2));
      return TargetPose{stage.R_camera_target,
                        stage.t_camera_target + data.views[view].height_mm * axis};
    };
    rows.add(layout.of_view(view) + i,
             (image(values, pose(1.0)) - image(values, pose(-1.0))) / (2.0 * step));
  }
}

void set_up(const Layout& layout, const CalibrationData& data, const CalibrationState& state,
            FitScratch& scratch) {
  DenseNormal& normal = scratch.normal;
  normal.reset(layout.count());
  const Extent extent = extent_of(data);
  DotRows rows;
  for (std::int32_t v = 0; v < data.views.size(); ++v) {
    const CalibrationView& view = data.views[v];
    for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
      const SeenDot& dot = data.dots[i];
      if (dot.used) {
        derive(layout, data, extent, state, v, dot, rows, scratch.trial);
        normal.add(rows.at.data(), rows.u.data(), rows.count, dot.residual_px.x());
        normal.add(rows.at.data(), rows.v.data(), rows.count, dot.residual_px.y());
      }
    }
  }
}

/// Steps until nothing gets better; says whether it came to rest.
bool descend(const Layout& layout, CalibrationData& data, CalibrationState& state,
             FitScratch& scratch, double& sum) {
  constexpr int kRounds = 60;
  constexpr double kEnough = 1e-10;  // of the sum
  double damping = 1e-3;
  for (int round = 0; round < kRounds; ++round) {
    set_up(layout, data, state, scratch);
    bool better = false;
    while (!better && damping < 1e8) {
      if (scratch.normal.factor(damping)) {
        scratch.normal.solve(scratch.step.data());
        take_step(layout, data, state, scratch.step.data(), scratch.trial);
        const double trial = residuals(data, scratch.trial);
        better = trial < sum;
        if (better) {
          const bool done = sum - trial < kEnough * sum;
          state = scratch.trial;
          sum = trial;
          damping = std::fmax(damping * 0.1, 1e-12);
          if (done) {
            return true;
          }
          continue;
        }
      }
      damping *= 10.0;
    }
    if (!better) {
      sum = residuals(data, state);
      return true;  // at the bottom, within rounding
    }
  }
  return false;
}

/// The axis' part of the factored matrix' inverse.
void tell_axis(const Layout& layout, FitScratch& scratch, FitOutcome& outcome) {
  const double variance = outcome.sigma_px * outcome.sigma_px;
  const std::int32_t axis = layout.stage() + kPoseUnknowns;
  for (std::int32_t i = 0; i < kAxisUnknowns; ++i) {
    scratch.normal.inverse_column(axis + i, scratch.step.data());
    for (std::int32_t k = 0; k < kAxisUnknowns; ++k) {
      outcome.axis_covariance(k, i) = variance * scratch.step[static_cast<std::size_t>(axis + k)];
    }
    for (std::int32_t k = 0; k < 6; ++k) {
      if (layout.of_shared(k) >= 0) {
        outcome.camera_axis_covariance(k, i) =
            variance * scratch.step[static_cast<std::size_t>(layout.of_shared(k))];
      }
    }
  }
}

}  // namespace

FitOutcome fit_camera(const FitOptions& options, CalibrationData& data, CalibrationState& state,
                      FitScratch& scratch) {
  const Layout layout(options, data);
  FitOutcome outcome;
  outcome.unknowns = layout.count();
  if (!options.stage_axis) {
    state.stage_axis = state.stage.R_camera_target.col(2);
  }
  set_staged_poses(data, state);
  outcome.sum_px2 = residuals(data, state);
  outcome.converged = descend(layout, data, state, scratch, outcome.sum_px2);
  for (const SeenDot& dot : data.dots) {
    outcome.dots += dot.used ? 1 : 0;
  }
  const std::int32_t left = 2 * outcome.dots - outcome.unknowns;
  if (left <= 0) {
    return outcome;
  }
  outcome.rms_px = std::sqrt(outcome.sum_px2 / outcome.dots);
  outcome.sigma_px = std::sqrt(outcome.sum_px2 / left);
  set_up(layout, data, state, scratch);
  outcome.determined = scratch.normal.factor(0.0);
  for (std::int32_t i = 0; outcome.determined && i < 6; ++i) {
    if (layout.of_shared(i) < 0) {
      continue;
    }
    scratch.normal.inverse_column(layout.of_shared(i), scratch.step.data());
    for (std::int32_t k = 0; k < 6; ++k) {
      if (layout.of_shared(k) >= 0) {
        outcome.camera_covariance(k, i) =
            outcome.sigma_px * outcome.sigma_px *
            scratch.step[static_cast<std::size_t>(layout.of_shared(k))];
      }
    }
  }
  if (outcome.determined && layout.axis() && layout.stage() >= 0) {
    tell_axis(layout, scratch, outcome);
  }
  return outcome;
}

double promised_gain(const FitOptions& options, const CalibrationData& data,
                     const CalibrationState& state, FitScratch& scratch) {
  const Layout layout(options, data);
  set_up(layout, data, state, scratch);
  if (!scratch.normal.factor(0.0)) {
    return 0.0;
  }
  scratch.normal.solve(scratch.step.data());
  return scratch.normal.gain(scratch.step.data());
}

}  // namespace tubesight::core::calibration
