#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/tube_address.h"

namespace tubesight::drivers {

/// How numbers and lists are written; both read back exactly.
enum class TomlManner : std::uint8_t {
  kShort,  ///< numbers in their shortest form; empty lists left out, long ones broken after ten
  kPlain,  ///< numbers without exponents; every list there, in one line
};

/// A number that reads back as the same one. A whole one keeps a point: it is no integer.
[[nodiscard]] std::string toml_number(double value, TomlManner manner = TomlManner::kShort);

/// A comment of one line, with its line feed.
[[nodiscard]] std::string toml_comment(std::string_view text);

/// Writes settings files key by key.
class TomlWriter {
 public:
  explicit TomlWriter(TomlManner manner = TomlManner::kShort) : manner_(manner) {}

  /// `[name]`, with an empty line before it but at the file's beginning.
  void table(std::string_view name);
  /// `[[name]]`: one table of an array of tables.
  void entry(std::string_view name);

  void raw(std::string_view key, std::string_view value);
  /// In quotation marks; what is no printing character becomes a blank.
  void text(std::string_view key, std::string_view value);
  void truth(std::string_view key, bool value) { raw(key, value ? "true" : "false"); }
  void number(std::string_view key, double value) { raw(key, toml_number(value, manner_)); }
  void whole(std::string_view key, std::int64_t value) { raw(key, std::to_string(value)); }
  void numbers(std::string_view key, std::span<const double> values);
  void wholes(std::string_view key, std::span<const std::int32_t> values);
  /// `[[row, column], ...]`
  void addresses(std::string_view key, std::span<const core::TubeAddress> list);
  /// A list of inline tables, each as take_inline() gave it.
  void inline_tables(std::string_view key, std::span<const std::string> tables);

  [[nodiscard]] TomlManner manner() const { return manner_; }

  /// What was written, as a file's text.
  [[nodiscard]] std::string take();
  /// The keys alone, as an inline table: `{ key = value, key = value }`.
  [[nodiscard]] std::string take_inline();

 private:
  TomlManner manner_;
  std::string text_;
};

}  // namespace tubesight::drivers
