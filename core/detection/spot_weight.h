#pragma once

#include "core/detection/ellipse.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// Places a small dark spot by its grey levels: each pixel counts by how far it is from the level
/// around to the spot's own. `room_px` to the next spot's edge; the ellipse, of the spot's pixels
/// or expected before, takes the weighed centre and form.
///
/// Returns the contrast between the spot and what is around in grey levels; 0, and the ellipse as
/// it was, where there is no spot; -1, and likewise, where its surroundings leave the picture.
double weigh_spot(const picture::AveragedPicture& picture, double room_px, Ellipse& ellipse);

}  // namespace tubesight::core::detection
