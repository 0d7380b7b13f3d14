#pragma once

#include <string>

#include "drivers/web/page_server.h"

namespace tubesight::board {

/// The box's settings file as it is: {text, path, files}, or as a download.
[[nodiscard]] drivers::PageAnswer settings_answer(const std::string& file, bool download);

/// What the box would say to this text in the file's place: {messages}. As `tubesightd --check`.
[[nodiscard]] drivers::PageAnswer check_settings(const std::string& file, const std::string& text);

/// Checks the text and, where nothing is wrong, puts it in the file's place, the one before beside
/// it as FILE.backup; the box takes it when it is started next. {messages, saved, backup, when}.
[[nodiscard]] drivers::PageAnswer save_settings(const std::string& file, const std::string& text);

}  // namespace tubesight::board
