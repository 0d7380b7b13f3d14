#include "drivers/control/json_line.h"

#include <array>
#include <charconv>
#include <cstddef>

namespace tubesight::drivers {
namespace {

constexpr std::string_view kDigits = "0123456789abcdef";

/// What stands behind `"key":`; empty where the line has no such member.
std::string_view behind(std::string_view line, std::string_view key) {
  const std::string name = json_string(key) + ':';
  const std::size_t found = line.find(name);
  return found == std::string_view::npos ? std::string_view() : line.substr(found + name.size());
}

/// The byte that the four digits behind \u stand for; anything that is no ASCII as '?'.
char from_digits(std::string_view digits) {
  unsigned code = 0;
  const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
  return parsed.ec == std::errc() && code < 128 ? static_cast<char>(code) : '?';
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      result += "\\u00";
      result += kDigits[byte >> 4U];
      result += kDigits[byte & 15U];
    } else {
      result += c;
    }
  }
  return result + '"';
}

void JsonLine::name(std::string_view key) {
  if (text_.back() != '{') {
    text_ += ',';
  }
  text_ += json_string(key) + ':';
}

JsonLine& JsonLine::add(std::string_view key, std::string_view text) {
  return add_printed(key, json_string(text));
}

JsonLine& JsonLine::add(std::string_view key, std::int64_t number) {
  return add_printed(key, std::to_string(number));
}

JsonLine& JsonLine::add(std::string_view key, bool value) {
  return add_printed(key, value ? "true" : "false");
}

JsonLine& JsonLine::add_printed(std::string_view key, std::string_view value) {
  name(key);
  text_ += value;
  return *this;
}

JsonLine& JsonLine::open(std::string_view key) {
  name(key);
  text_ += '{';
  return *this;
}

JsonLine& JsonLine::close() {
  text_ += '}';
  return *this;
}

std::string find_json_string(std::string_view line, std::string_view key) {
  const std::string_view value = behind(line, key);
  std::string result;
  if (value.empty() || value.front() != '"') {
    return result;
  }
  for (std::size_t i = 1; i < value.size() && value[i] != '"'; ++i) {
    if (value[i] != '\\' || i + 1 == value.size()) {
      result += value[i];
      continue;
    }
    ++i;
    if (value[i] == 'n') {
      result += '\n';
    } else if (value[i] == 'u' && i + 4 < value.size()) {
      result += from_digits(value.substr(i + 1, 4));
      i += 4;
    } else {
      result += value[i];
    }
  }
  return result;
}

std::int64_t find_json_number(std::string_view line, std::string_view key, std::int64_t otherwise) {
  const std::string_view value = behind(line, key);
  std::int64_t number = 0;
  const auto parsed = std::from_chars(value.data(), value.data() + value.size(), number);
  return parsed.ec == std::errc() ? number : otherwise;
}

}  // namespace tubesight::drivers
