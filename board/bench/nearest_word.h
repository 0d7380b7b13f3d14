#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace tubesight::board {

/// How many letters must be put in, left out, changed, or swapped with their neighbour to make one
/// word of another; capitals count as small letters.
[[nodiscard]] std::size_t spelling_distance(std::string_view a, std::string_view b);

/// The one of `words` that was probably meant: the nearest, when a third of its letters at most are
/// wrong, or the only one that begins so. Empty when none is.
[[nodiscard]] std::string nearest_word(std::string_view word, std::span<const std::string> words);

}  // namespace tubesight::board
