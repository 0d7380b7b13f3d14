#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/result.h"
#include "core/base/sighting.h"
#include "core/base/transform.h"
#include "core/pose/conic.h"

namespace tubesight::core::pose {

/// An ellipse of the image plane and the circle of the sheet that it shows.
struct SeenCircle {
  Conic conic = Conic::Zero();
  Eigen::Vector2d center_mm = Eigen::Vector2d::Zero();  ///< by the lattice
};

/// How the image of a circle's centre is constructed; the ellipse's own centre is not it.
enum class CenterConstruction : std::uint8_t {
  kTangentPoints,  ///< joins of opposite tangent points, met [Fallon fig. 5.12]
  kTangentLines,   ///< diagonals of the four tangent lines' quadrangle [Fallon fig. 5.13]
};

/// The image of the centre of `circles[index]` from its neighbours: two at least, in directions 30
/// degrees apart.
///
/// Equal circles: the two outer bitangents with a neighbour run along the join of the centres and
/// touch at the ends of the diameter across it. Joining these ends gives an image of that diameter,
/// and the diameters of several neighbours meet in the centre's image (in the least squares sense).
/// Or, without the touching points, the four tangent lines of two neighbours make a rhombus about
/// the circle, whose diagonals meet in it. A difference of radii dr between neighbours D apart
/// moves either by about r dr / D, whatever the noise.
///
/// `reach_mm`: neighbours farther off are not used. kBufferTooSmall: not enough neighbours;
/// kIllConditioned: ellipses overlap.
[[nodiscard]] Result<Eigen::Vector2d> construct_center(std::span<const SeenCircle> circles,
                                                       std::size_t index,
                                                       CenterConstruction construction,
                                                       double reach_mm);

/// The ellipse that a circle of the sheet's plane shows as, C = H^-T diag(1, 1, -r^2) H^-1 with H
/// from the circle's own coordinates to the image plane [Fallon eq. 5.10].
[[nodiscard]] Conic image_of_circle(const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
                                    const Eigen::Vector2d& center_mm, double radius_mm);

/// The radius of the circle whose image has the area that the ellipse has: where edges bloom and
/// bores vary, eccentricity follows what is seen.
[[nodiscard]] double apparent_radius(const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
                                     const SeenCircle& circle, double nominal_mm);

/// From the ellipse's centre to the image of the circle's centre, by the pose: add it to a measured
/// ellipse's centre. In closed form: the ellipse's centre is the image of
/// t' t'_z - r^2 (R_31 R_1 + R_32 R_2), t' being the circle's centre in the camera frame.
[[nodiscard]] Eigen::Vector2d eccentricity(
    const Transform<frames::Camera, frames::Sheet>& T_camera_sheet,
    const Eigen::Vector2d& center_mm, double radius_mm);

/// The normals of the planes in which a circle may lie that shows as this ellipse: two, by the
/// circular sections of its cone of sight. Unit vectors, camera frame, of either sense; equal when
/// the circle is seen straight on. Some 2 degrees off from edges of 0.3 px.
[[nodiscard]] std::array<Eigen::Vector3d, 2> circle_normals(const Conic& conic);

/// The image of the circle's centre when its plane has this normal: the pole of the line on which
/// the plane vanishes, C^-1 n. Wrong by a tenth of the eccentricity for each 6 degrees of n or
/// less.
[[nodiscard]] Eigen::Vector2d center_by_normal(const Conic& conic, const Eigen::Vector3d& normal);

}  // namespace tubesight::core::pose
