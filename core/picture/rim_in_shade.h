#pragma once

#include "core/picture/averaged_picture.h"
#include "core/picture/rim.h"
#include "core/picture/rim_measurement.h"
#include "core/picture/rim_outline.h"

namespace tubesight::core::picture {

/// What a tube-end's inside is compared with, so that it is not taken for a plug.
struct RimDarkness {
  double black_grey = 0.0;   ///< what counts as black there
  double most_inside = 0.6;  ///< the inside's level above it, of that around, is below this
};

/// measure_rim() where the camera's veil, or what little light there is, is not far below the
/// sheet.
[[nodiscard]] RimFinding measure_rim_in_shade(const AveragedPicture& picture,
                                              const RimOutline& outline,
                                              const RimMeasureOptions& options,
                                              const RimDarkness& darkness, Rim& rim);

}  // namespace tubesight::core::picture
