#pragma once

#include "tests/core/overlay/scenes.h"

namespace tubesight::tests {

/// docs/pictures/overlay-legend.png: each mark as the product draws it, and what it means.
[[nodiscard]] Picture draw_legend();

}  // namespace tubesight::tests
