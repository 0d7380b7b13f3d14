#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "drivers/aravis/library.h"

namespace tubesight::drivers::aravis {

/// The camera of those that answered which has a serial number, as its place in the list.
///
/// Errors: kDisconnected none has it; kUnsupported several have it, as makers give numbers each for
/// himself: which one is meant cannot be told. `why` says it and names those that there are.
[[nodiscard]] core::Result<std::size_t> choose_by_serial(const std::vector<CameraInfo>& cameras,
                                                         const std::string& serial,
                                                         std::string& why);

}  // namespace tubesight::drivers::aravis
