#pragma once

#include <Eigen/Core>

#include "core/detection/element_edge.h"
#include "core/detection/ellipse.h"
#include "core/detection/lattice_finder.h"
#include "core/detection/lattice_growth.h"
#include "core/detection/local_map.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// Once an edge is found it is measured again within this.
inline constexpr double kFineReach_px = 2.5;
/// This share of an edge must be seen.
inline constexpr double kLeastShare = 0.5;

/// From one edge to the next, by the shorter step in radii.
[[nodiscard]] double room_of(const Ellipse& ellipse, const Steps& steps);

/// The half axes of an ellipse where another one is the unit circle.
[[nodiscard]] Eigen::Vector2d axes_by(const Ellipse& expected, const Ellipse& ellipse);

/// How far an ellipse is from where the map expects an element, and from its size and form: above 1
/// it is none. `gate` is in shares of the shorter step.
[[nodiscard]] double strangeness(const LocalMap& map, const Ellipse& ellipse, const Steps& steps,
                                 double gate);

/// Of what cannot be an element at all.
inline constexpr double kMostStrange = 1e9;

/// Measures an element where its ellipse is expected: once from afar, once from near.
[[nodiscard]] bool look_for_edge(const picture::AveragedPicture& stretched, const Steps& steps,
                                 ElementScratch& scratch, LatticeElement& element);

/// The same where a spot shows it: once, from near.
[[nodiscard]] bool measure_spot(const picture::AveragedPicture& stretched, const Steps& steps,
                                ElementScratch& scratch, LatticeElement& element);

/// The same for an element too small for that; it must be as dark as its neighbour.
[[nodiscard]] bool look_for_spot(const picture::AveragedPicture& stretched,
                                 const Ellipse& neighbour, const Steps& steps,
                                 double least_contrast, LatticeElement& element);

}  // namespace tubesight::core::detection
