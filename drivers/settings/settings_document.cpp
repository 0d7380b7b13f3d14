#include "drivers/settings/settings_document.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "drivers/files/csv_reader.h"

namespace tubesight::drivers {
namespace {

constexpr std::size_t kMostFiles = 64;
constexpr std::size_t kMostMessages = 50;
constexpr std::int64_t kFormat = 1;

std::int64_t line_of(const toml::node& node) {
  return std::max<std::int64_t>(1, node.source().begin.line);
}

/// Line of the first control character that TOML forbids, or 0; said here, as toml++ repeats the
/// character in its message.
std::int64_t line_of_control_character(std::string_view text) {
  std::int64_t line = 1;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n') {
      ++line;
    } else if ((byte < 0x20 && c != '\t' && c != '\r') || byte == 0x7F) {
      return line;
    }
  }
  return 0;
}

/// toml++ repeats what it saw, line feeds too; a message is one line.
std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    line += c == '\n' ? "\\n" : c == '\r' ? "\\r" : std::string(1, c);
  }
  return line;
}

std::string list_words(std::span<const std::string_view> words) {
  std::string list;
  for (const std::string_view word : words) {
    list += (list.empty() ? "" : ", ") + std::string(word);
  }
  return list;
}

}  // namespace

void SettingsDocument::load(TextFiles& files, const std::string& path,
                            std::span<const std::string_view> known) {
  files_ = &files;
  known_ = known;
  load_file(path, {});
}

const SettingsTable* SettingsDocument::find(std::string_view name) const {
  const auto found = tables_.find(name);
  return found == tables_.end() ? nullptr : &found->second;
}

core::Result<void> SettingsDocument::report(Messages& messages) {
  std::stable_sort(
      problems_.begin(), problems_.end(), [](const SettingsProblem& a, const SettingsProblem& b) {
        return std::pair(a.place.file, a.place.line) < std::pair(b.place.file, b.place.line);
      });
  for (std::size_t i = 0; i < problems_.size(); ++i) {
    if (i == kMostMessages) {
      messages.push_back(names_.front() + ": and " + std::to_string(problems_.size() - i) +
                         " more mistakes");
      break;
    }
    const SettingsProblem& problem = problems_[i];
    const std::int64_t line = problem.place.line;
    messages.push_back(names_[static_cast<std::size_t>(problem.place.file)] +
                       (line > 0 ? ":" + std::to_string(line) : "") + ": " + problem.text);
  }
  return problems_.empty() ? core::Result<void>() : core::Unexpected(core::Error::kInvalidArgument);
}

/// Reads one file and, where it says so, others. `from` is the place of the include, or for the
/// first file nothing.
void SettingsDocument::load_file(const std::string& path, SettingsPlace from) {
  const std::string normal = std::filesystem::path(path).lexically_normal().string();
  if (std::find(including_.begin(), including_.end(), normal) != including_.end()) {
    complain(from, "include: " + in_quotes(path) + " includes itself, expected no circle");
    return;
  }
  if (names_.size() == kMostFiles) {
    complain(from, "include: more than 64 files, expected fewer");
    complete_ = false;
    return;
  }
  std::string text;
  std::string why;
  if (!files_->read(path, text, why)) {
    if (names_.empty()) {
      names_.push_back(path);
    }
    if (including_.empty()) {
      complain({0, 0}, "cannot be read: " + why);  // it has no line
    } else {
      complain(from, "include: " + in_quotes(path) + " cannot be read: " + why);
    }
    complete_ = false;
    return;
  }
  const SettingsPlace start{static_cast<std::int32_t>(names_.size()), 1};
  names_.push_back(path);
  if (const std::int64_t line = line_of_control_character(text); line != 0) {
    complain({start.file, line}, "not TOML: a control character, expected text");
    complete_ = false;
    return;
  }
  toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    const auto& error = parsed.error();
    complain({start.file, std::max<std::int64_t>(1, error.source().begin.line)},
             "not TOML: " + one_line(error.description()));
    complete_ = false;
    return;
  }
  parsed_.push_back(std::move(parsed).table());
  including_.push_back(normal);
  for (const auto& [key, node] : parsed_.back()) {
    const SettingsPlace place{start.file, std::max<std::int64_t>(1, key.source().begin.line)};
    if (key.str() == "format") {
      take_format(node, place);
    } else if (key.str() == "include") {
      take_includes(node, place, path);
    } else {
      take_table(key.str(), node, place);
    }
  }
  including_.pop_back();
}

void SettingsDocument::take_format(const toml::node& node, SettingsPlace place) {
  const auto* const value = node.as_integer();
  if (value == nullptr) {
    complain(place, "format: not an integer, expected 1");
  } else if (value->get() != kFormat) {
    complain(place, "format: " + std::to_string(value->get()) + ", expected 1");
  }
}

void SettingsDocument::take_includes(const toml::node& node, SettingsPlace place,
                                     const std::string& path) {
  const auto* const list = node.as_array();
  if (list == nullptr) {
    complain(place, "include: not a list, expected [\"file.toml\", ...]");
    complete_ = false;
    return;
  }
  for (const toml::node& entry : *list) {
    const SettingsPlace at{place.file, line_of(entry)};
    const auto* const name = entry.as_string();
    if (name == nullptr || name->get().empty()) {
      complain(at, "include: not a file's name, expected [\"file.toml\", ...]");
      complete_ = false;
      continue;
    }
    load_file((std::filesystem::path(path).parent_path() / name->get()).string(), at);
  }
}

void SettingsDocument::take_table(std::string_view name, const toml::node& node,
                                  SettingsPlace place) {
  const bool known = std::find(known_.begin(), known_.end(), name) != known_.end();
  if (!node.is_table() && !node.is_array_of_tables()) {
    complain(place,
             std::string(name) + (known ? ": not a table, expected [" + std::string(name) + "]"
                                        : ": unknown key, expected format, include "
                                          "or a table"));
    return;
  }
  if (!known) {
    complain(place,
             "[" + printable(name) + "]: unknown table, expected one of " + list_words(known_));
    return;
  }
  const auto [entry, is_new] = tables_.try_emplace(std::string(name), SettingsTable{&node, place});
  if (!is_new) {
    const SettingsPlace other = entry->second.place;
    complain(place, "[" + std::string(name) + "]: the table is already in " +
                        names_[static_cast<std::size_t>(other.file)] + ":" +
                        std::to_string(other.line) + ", expected it once");
  }
}

void SettingsDocument::complain(SettingsPlace place, std::string text) {
  problems_.push_back({place, std::move(text)});
}

}  // namespace tubesight::drivers
