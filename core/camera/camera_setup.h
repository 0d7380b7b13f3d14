#pragma once

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/transform.h"
#include "core/camera/camera_model.h"
#include "core/camera/virtual_plane.h"

namespace tubesight::core::camera {

/// The model for the settings, or kOutOfRange when a value leaves the number format: a cell, scale
/// or count not above zero, fewer than 32 or more than 16,000 pixels per EFL, an image centre
/// beyond 8192 px, |k EFL^2| or |k2 EFL^4| of 2 or more, or a picture that fit_radial_inverse()
/// refuses (folded over by pin-cushion distortion, or over 60 degrees off the axis).
///
/// Double precision, + - x / and square root only, so that every machine gets the same numbers.
template <Scalar S>
[[nodiscard]] Result<CameraModel<S>> make_camera_model(const CameraSettings& settings);

/// The virtual plane of a camera with its tool calibration.
template <Scalar S>
[[nodiscard]] VirtualPlane<S> make_virtual_plane(
    const Transform<frames::Camera, frames::Tool>& T_camera_tool);

}  // namespace tubesight::core::camera
