#pragma once

#include <array>
#include <cstdint>

#include "core/base/settings.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core::rendering {

/// What closes a tube.
enum class PlugKind : std::uint8_t {
  kRolled,  ///< a rolled-in plug: a disc with a hole that stands out of the tube-end
  kFlush,   ///< a welded plug, level with the sheet
};

/// A plug and where it is.
struct Plug {
  TubeAddress address;
  PlugKind kind = PlugKind::kRolled;
};

/// A tube-end that stands elsewhere than the lattice says, sheet frame.
struct DisplacedTube {
  TubeAddress address;
  std::array<double, 3> by_mm{};
};

/// What the plate and its tube-ends are like. Reflectances are diffuse, 0..1. All that is random is
/// a function of (Scene::seed, row, column) or of the place on the sheet, never of the order drawn.
struct SheetLook {
  double plate = 0.45;            ///< reflectance of the plate
  double gloss = 0.15;            ///< share of the light that a worn plate mirrors, roughly
  double texture = 0.05;          ///< relative spread of the fine grain (sigma)
  double stains = 0.10;           ///< relative spread of veins and stains (sigma)
  double weld = 0.65;             ///< reflectance of welds
  double weld_mm = 1.2;           ///< flush: width of the weld's ring around the bore
  double fillet_mm = 4.0;         ///< fillet: from the bore to the weld's foot, along the plate
  double fillet_height_mm = 3.0;  ///< fillet: how far the plate stands behind the rims
  double land_mm = 1.2;           ///< fillet: width of the tube-end's bright face
  double wall = 0.05;             ///< reflectance of the bore's inside
  double bore_spread_mm = 0.06;   ///< sigma of the bores' diameters
  double nicked = 0.08;           ///< share of the rims with a nick
  double nick_mm = 1.0;           ///< largest depth of a nick
  double boron = 0.0;             ///< share of the tube-ends with boron deposits beside them
  double plug = 0.6;              ///< reflectance of plugs
  double plug_hole = 0.6;         ///< rolled: radius of the hole, share of the bore's radius
  double plug_height_mm = 4.5;    ///< rolled: how far the plug stands out, towards the tool
};

/// The lighthouse: a ring of twelve lamps around the guidetube, and the ring of LEDs at the camera.
struct LampLook {
  double ring_radius_mm = 35.0;  ///< lamps from the guidetube's axis
  double below_tip_mm = 50.0;    ///< lamps below the guidetube's tip
  double strength = 1.0;         ///< full light of all twelve, 1: an ordinary picture
  double tilt_deg = 0.0;         ///< lamps lean outwards by this, from the guidetube's axis
  double beam = 2.0;             ///< exponent of the cosine of a lamp's beam; 0: everywhere alike
  double ambient = 0.0;          ///< share of light that comes by way of everything else
  double led_radius_mm = 20.0;   ///< camera's LEDs from its axis, in the plane of the lens
  double led_strength = 0.5;     ///< full light of the camera's LEDs, as `strength`
};

/// What the camera's optics and electronics do. Grey levels are of 0..255.
struct SensorLook {
  double blur_px = 0.7;          ///< sigma of the optical blur, 0.3..4 px
  double vignetting = 0.1;       ///< light lost in the farthest corner, 0..1
  double veil = 0.004;           ///< share of the whole light that the lens scatters over all
  double blooming = 0.15;        ///< share of the light above saturation that flows to around
  double blooming_px = 14.0;     ///< how far it flows
  double gain = 1.0;             ///< grey levels per ordinary grey level
  double offset = 7.0;           ///< black level, grey levels
  double saturation = 255.0;     ///< the brightest grey level, at most 255
  double shot_noise = 0.10;      ///< sigma = shot_noise * sqrt(grey level)
  double read_noise = 0.8;       ///< sigma, grey levels
  double emi_share = 0.0;        ///< share of the lines with interference
  double emi_amplitude = 20.0;   ///< of that, grey levels
  double salt_and_pepper = 0.0;  ///< share of the pixels black or white
};

/// The guidetube, seen from outside: from its tip down along the tool's -z.
struct GuidetubeLook {
  double radius_mm = 9.1;    ///< 0: none
  double length_mm = 33.0;   ///< visible length below the tip
  double reflectance = 0.3;  ///< of its side, diffuse, 0..1
  double shadow = 1.0;       ///< depth of its shadow from each lamp, 0 (none) to 1
};

/// Plugs and displaced tube-ends in one scene; the settings' lists hold up to kMaxListedTubes.
inline constexpr std::int32_t kMaxPlugs = 4096;
inline constexpr std::int32_t kMaxDisplacedTubes = 1024;

/// Everything that does not change from field to field. About 300 KB: static or heap.
///
/// Camera, tool and sheet are the TRUE ones; what the box believes is the affair of its settings.
/// `sheet.missing`: plain plate (stays, voids). A plug stands at every address of `plugs` and of
/// `sheet.plugged`; the kind of those in the latter alone is rolled or flush by the seed.
struct Scene {
  CameraSettings camera;
  ToolSettings tool;
  TubesheetSettings sheet;
  SheetLook look;
  LampLook lamp;
  SensorLook sensor;
  GuidetubeLook guidetube;
  std::uint64_t seed = 1;
  StaticVector<Plug, kMaxPlugs> plugs;
  StaticVector<DisplacedTube, kMaxDisplacedTubes> displaced;
};

}  // namespace tubesight::core::rendering
