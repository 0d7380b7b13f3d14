#include "drivers/settings/toml_writer.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <utility>

namespace tubesight::drivers {
namespace {

char printing(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c; }

/// `[a, b, ...]`; `text_of` writes one value.
template <typename Value, typename TextOf>
std::string list_text(std::span<const Value> values, TextOf text_of) {
  std::string list;
  for (const Value& value : values) {
    list += (list.empty() ? "" : ", ") + text_of(value);
  }
  return "[" + list + "]";
}

}  // namespace

std::string toml_number(double value, TomlManner manner) {
  std::array<char, 400> text{};  // the smallest number has 325 digits behind the point
  char* const end = text.data() + text.size();
  const auto result = manner == TomlManner::kPlain
                          ? std::to_chars(text.data(), end, value, std::chars_format::fixed)
                          : std::to_chars(text.data(), end, value);
  std::string number(text.data(), result.ptr);
  // A whole number would be read as an integer, which is not what a length is.
  if (number.find_first_of(".e") == std::string::npos) {
    number += ".0";
  }
  return number;
}

std::string toml_comment(std::string_view text) {
  std::string comment = "# ";
  for (const char c : text) {
    comment += printing(c);
  }
  return comment + "\n";
}

void TomlWriter::table(std::string_view name) {
  text_ += (text_.empty() ? "[" : "\n[") + std::string(name) + "]\n";
}

void TomlWriter::entry(std::string_view name) {
  text_ += (text_.empty() ? "[[" : "\n[[") + std::string(name) + "]]\n";
}

void TomlWriter::raw(std::string_view key, std::string_view value) {
  text_ += std::string(key) + " = " + std::string(value) + "\n";
}

void TomlWriter::text(std::string_view key, std::string_view value) {
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    quoted += printing(c);
  }
  raw(key, quoted + "\"");
}

void TomlWriter::numbers(std::string_view key, std::span<const double> values) {
  raw(key, list_text(values, [&](double value) { return toml_number(value, manner_); }));
}

void TomlWriter::wholes(std::string_view key, std::span<const std::int32_t> values) {
  raw(key, list_text(values, [](std::int32_t value) { return std::to_string(value); }));
}

void TomlWriter::addresses(std::string_view key, std::span<const core::TubeAddress> list) {
  const bool broken = manner_ == TomlManner::kShort;
  if (list.empty() && broken) {
    return;
  }
  std::string text;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) {
      text += broken && i % 10 == 0 ? ",\n  " : ", ";
    }
    text += "[" + std::to_string(list[i].row) + ", " + std::to_string(list[i].column) + "]";
  }
  raw(key, "[" + text + "]");
}

void TomlWriter::inline_tables(std::string_view key, std::span<const std::string> tables) {
  raw(key, list_text(tables, [](const std::string& table) { return table; }));
}

std::string TomlWriter::take() { return std::exchange(text_, {}); }

std::string TomlWriter::take_inline() {
  std::string text = "{ ";
  for (const char c : take()) {
    text += c == '\n' ? std::string(", ") : std::string(1, c);
  }
  text.resize(text.size() - 2);  // the last comma
  return text + " }";
}

}  // namespace tubesight::drivers
