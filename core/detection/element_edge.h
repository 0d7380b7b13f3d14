#pragma once

#include <array>
#include <cstdint>

#include "core/detection/ellipse.h"
#include "core/picture/averaged_picture.h"
#include "core/picture/rim.h"
#include "core/picture/rim_outline.h"
#include "core/pose/plane_points.h"

namespace tubesight::core::detection {

/// Scratch memory of measure_element(), 40 KB.
struct ElementScratch {
  picture::RimOutline outline;
  picture::Rim rim;
  std::array<pose::PlanePoint, picture::kMaxRimPoints> points;
};

/// An element's edge as measured.
struct ElementEdge {
  Ellipse ellipse;
  double share = 0.0;   ///< of the outline's pieces that are on the edge
  double rms_px = 0.0;  ///< of the edge's points from the ellipse
};

/// Where an element is looked for.
struct ElementSearch {
  double reach_px = 2.0;  ///< its edge lies this near to the outline expected
  double room_px = 10.0;  ///< from its edge to that of the next one
  /// What counts as black there, grey levels: the inside is not as bright as what is around it.
  double black_grey = 0.0;
  /// The outline expected has the element's form: where little of the edge is seen it is moved and
  /// grown, no more.
  bool form_known = false;
};

/// The light inside an ellipse and around it, in grey levels.
struct Levels {
  double black = 0.0;         ///< mean of the darkest quarter of the inside
  double around = 0.0;        ///< usual around it
  double bright_share = 0.0;  ///< of the inside that is nearly as bright as that
  double bright = 0.0;        ///< what a seventh of the inside is brighter than
};
/// The mean of a pixel and the four beside it: its noise is halved, and an edge hardly moved.
[[nodiscard]] double level_at(const picture::AveragedPicture& picture, const Eigen::Vector2d& at);

[[nodiscard]] Levels measure_levels(const picture::AveragedPicture& picture,
                                    const Ellipse& ellipse);

/// Measures a dark element's edge to a fraction of a pixel and fits an ellipse to it.
///
/// In a picture whose darkest is near zero: measure_rim() asks whether the inside is dark. False:
/// too little of the edge was found for an ellipse, or it has none of the size expected to a third.
[[nodiscard]] bool measure_element(const picture::AveragedPicture& picture, const Ellipse& expected,
                                   const ElementSearch& search, ElementScratch& scratch,
                                   ElementEdge& edge);

}  // namespace tubesight::core::detection
