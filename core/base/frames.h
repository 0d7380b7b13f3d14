#pragma once

namespace tubesight::core::frames {

// The closed list of coordinate frames; docs and settings say which way they point.

struct Image {};   ///< full-frame pixels, origin at the centre of the top-left pixel
struct Camera {};  ///< origin at the projection point, x right, y down, z to the scene
struct Tool {};    ///< origin at the guidetube's tip, z along its axis towards the sheet
struct Sheet {};   ///< in the plane of the tube-ends, z away from the tool into the tubes
struct Base {};    ///< the robot's own

}  // namespace tubesight::core::frames
