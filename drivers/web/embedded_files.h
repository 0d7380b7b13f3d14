#pragma once

#include <span>
#include <string_view>

namespace tubesight::drivers {

/// A file that the build put into the program (embed.cmake).
struct EmbeddedFile {
  std::string_view name;
  std::string_view bytes;
};

[[nodiscard]] std::span<const EmbeddedFile> embedded_files();

}  // namespace tubesight::drivers
