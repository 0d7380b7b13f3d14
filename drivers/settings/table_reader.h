#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/tube_address.h"
#include "drivers/settings/settings_document.h"

namespace tubesight::drivers {

/// Inclusive limits of a number and the unit told with them.
struct NumberRange {
  double least = 0.0;
  double most = 0.0;
  const char* unit = "";  ///< " mm", say
};

/// Inclusive limits of a whole number.
struct WholeRange {
  std::int32_t least = 0;
  std::int32_t most = 0;
};

/// Reads the keys of one table; each mistake becomes a problem that names place, key and what was
/// expected, and the value is left as it was.
///
/// A key that the program does not ask for is an unknown key: call finish() last. Integers serve
/// where decimal numbers are expected.
class TableReader {
 public:
  /// `name` is the table's, as it stands before its keys in messages.
  TableReader(const toml::table& table, SettingsPlace place, std::string name,
              SettingsProblems& problems);

  /// Whether the table has the key; asking does not make it known.
  [[nodiscard]] bool has(std::string_view key) const;

  /// Read a key that must be there; false after a mistake.
  bool whole(std::string_view key, WholeRange range, std::int32_t& value);
  bool number(std::string_view key, NumberRange range, double& value);
  bool numbers(std::string_view key, NumberRange range, std::span<double> values);
  bool wholes(std::string_view key, WholeRange range, std::span<std::int32_t> values);
  bool text(std::string_view key, std::string& value);
  /// One of `words`; `index` says which.
  bool word(std::string_view key, std::span<const std::string_view> words, std::size_t& index);

  /// The same for keys that may be left out: then nothing changes and true is said.
  bool optional_whole(std::string_view key, WholeRange range, std::int32_t& value);
  bool optional_number(std::string_view key, NumberRange range, double& value);
  bool optional_numbers(std::string_view key, NumberRange range, std::span<double> values);
  bool optional_wholes(std::string_view key, WholeRange range, std::span<std::int32_t> values);
  bool optional_text(std::string_view key, std::string& value);
  bool optional_word(std::string_view key, std::span<const std::string_view> words,
                     std::size_t& index);
  bool optional_switch(std::string_view key, bool& value);  ///< true or false
  /// A list of texts, which replaces `values`.
  bool optional_texts(std::string_view key, std::vector<std::string>& values);
  /// [row, column].
  bool address(std::string_view key, core::TubeAddress& value);

  /// Accepts a key whatever it holds, or its absence.
  void ignore(std::string_view key);

  /// The list under a key as nodes; null when absent (a mistake if `needed`) or no list.
  const toml::array* list(std::string_view key, bool needed, const char* expected);

  /// Tells the keys that nobody asked for.
  void finish();

  /// Adds a problem about a key, at the key's line; `text` says what is wrong and what was
  /// expected.
  void complain(std::string_view key, const std::string& text);

  /// The same about entry `index` of the list under a key, at the entry's line.
  void complain_entry(std::string_view key, std::size_t index, const toml::node& entry,
                      const std::string& text);

  /// Whether nothing was wrong with a key that was read: it is there as it should be, or it may be
  /// left out and is.
  [[nodiscard]] bool sound(std::string_view key) const;

  /// Where a node stands.
  [[nodiscard]] SettingsPlace place_of(const toml::node& node) const;

  /// Where a key stands; the table, where it has no such key.
  [[nodiscard]] SettingsPlace place_of(std::string_view key) const;

  /// Where the table stands.
  [[nodiscard]] SettingsPlace place() const { return place_; }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] SettingsProblems& problems() { return *problems_; }

 private:
  bool absent(std::string_view key);
  const toml::node* get(std::string_view key, const std::string& expected);
  [[nodiscard]] std::string path(std::string_view key) const;

  const toml::table* table_;
  SettingsPlace place_;
  std::string name_;
  SettingsProblems* problems_;
  std::vector<std::string> known_;
  std::vector<std::string> wrong_;  ///< keys that problems were about
};

/// Two whole numbers [row, column]; false for anything else.
[[nodiscard]] bool read_address(const toml::node& node, core::TubeAddress& address);

/// What keeps a node from being an address, and what was expected; of one that read_address()
/// refuses.
[[nodiscard]] std::string why_no_address(const toml::node& node);

/// What a node is or holds, in a few words for a message: "the text 'abc'", "12.5".
[[nodiscard]] std::string describe(const toml::node& node);

}  // namespace tubesight::drivers
