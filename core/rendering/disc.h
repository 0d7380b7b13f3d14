#pragma once

#include <cstdint>

#include "core/rendering/row.h"

namespace tubesight::core::rendering {

/// A round thing of the sheet as a line of the picture meets it: the inside of a bore, a weld, a
/// plug.
///
/// For a pixel's ray (x, y, 1) the point on the disc's plane, from its centre and in the sheet's
/// directions, is ((ax dx + ay dy) / w, (bx dx + by dy) / w), dx = x - center_x, dy = y - center_y,
/// w = gx x + gy y + gz: exact, and small numbers near the rim, so that float suffices.
struct Disc {
  enum class Kind : std::uint8_t { kBore, kSolid };

  float center_x = 0, center_y = 0;      ///< ray of the centre
  float ax = 0, ay = 0, bx = 0, by = 0;  ///< mm
  float gx = 0, gy = 0, gz = 0;          ///< ray along the sheet's normal
  float ray_uu = 0, ray_uv = 0,
        ray_vv = 0;              ///< change of the ray by pixel at the centre: x by u ...
  float ray_vu = 0;              ///< ... y by u; ray_uv: x by v
  float radius = 0;              ///< mm
  float per_radius = 0;          ///< 1 / radius
  float nick_x = 1, nick_y = 0;  ///< direction of a nick
  float nick_depth = 0;          ///< mm
  float per_bell = 1;            ///< 1 / half width of the optics' bell, 1/px
  // Bore: what is seen of its wall. eye: camera from the centre, mm; z: the disc's plane above it.
  float eye_x = 0, eye_y = 0, eye_z = 0;
  float per_eye_z = 1;                   ///< 1 / eye_z
  float lamp_x = 0, lamp_y = 0;          ///< horizontal direction to the lighthouse
  float lamp_slope = 0;                  ///< height over distance of that direction
  float wall = 0, led = 0, floor = 0;    ///< grey levels
  float ring_radius = 0, ring_gain = 0;  ///< flush weld around it: outer radius, mm, and factor - 1
  // Solid: grey level = light (level + level_x nx + level_y ny) + extra, n the outward direction.
  float level = 0, level_x = 0, level_y = 0, extra = 0;
  /// An ellipse in the picture: a du^2 + 2 b du dv + c dv^2 <= 1 from the span's centre.
  struct Span {
    float a = 1, b = 0, c = 1;
  };
  // Where it is in the picture: outside `outer` it is not felt, inside `inner` its edge is not.
  float span_u = 0, span_v = 0;
  Span outer, inner;
  float minor_px = 0;  ///< shorter half axis of the rim's image
  bool has_inner = false;
  std::int32_t top = 0, bottom = -1;  ///< first and last line, full frame
  Kind kind = Kind::kSolid;
};

/// Mean grey level of what is seen through a bore's opening.
[[nodiscard]] float mean_inside(const Disc& bore);

/// Draws the part of a disc in line `v`, columns first..last, over `row.signal`. `first` and
/// `last` + 1 are multiples of 4.
void draw_disc(const Disc& disc, std::int32_t v, std::int32_t first, std::int32_t last, bool moves,
               Row& row);

}  // namespace tubesight::core::rendering
