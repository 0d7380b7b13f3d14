#pragma once

#include <optional>
#include <string>

#include "tests/core/overlay/scenes.h"

namespace tubesight::tests {

/// Reads a PNG as eight-bit RGB; empty, with one line on standard error, where that fails.
[[nodiscard]] std::optional<Picture> read_png(const std::string& path);

/// Writes a picture; false, with one line on standard error, where that fails.
[[nodiscard]] bool write_png(const std::string& path, const Picture& picture);

}  // namespace tubesight::tests
