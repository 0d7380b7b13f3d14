#pragma once

#include <string>

#include "core/calibration/camera_calibration.h"
#include "core/calibration/halves.h"
#include "core/calibration/next_view.h"

namespace tubesight::board {

/// How well the two halves of the data agree: a line for a person, two where they do not.
[[nodiscard]] std::string halves_text(const core::calibration::HalvesOutcome& halves);

/// Which view to take next where the map is known too little for everything: a line for a person.
[[nodiscard]] std::string next_text(const core::calibration::NextViewOutcome& next,
                                    const core::calibration::MapUncertainty& map);

/// What the camera leaves of the guidetube's tip at working distances: lines for a person. Nothing
/// where a tubesheet's tube-ends are too few in this camera's picture.
[[nodiscard]] std::string tip_text(const core::calibration::Sensor& sensor,
                                   const core::calibration::CameraValues& camera,
                                   const core::math::Matrix6d& covariance);

}  // namespace tubesight::board
