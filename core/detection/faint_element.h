#pragma once

#include "core/detection/ellipse.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// The light inside an outline expected and beside it, by which an open tube-end without a clear
/// edge is told from a plug, from bare sheet and from what hides it.
///
/// A lamp that shines into a bore lights the wall away from it; the near one stays dark. So the
/// inside of an open tube-end is a slope: at its dark end far darker than the sheet beside that
/// end, elsewhere perhaps as bright as the sheet. A flush plug is as bright as the sheet at both
/// ends, a rolled one has steps inside, and a guidetube before it darkens what is around, too.
struct FaintLook {
  double seen = 0.0;      ///< of the ways across the outline, that are in the picture
  double contrast = 0.0;  ///< across the outline at the inside's dark end, grey levels
  double sigma = 0.0;     ///< of the contrast, by the scatter from one way to the next
  double share = 0.0;     ///< of the ways seen, with a fifth of that contrast or more
  double slope = 0.0;     ///< of the inside from its middle to the bright end, over the contrast
  double light = 0.0;     ///< of the sheet beside the dark end, grey levels
  double dark = 1.0;      ///< level at the dark end over that light
  double uneven = 1.0;    ///< RMS of the inside from a slope over the contrast
  double around = 0.0;    ///< the darkest eighth of what is around over the median of the eighths
};

/// Looks at a place to which its neighbours let expect `expected`, to a pixel or two. In a picture
/// whose darkest is zero. Some 400 places of the picture are read.
[[nodiscard]] FaintLook look_at_faint(const picture::AveragedPicture& picture,
                                      const Ellipse& expected);

/// Where near `expected` the contrast across the outline is highest: no farther off than a few
/// pixels and no more than two fifths of the shorter half axis.
[[nodiscard]] Ellipse move_to_contrast(const picture::AveragedPicture& picture,
                                       const Ellipse& expected);

/// Whether so much of a contrast is there that a tube-end may stand beside the place.
[[nodiscard]] bool may_be_beside(const FaintLook& look);

/// Whether the light is that of an open tube-end. When in doubt it is not.
[[nodiscard]] bool is_open(const FaintLook& look);

/// Whether the light is that of none, where nothing hides it. When in doubt it is not.
[[nodiscard]] bool is_none(const FaintLook& look);

}  // namespace tubesight::core::detection
