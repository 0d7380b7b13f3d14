#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "drivers/files/messages.h"

namespace tubesight::drivers {

/// The file that stands beside a recording: its path without `.y4m` or `.y4m.xz`, plus `suffix`
/// (".meta.csv", say). A recording that is named otherwise keeps its whole name.
[[nodiscard]] std::string companion_path(std::string_view recording, std::string_view suffix);

/// Reads a companion that need not be there: false when there is none.
///
/// Errors: kIo it is there and cannot be read, kOutOfRange longer than 256 MiB; with one message.
[[nodiscard]] core::Result<bool> read_companion(const std::string& path, std::string& text,
                                                Messages& messages);

}  // namespace tubesight::drivers
