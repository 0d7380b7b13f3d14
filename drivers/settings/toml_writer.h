#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/tube_address.h"

namespace tubesight::drivers {

/// A number in the shortest form that reads back exactly.
[[nodiscard]] std::string toml_number(double value);
[[nodiscard]] std::string toml_number(std::int64_t value);
[[nodiscard]] inline std::string toml_number(std::int32_t value) {
  return toml_number(std::int64_t{value});
}

/// Writes settings files key by key.
class TomlWriter {
 public:
  void table(std::string_view name) { text_ += "\n[" + std::string(name) + "]\n"; }
  /// One table of an array of tables.
  void entry(std::string_view name) { text_ += "\n[[" + std::string(name) + "]]\n"; }

  void raw(std::string_view key, const std::string& value) {
    text_ += std::string(key) + " = " + value + "\n";
  }
  /// `value` holds no quotes, backslashes or control characters.
  void text(std::string_view key, const char* value) { raw(key, '"' + std::string(value) + '"'); }
  void word(std::string_view key, bool value) { raw(key, value ? "true" : "false"); }
  template <typename Number>
  void number(std::string_view key, Number value) {
    raw(key, toml_number(value));
  }
  template <typename Number, std::size_t N>
  void numbers(std::string_view key, const std::array<Number, N>& values) {
    std::string list;
    for (const Number value : values) {
      list += (list.empty() ? "" : ", ") + toml_number(value);
    }
    raw(key, "[" + list + "]");
  }
  /// A list of addresses; nothing when it is empty.
  void addresses(std::string_view key, std::span<const core::TubeAddress> list);

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace tubesight::drivers
