#include "core/tracking/tracking_setup.h"

#include <algorithm>
#include <array>

#include "core/base/instantiate.h"
#include "core/base/transform.h"
#include "core/base/trigonometry.h"
#include "core/camera/camera_setup.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::core::tracking {
namespace {

// In radians they stay within the numbers.
bool turns_in_range(double speed_deg_s, double acceleration_deg_s2) {
  return speed_deg_s > 0.0 && speed_deg_s <= 1.0e5 && acceleration_deg_s2 > 0.0 &&
         acceleration_deg_s2 <= 1.0e5;
}

bool limits_in_range(const MotionSettings& motion) {
  const auto of_zero_to = [](double value, double most) { return value >= 0.0 && value <= most; };
  return motion.max_speed_mm_s > 0.0 && motion.max_speed_mm_s <= 2000.0 &&
         motion.max_acceleration_mm_s2 > 0.0 && motion.max_acceleration_mm_s2 <= 1.0e6 &&
         of_zero_to(motion.max_height_speed_mm_s, 2000.0) &&
         of_zero_to(motion.max_height_acceleration_mm_s2, 1.0e6) &&
         turns_in_range(motion.max_turn_speed_deg_s, motion.max_turn_acceleration_deg_s2) &&
         turns_in_range(motion.max_lean_speed_deg_s, motion.max_lean_acceleration_deg_s2);
}

template <Scalar S>
RateLimits<S> turn_limits(double speed_deg_s, double acceleration_deg_s2) {
  constexpr double kRad = kPi / 180.0;
  return {Mm<S>(speed_deg_s * kRad), Mm<S>(acceleration_deg_s2 * kRad)};
}

}  // namespace

template <Scalar S>
Result<void> make_tracking_model(const SessionSettings& settings, TrackingModel<S>& model) {
  const auto camera = camera::make_camera_model<S>(settings.camera);
  if (!camera) {
    return Unexpected(camera.error());
  }
  const auto lattice = tubesheet::make_lattice<S>(settings.tubesheet);
  if (!lattice) {
    return Unexpected(lattice.error());
  }
  const auto& tip = settings.tool.position_mm;
  for (const double coordinate : tip) {
    if (!(coordinate > -1000.0 && coordinate < 1000.0)) {
      return Unexpected(Error::kOutOfRange);
    }
  }
  const auto& motion = settings.motion;
  if (!limits_in_range(motion)) {
    return Unexpected(Error::kOutOfRange);
  }
  const Transform<frames::Camera, frames::Tool> T_camera_tool(
      rotation_from_degrees(settings.tool.rotation_deg), {tip[0], tip[1], tip[2]});
  model.camera = *camera;
  model.lattice = *lattice;
  model.virtual_plane = camera::make_virtual_plane<S>(T_camera_tool);
  model.tip_mm = {Mm<S>(tip[0]), Mm<S>(tip[1]), Mm<S>(tip[2])};
  model.bore_radius_mm = Mm<S>(settings.tubesheet.bore_mm / 2.0);
  model.weld = settings.tubesheet.weld;
  model.first_field = parity_of(settings.camera.scan, false);
  model.picture_width_px = settings.camera.width_px;
  model.picture_height_px = settings.camera.height_px;
  constexpr std::int32_t kUsualSide_px = 640;
  const std::int32_t side_px = std::max(model.picture_width_px, model.picture_height_px);
  model.reading_step_px = std::max((side_px + kUsualSide_px / 2) / kUsualSide_px, 1);
  const auto& window = settings.start.window_px;
  model.window = {window[0], window[1], window[2], window[3]};
  model.optimum_px = {Px<S>(settings.start.optimum_px[0]), Px<S>(settings.start.optimum_px[1])};
  model.max_speed_mm_s = Mm<S>(motion.max_speed_mm_s);
  model.max_acceleration_m_s2 = Mm<S>(motion.max_acceleration_mm_s2 / 1000.0);
  model.height = {motion.max_height_speed_mm_s > 0.0 ? Mm<S>(motion.max_height_speed_mm_s)
                                                     : model.max_speed_mm_s,
                  motion.max_height_acceleration_mm_s2 > 0.0
                      ? Mm<S>(motion.max_height_acceleration_mm_s2 / 1000.0)
                      : model.max_acceleration_m_s2};
  model.turn = turn_limits<S>(motion.max_turn_speed_deg_s, motion.max_turn_acceleration_deg_s2);
  model.lean = turn_limits<S>(motion.max_lean_speed_deg_s, motion.max_lean_acceleration_deg_s2);
  model.aligned_within_mm = Mm<S>(settings.verification.aligned_within_mm);
  // Zero asks for the program's own.
  constexpr EdgeSettings kOwn;
  const EdgeSettings& edges = settings.edges;
  model.initial_threshold =
      edges.initial_threshold > 0 ? edges.initial_threshold : kOwn.initial_threshold;
  model.region_threshold = edges.region_threshold;
  return {};
}

ImagePoint make_image_point(const std::array<double, 2>& at_px) {
  return {Fixed<16, 16>(at_px[0]).raw(), Fixed<16, 16>(at_px[1]).raw()};
}

StartClickList make_start_clicks(const StaticVector<StartPoint, kMaxStartPoints>& points) {
  StartClickList clicks;
  for (const StartPoint& point : points) {
    const ImagePoint at = make_image_point(point.at_px);
    static_cast<void>(clicks.try_push_back({point.address, at.u_q16, at.v_q16}));
  }
  return clicks;
}

#define TUBESIGHT_INSTANTIATE(S) \
  template Result<void> make_tracking_model<S>(const SessionSettings&, TrackingModel<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
