#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace tubesight::drivers {

/// A text with the letters A to Z made small, whatever the locale; all other bytes as they are.
[[nodiscard]] inline std::string small_letters(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return small;
}

}  // namespace tubesight::drivers
