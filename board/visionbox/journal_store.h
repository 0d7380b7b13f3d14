#pragma once

#include <memory>
#include <string>

#include "board/visionbox/journal_settings.h"
#include "board/visionbox/journal_writer.h"

namespace tubesight::board {

/// What a journal's writer needs of the drivers: SQLite's file, the pictures, the digests.
[[nodiscard]] JournalWriter::Parts make_journal_parts(const JournalSettings& settings);

/// SHA-256 of a settings file's bytes as 64 hexadecimal digits, without what it includes; empty: it
/// cannot be read.
[[nodiscard]] std::string settings_digest(const std::string& file);

}  // namespace tubesight::board
