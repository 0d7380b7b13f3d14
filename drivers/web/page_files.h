#pragma once

#include <optional>
#include <string_view>

namespace tubesight::drivers {

/// A file of the page, as the program has it in it.
struct PageFile {
  std::string_view type;  ///< Content-Type
  std::string_view bytes;
};

/// The file at a path of the site, "/" for the page itself; empty: there is none. Names are looked
/// up in a list and never lead to a disk.
[[nodiscard]] std::optional<PageFile> page_file(std::string_view path);

}  // namespace tubesight::drivers
