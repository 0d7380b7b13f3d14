#pragma once

#include "core/base/settings.h"
#include "core/rendering/scene.h"
#include "drivers/settings/settings_document.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::drivers {

/// Makes the true camera, tool and sheet of `told` and of what `[calibration_error]` and `[sheet]`
/// say, and the looks of `[look]`, `[lamp]`, `[sensor]` and `[guidetube]`. `told` is sound.
void read_scene(drivers::SettingsDocument& document, const core::SessionSettings& told,
                core::rendering::Scene& scene);

/// `[lamp]`: the light as it is commanded, and what the lamps are like.
void read_lamp(drivers::SettingsDocument& document, drivers::SimulatedLight& light,
               core::rendering::LampLook& look);

}  // namespace tubesight::drivers
