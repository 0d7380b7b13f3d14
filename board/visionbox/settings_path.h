#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::board {

/// A path of a settings file, from the folder of the file that names it under `key`.
[[nodiscard]] inline std::string from_its_folder(const drivers::SettingsDocument& document,
                                                 const drivers::TableReader& table,
                                                 std::string_view key, const std::string& path) {
  const auto file = static_cast<std::size_t>(table.place_of(key).file);
  return (std::filesystem::path(document.files()[file]).parent_path() / path).string();
}

}  // namespace tubesight::board
