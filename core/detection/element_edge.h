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
};

/// Measures a dark element's edge to a fraction of a pixel and fits an ellipse to it.
///
/// In a picture whose darkest is near zero: measure_rim() asks whether the inside is dark. False:
/// too little of the edge was found for an ellipse, or it has none of the size expected to a third.
[[nodiscard]] bool measure_element(const picture::AveragedPicture& picture, const Ellipse& expected,
                                   const ElementSearch& search, ElementScratch& scratch,
                                   ElementEdge& edge);

}  // namespace tubesight::core::detection
