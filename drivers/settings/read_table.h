#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"

namespace tubesight::drivers {

/// Reads one table by `reading(TableReader&)` where it stands; a needed one that is missing is a
/// mistake. Says whether it was there and without mistakes.
template <typename Reading>
bool read_table(SettingsDocument& document, std::string_view name, bool needed, Reading reading) {
  const SettingsTable* const table = document.find(name);
  if (table == nullptr) {
    if (needed && document.complete()) {
      document.problems().push_back({{},
                                     std::string(name) + ": the table is missing, expected [" +
                                         std::string(name) + "] here or in an included file"});
    }
    return false;
  }
  if (!table->node->is_table()) {
    document.problems().push_back(
        {table->place,
         std::string(name) + ": a list of tables, expected [" + std::string(name) + "] once"});
    return false;
  }
  const std::size_t before = document.problems().size();
  TableReader reader(*table->node->as_table(), table->place, std::string(name),
                     document.problems());
  reading(reader);
  reader.finish();
  return document.problems().size() == before;
}

/// Reads each of a list of tables `[[name]]` by `reading(TableReader&, number)`; there may be none.
/// In messages the first is `name[0]`. Says whether there were no mistakes.
template <typename Reading>
bool read_each_table(SettingsDocument& document, std::string_view name, Reading reading) {
  const SettingsTable* const list = document.find(name);
  if (list == nullptr) {
    return true;
  }
  const toml::array* const tables = list->node->as_array();
  if (tables == nullptr) {
    document.problems().push_back(
        {list->place,
         std::string(name) + ": one table, expected a list of [[" + std::string(name) + "]]"});
    return false;
  }
  const std::size_t before = document.problems().size();
  for (std::size_t i = 0; i < tables->size(); ++i) {
    const toml::node& node = (*tables)[i];
    const auto line = static_cast<std::int64_t>(node.source().begin.line);
    TableReader reader(*node.as_table(), {list->place.file, line > 0 ? line : list->place.line},
                       std::string(name) + "[" + std::to_string(i) + "]", document.problems());
    reading(reader, i);
    reader.finish();
  }
  return document.problems().size() == before;
}

}  // namespace tubesight::drivers
