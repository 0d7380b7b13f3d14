#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "drivers/v4l2/kernel.h"
#include "drivers/v4l2/v4l2_settings.h"

namespace tubesight::drivers::v4l2 {

/// Whether two names of controls, or of their entries, are one: letters of either case.
[[nodiscard]] bool same_name(std::string_view a, std::string_view b);

/// The names of the controls that a camera has.
[[nodiscard]] std::vector<std::string> control_names(Kernel& kernel, int descriptor);

/// Sets controls by their names and reads each back.
///
/// Errors: kUnsupported there is no such control, entry or value; kIo it was refused or not kept;
/// `message` says which, what it offers and what was wanted.
[[nodiscard]] core::Result<void> set_controls(Kernel& kernel, int descriptor,
                                              const std::vector<ControlSetting>& controls,
                                              std::string& message);

}  // namespace tubesight::drivers::v4l2
