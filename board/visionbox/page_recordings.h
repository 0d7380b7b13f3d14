#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "board/visionbox/page_json.h"
#include "drivers/web/page_server.h"

namespace tubesight::board {

/// Whether a name is one of a file that a box's recorder writes, and no path.
[[nodiscard]] bool is_recording_name(std::string_view name);

/// [{name, bytes, at, reason}] of the recorder's files in a folder; empty where there is none.
[[nodiscard]] Json list_recordings(const std::string& folder);

/// One of them, as it lies on the disk; empty: there is none of that name.
[[nodiscard]] std::optional<drivers::PageAnswer> download_recording(const std::string& folder,
                                                                    const std::string& name);

}  // namespace tubesight::board
