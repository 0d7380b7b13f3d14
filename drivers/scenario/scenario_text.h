#pragma once

#include <string>

#include "drivers/scenario/scenario_file.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::drivers {

/// A scenario as a file that `tubesight simulate` takes; numbers in their shortest exact form.
/// `expect` is written where it is not null.
///
/// What the reader of scenarios makes of it is `scenario`; both go by the keys of scenario_keys.h.
/// What is true of camera, tool and sheet is written as errors of the calibration and comes back
/// right to the last bit but one. The wishes that a file may hold have become what they ask for:
/// tours, scatter and claims of steps are moves and events, `click_on` is clicks.
///
/// Not every scenario has a file: none with a robot, a kJump segment or without clicks is to be
/// given.
[[nodiscard]] std::string scenario_text(const drivers::Scenario& scenario, const std::string& title,
                                        const Expectation* expect = nullptr);

}  // namespace tubesight::drivers
