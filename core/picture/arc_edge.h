#pragma once

#include <cstdint>

#include "core/picture/averaged_picture.h"
#include "core/picture/rim_outline.h"

namespace tubesight::core::picture {

/// How an edge is placed across its direction; compared in docs/accuracy.md.
enum class EdgeMethod : std::uint8_t {
  kBlurredStep,  ///< least squares of a step blurred by a Gaussian
  kMidLevel,     ///< where the profile crosses the middle between its levels
  kMoment,       ///< by the profile's area between its levels
};

/// How the edge of a rim is placed.
struct ArcEdgeOptions {
  EdgeMethod method = EdgeMethod::kBlurredStep;
  double search_px = 4.0;       ///< the edge is this near to the outline
  double inner_px = 2.5;        ///< of the profile that is used, on the dark side of the edge
  double outer_px = 1.25;       ///< and on the bright side: rims and sheet are unevenly bright
  double blur_px = 0.7;         ///< sigma of the step's Gaussian
  double bloom_px = 0.3;        ///< sigma of an edge beside a saturated rim
  double least_contrast = 6.0;  ///< grey levels from dark to bright
  double noise_grey = 1.0;      ///< of a pixel of the average: what a sigma is made from at least
};

/// Why an arc gave no edge.
enum class ArcRefusal : std::uint8_t {
  kNone,
  kOutside,  ///< not in the picture
  kNoRise,   ///< no rise from dark to bright within the search
  kLowContrast,
  kNoFit,  ///< the profile is not that of a step
};

/// An edge across one arc.
struct ArcEdge {
  ArcRefusal refusal = ArcRefusal::kNone;
  double offset_px = 0.0;  ///< from the outline along its normal, outwards
  double sigma_px = 0.0;
  double dark = 0.0;  ///< levels, grey
  double bright = 0.0;
  double rms_grey = 0.0;  ///< of the fit
};

/// Places the edge at one arc of a predicted outline.
///
/// All pixels beside the arc make one profile by their own distances from the curved outline, so
/// that nothing is interpolated between pixels and the edge is sampled many times finer than they
/// stand. Costs some 2 us.
[[nodiscard]] ArcEdge find_arc_edge(const AveragedPicture& picture, const OutlineArc& arc,
                                    const ArcEdgeOptions& options);

}  // namespace tubesight::core::picture
