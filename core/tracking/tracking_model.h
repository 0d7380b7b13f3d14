#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/base/vector3.h"
#include "core/camera/camera_model.h"
#include "core/camera/virtual_plane.h"
#include "core/tubesheet/lattice.h"

namespace tubesight::core::tracking {

/// How fast one of a pose's numbers may change.
template <Scalar S>
struct RateLimits {
  Mm<S> speed{};         ///< mm/s or rad/s
  Mm<S> acceleration{};  ///< m/s^2 or rad/s^2
};

/// What stays the same for a whole session, in the numbers of the path; made by
/// make_tracking_model() in tracking_setup.h.
template <Scalar S>
struct TrackingModel {
  camera::CameraModel<S> camera;
  camera::VirtualPlane<S> virtual_plane;  ///< its axes are the tool's, in the camera frame
  Vector3<Mm<S>> tip_mm{};                ///< the guidetube's tip in the camera frame
  tubesheet::Lattice<S> lattice;
  Mm<S> bore_radius_mm{};
  Weld weld = Weld::kFlush;
  Parity first_field = Parity::kProgressive;  ///< of an interlaced frame: the one taken first
  std::int32_t picture_width_px = 0;
  std::int32_t picture_height_px = 0;
  /// Pixels from one reading of a search to the next, and to which limits in pixels refer: 1 in
  /// pictures of some 640 columns, and as many more as the picture has more, so that a search sees
  /// the same share of the picture, at the same cost, whatever its size.
  std::int32_t reading_step_px = 1;

  PixelBox window;  ///< where tube-ends are searched for
  Vector2<Px<S>> optimum_px{};

  Mm<S> max_speed_mm_s{};
  Mm<S> max_acceleration_m_s2{};  ///< in metres: 3000 mm/s^2 and more leave the format
  RateLimits<S> height;
  RateLimits<S> turn;
  RateLimits<S> lean;
  Mm<S> aligned_within_mm{};
  std::int32_t initial_threshold = 200;
  std::int32_t region_threshold = 0;  ///< zero: midway between clicked tube-ends and their sheet
};

}  // namespace tubesight::core::tracking
