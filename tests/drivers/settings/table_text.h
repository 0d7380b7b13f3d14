#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tubesight::drivers {

// Settings' texts taken apart, for tests that walk every key of a format.

/// A key of a settings' text and the table it is in: the name of a `[name]` or `[[name]]`, and
/// which of that name it is.
struct TextKey {
  std::string table;
  std::string key;
  std::size_t first = 0;  ///< its line or lines in the text
  std::size_t size = 0;
};

/// The keys of a text in which no line but a key's begins with a letter.
[[nodiscard]] inline std::vector<TextKey> keys_of(const std::string& text) {
  std::vector<TextKey> keys;
  std::string table;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string_view line = std::string_view(text).substr(at, end - at);
    if (line.starts_with('[')) {
      const std::size_t first = line.find_first_not_of('[');
      table = line.substr(first, line.find(']') - first);
    } else if (line.starts_with(' ')) {
      keys.back().size += line.size();
    } else if (const std::size_t equals = line.find(" = "); equals != std::string_view::npos) {
      keys.push_back({table, std::string(line.substr(0, equals)), at, line.size()});
    }
    at = end;
  }
  return keys;
}

/// The text without one of its keys.
[[nodiscard]] inline std::string without(const std::string& text, const TextKey& key) {
  return text.substr(0, key.first) + text.substr(key.first + key.size);
}

/// The text with a key that no table has, `unheard_of`, in one of its tables; for each of them.
[[nodiscard]] inline std::vector<std::string> with_an_unknown_key(const std::string& text) {
  std::vector<std::string> texts;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
    if (text[begin] == '[') {
      const std::size_t end = text.find('\n', begin) + 1;
      texts.push_back(text.substr(0, end) + "unheard_of = 1\n" + text.substr(end));
    }
  }
  return texts;
}

/// What a message lists as expected: "...: unknown key, expected one of a, b" or the same of
/// tables; nothing of other messages.
[[nodiscard]] inline std::vector<std::string> expected_words(std::string_view message) {
  constexpr std::string_view kBefore = ", expected one of ";
  std::vector<std::string> words;
  const std::size_t at = message.find(kBefore);
  if (at == std::string_view::npos || message.find(": unknown ") == std::string_view::npos) {
    return words;
  }
  std::string rest(message.substr(at + kBefore.size()));
  for (std::size_t comma = rest.find(", "); comma != std::string::npos; comma = rest.find(", ")) {
    words.push_back(rest.substr(0, comma));
    rest.erase(0, comma + 2);
  }
  words.push_back(rest);
  return words;
}

/// Of all that a reader says of the texts with_an_unknown_key(): the keys that it knows and the
/// text has not, as "table.key"; and "table: no message" for a table of which it said nothing.
[[nodiscard]] inline std::set<std::string> surplus_of(const std::vector<std::string>& messages,
                                                      const std::string& text) {
  std::map<std::string, bool> told;  // the tables of the text
  std::set<std::string> written;
  for (const TextKey& key : keys_of(text)) {
    told[key.table] = false;
    written.insert(key.table + "." + key.key);
  }
  told.erase("");  // before the first table
  std::set<std::string> surplus;
  for (const std::string& message : messages) {
    // "s.toml:12: camera.unheard_of: ..." or "s.toml:12: fault[3].unheard_of: ..."
    const std::size_t first = message.find(": ") + 2;
    const std::string table = message.substr(first, message.find_first_of(".[", first) - first);
    for (const std::string& key : expected_words(message)) {
      told[table] = true;
      if (!written.contains(table + "." + key)) {
        surplus.insert(table + "." + key);
      }
    }
  }
  for (const auto& [table, heard] : told) {
    if (!heard) {
      surplus.insert(table + ": no message");
    }
  }
  return surplus;
}

}  // namespace tubesight::drivers
