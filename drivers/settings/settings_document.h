#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "drivers/files/messages.h"
#include "drivers/settings/settings_problems.h"
#include "drivers/settings/text_files.h"
#include "drivers/settings/tomlplusplus.h"

namespace tubesight::drivers {

/// A table (or an array of tables) and where it stands.
struct SettingsTable {
  const toml::node* node = nullptr;
  SettingsPlace place;
};

/// A settings file with all that it includes, merged table by table.
///
/// Takes care of what all settings files share: `format`, `include`, unknown and repeated tables,
/// TOML's own syntax. What is inside the tables is read through TableReader.
class SettingsDocument {
 public:
  /// Reads `path` and its includes. `known` lists the tables that may appear. Mistakes are added to
  /// problems(); those of one file never hide those of another.
  void load(TextFiles& files, const std::string& path, std::span<const std::string_view> known);

  /// The table of that name, or null when no file has it.
  [[nodiscard]] const SettingsTable* find(std::string_view name) const;

  /// Whether all files that were to be included could be read and are TOML, so that a table not
  /// found is a table missing.
  [[nodiscard]] bool complete() const { return complete_; }

  /// The files opened, in that order.
  [[nodiscard]] const std::vector<std::string>& files() const { return names_; }

  /// All mistakes so far; readers of tables add theirs.
  [[nodiscard]] SettingsProblems& problems() { return problems_; }

  /// Adds the mistakes to `messages`, in the order of files and lines (the first 50, and how many
  /// more there are). Errors: kInvalidArgument when there is one.
  [[nodiscard]] core::Result<void> report(Messages& messages);

 private:
  void load_file(const std::string& path, SettingsPlace from);
  void take_format(const toml::node& node, SettingsPlace place);
  void take_includes(const toml::node& node, SettingsPlace place, const std::string& path);
  void take_table(std::string_view name, const toml::node& node, SettingsPlace place);
  void complain(SettingsPlace place, std::string text);

  TextFiles* files_ = nullptr;
  std::span<const std::string_view> known_;
  std::vector<std::string> names_;      ///< of the files, as told in messages
  std::vector<std::string> including_;  ///< normalised paths from the root to the current file
  std::deque<toml::table> parsed_;      ///< keeps what the tables point to
  std::map<std::string, SettingsTable, std::less<>> tables_;
  SettingsProblems problems_;
  bool complete_ = true;
};

}  // namespace tubesight::drivers
