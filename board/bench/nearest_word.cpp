#include "board/bench/nearest_word.h"

#include <algorithm>
#include <vector>

#include "drivers/files/small_letters.h"

namespace tubesight::board {

std::size_t spelling_distance(std::string_view a, std::string_view b) {
  const std::string from = drivers::small_letters(a);
  const std::string to = drivers::small_letters(b);
  // Row i: the distances of the first i letters of `from` from each beginning of `to`.
  std::vector<std::size_t> two_before(to.size() + 1);
  std::vector<std::size_t> before(to.size() + 1);
  std::vector<std::size_t> row(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= from.size(); ++i) {
    two_before.swap(before);
    before.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t changed = before[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({before[j] + 1, row[j - 1] + 1, changed});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
        row[j] = std::min(row[j], two_before[j - 2] + 1);
      }
    }
  }
  return row[to.size()];
}

std::string nearest_word(std::string_view word, std::span<const std::string> words) {
  constexpr std::size_t kFewestLetters = 3;  // of a beginning
  std::string nearest;
  std::string begun;
  std::size_t least = 0;
  std::size_t beginnings = 0;
  for (const std::string& candidate : words) {
    const std::size_t distance = spelling_distance(word, candidate);
    if (3 * distance <= std::max(word.size(), candidate.size()) &&
        (nearest.empty() || distance < least)) {
      nearest = candidate;
      least = distance;
    }
    if (word.size() >= kFewestLetters &&
        drivers::small_letters(candidate).starts_with(drivers::small_letters(word))) {
      begun = candidate;
      ++beginnings;
    }
  }
  return nearest.empty() && beginnings == 1 ? begun : nearest;
}

}  // namespace tubesight::board
