#include "board/visionbox/journal_store.h"

#include <span>

#include "drivers/journal/journal_digest.h"
#include "drivers/journal/sqlite_journal.h"
#include "drivers/settings/text_files.h"
#include "drivers/web/jpeg_picture.h"

namespace tubesight::board {
namespace {

constexpr int kQuality = 80;

class SqliteStore final : public JournalStore {
 public:
  explicit SqliteStore(const JournalSettings& settings)
      : journal_({settings.file, settings.key, settings.pictures, {}}) {}

  core::Result<void> open(const hal::JournalRow& begin) override { return journal_.open(begin); }
  void close() override { journal_.close(); }
  hal::Journal& journal() override { return journal_; }
  std::string message() const override { return journal_.message(); }
  std::string news() const override { return journal_.news(); }
  std::string last_detail(hal::JournalKind kind) override { return journal_.last_detail(kind); }

 private:
  drivers::SqliteJournal journal_;
};

}  // namespace

JournalWriter::Parts make_journal_parts(const JournalSettings& settings) {
  return {std::make_unique<SqliteStore>(settings),
          [](const core::ImageView& grey) { return drivers::jpeg_of(grey, kQuality); },
          [](std::span<const std::byte> bytes) { return drivers::sha256_hex(bytes); }};
}

std::string settings_digest(const std::string& file) {
  drivers::DiskFiles disk;
  std::string text;
  std::string message;
  return disk.read(file, text, message) ? drivers::sha256_hex(std::string_view(text))
                                        : std::string();
}

}  // namespace tubesight::board
