#pragma once

#include <string>
#include <string_view>

#include "core/calibration/camera_calibration.h"
#include "core/calibration/halves.h"
#include "core/calibration/next_view.h"

namespace tubesight::board {

/// How well the map from pixels to rays is known: a line for a person, what it is about in a column
/// of `width` letters.
[[nodiscard]] std::string map_text(const core::calibration::MapUncertainty& map, int width);

/// What a calibration may be used for: a line for a person, likewise.
[[nodiscard]] std::string use_text(std::string_view use, int width);

/// Which two of a calibration's values go together most, and how much: a line likewise.
[[nodiscard]] std::string correlation_text(double correlation, std::string_view one,
                                           std::string_view other, int width);

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
