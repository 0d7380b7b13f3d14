#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace tubesight::drivers {

/// Makes a file that was not there, with these permissions and this text, so that it is there whole
/// after a power cut once this returns. Errors: kIo, and why in one line; kInvalidArgument it is
/// there already.
[[nodiscard]] core::Result<void> make_synced_file(const std::string& path, std::string_view text,
                                                  unsigned permissions, std::string& message);

/// Gives a file another name that is free, safe from power cuts. Errors: kIo, and why.
[[nodiscard]] core::Result<void> move_synced(const std::string& from, const std::string& to,
                                             std::string& message);

/// Waits until the names in the folder of `path` are on the disk. Errors: kIo, and why.
[[nodiscard]] core::Result<void> sync_folder_of(const std::string& path, std::string& message);

/// The text of a small file of at most 64 KiB. Errors: kIo, and why; kInvalidArgument there is
/// none.
[[nodiscard]] core::Result<std::string> read_small_file(const std::string& path,
                                                        std::string& message);

}  // namespace tubesight::drivers
