#include "board/visionbox/journal_settings.h"

#include <filesystem>

#include "board/visionbox/settings_path.h"

namespace tubesight::board {
namespace {

constexpr drivers::WholeRange kPictures{0, 1'000'000};

bool is_folder(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::is_directory(path, unknown);
}

}  // namespace

void read_journal(const drivers::SettingsDocument& document, drivers::TableReader& table,
                  JournalSettings& journal) {
  const auto read = [&](const char* key, const std::string& told, std::string& path) {
    path = from_its_folder(document, table, key, told);
    if (told.empty() || is_folder(path)) {
      table.complain(key, "'" + told + "', expected the path of a file, there or not");
    }
  };
  std::string file;
  if (table.text("file", file)) {
    read("file", file, journal.file);
  }
  journal.key = journal.file + ".key";
  if (std::string key; table.has("key") && table.text("key", key)) {
    read("key", key, journal.key);
    if (journal.key == journal.file) {
      table.complain("key", "'" + key + "' is the journal's own file, expected another");
    }
  }
  table.optional_whole("pictures", kPictures, journal.pictures);
}

}  // namespace tubesight::board
