#include "drivers/settings/toml_writer.h"

#include <charconv>

namespace tubesight::drivers {

std::string toml_number(double value) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  std::string number(text.data(), end);
  // A whole number would be read as an integer, which is not what a length is.
  if (number.find_first_of(".e") == std::string::npos) {
    number += ".0";
  }
  return number;
}

std::string toml_number(std::int64_t value) { return std::to_string(value); }

void TomlWriter::addresses(std::string_view key, std::span<const core::TubeAddress> list) {
  if (list.empty()) {
    return;
  }
  std::string text;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) {
      text += i % 10 == 0 ? ",\n  " : ", ";
    }
    text += "[" + std::to_string(list[i].row) + ", " + std::to_string(list[i].column) + "]";
  }
  raw(key, "[" + text + "]");
}

}  // namespace tubesight::drivers
