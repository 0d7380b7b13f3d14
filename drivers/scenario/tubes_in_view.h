#pragma once

#include <vector>

#include "core/base/settings.h"
#include "core/base/tube_address.h"
#include "core/rendering/scene.h"
#include "core/rendering/truth.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::drivers {

/// A tube-end in the picture, or the place of one that is missing.
struct TubeInView {
  core::TubeAddress address;
  core::rendering::TubeEnd end;
  core::rendering::TubeImage image;
};

/// Replaces `tubes` by the tube-ends of which a part of the rim is in the picture, by growing
/// address: plugged ones too, those wholly behind the guidetube, and voids, as the recordings'
/// `centers.csv` have them.
void list_tubes_in_view(const core::rendering::Truth& truth, const core::rendering::Scene& scene,
                        const drivers::FieldTruth& field, const drivers::FieldFaults& faults,
                        std::vector<TubeInView>& tubes);

/// Chooses up to `count` tubes for an operator to click on: open, wholly in the window and in
/// sight, the first nearest to the optimum point, the next ones near it and not in one line. Fewer
/// than three: the picture does not show them.
[[nodiscard]] std::vector<TubeInView> choose_start_tubes(const std::vector<TubeInView>& in_view,
                                                         const core::StartSettings& start);

}  // namespace tubesight::drivers
