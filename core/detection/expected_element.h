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
/// Or this one where the form is known: a guidetube hides the rest, or there is no light on it.
inline constexpr double kLeastKnownShare = 0.33;

/// From one edge to the next, by the shorter step in radii.
[[nodiscard]] double room_of(const Ellipse& ellipse, const Steps& steps);

/// The half axes of an ellipse where another one is the unit circle.
[[nodiscard]] Eigen::Vector2d axes_by(const Ellipse& expected, const Ellipse& ellipse);

/// How near an element is to what its neighbours let expect.
struct Likeness {
  double gate = 0.3;         ///< its centre, in shares of the shorter step
  double least_form = 0.75;  ///< the half axes, in shares of those expected
  double most_form = 1.3;
};

/// For what a spot shows; what is looked for; what shows little of an edge. The next element is a
/// whole step off.
inline constexpr Likeness kStranger = {0.3, 0.75, 1.3};
inline constexpr Likeness kNewcomer = {0.15, 0.85, 1.18};
inline constexpr Likeness kUnsure = {0.06, 0.85, 1.18};

/// Below this half axis an edge is mostly blur, and the spot is weighed.
inline constexpr double kLeastMeasured_px = 6.5;

/// How far an ellipse is from where the map expects an element, and from its size and form: above 1
/// it is none.
[[nodiscard]] double strangeness(const LocalMap& map, const Ellipse& ellipse, const Steps& steps,
                                 const Likeness& like);

/// Of what cannot be an element at all.
inline constexpr double kMostStrange = 1e9;

/// Measures an element where its ellipse is expected: once from afar, once from near. Its
/// `levels.black` says what is dark there.
[[nodiscard]] bool look_for_edge(const picture::AveragedPicture& stretched, const Steps& steps,
                                 ElementScratch& scratch, LatticeElement& element);

/// The same in little light, where the place is expected to a pixel: by the contrast all along the
/// outline together.
[[nodiscard]] bool look_for_contrast(const picture::AveragedPicture& stretched,
                                     LatticeElement& element);

/// Whether the light inside a measured element is that of a plug in it, or of no tube-end at all.
/// `black`: what is dark in those around.
[[nodiscard]] bool is_closed(const LatticeElement& element, double black);

/// The same where a spot shows it: once, from near.
[[nodiscard]] bool measure_spot(const picture::AveragedPicture& stretched, const Steps& steps,
                                ElementScratch& scratch, LatticeElement& element);

/// The same for an element too small for that; it must be as dark as its neighbour.
[[nodiscard]] bool look_for_spot(const picture::AveragedPicture& stretched,
                                 const Ellipse& neighbour, const Steps& steps,
                                 double least_contrast, LatticeElement& element);

}  // namespace tubesight::core::detection
