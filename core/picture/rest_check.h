#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::picture {

/// How far a picture lies off another one.
struct PictureShift {
  bool known = false;      ///< the pictures hold enough structure to tell
  double mean_u_px = 0.0;  ///< shift of the picture's middle
  double mean_v_px = 0.0;
  double largest_px = 0.0;  ///< of any place of the picture
};

/// A camera at rest shows less than this from frame to frame, anywhere in the picture. Noise gives
/// some 0.01 px; a tool that creeps at 1.5 mm/s under a sheet 120 mm away gives it within a frame.
inline constexpr double kLargestFrameShift_px = 1.0;

/// And less than this between the two fields of a frame, whose lines are interpolated to be
/// compared: that alone gives up to 0.1 px at a corner. A tool at 10 mm/s gives it.
inline constexpr double kLargestFieldShift_px = 0.4;

/// How far `field` lies off the average of the same lines so far, by least squares on grey levels
/// over six numbers of an affine shift and two of the lamp's brightness.
///
/// The shift is found to first order: one beyond the width of an edge comes out too small, but
/// never as rest. Needs the lines of the field summed at least once. Costs some 5 ms a full frame.
[[nodiscard]] PictureShift shift_between_frames(const PictureAverage& average,
                                                const FieldView& field);

/// How far the odd lines of an average lie off the even ones: what a moving camera does between the
/// two fields of an interlaced frame. Needs both summed.
[[nodiscard]] PictureShift shift_between_fields(const PictureAverage& average);

}  // namespace tubesight::core::picture
