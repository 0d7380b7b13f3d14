#pragma once

#include <cstdint>
#include <string_view>

#include "board/bench/campaign/random_source.h"

namespace tubesight::board::campaign {

/// Random numbers of a kind of drawing that came later: seeded by the move and the kind's name, so
/// that what was drawn before it came stays as it was.
[[nodiscard]] inline RandomSource random_stream(std::uint64_t seed, std::int64_t move,
                                                std::string_view kind, std::uint64_t attempt = 0) {
  std::uint64_t topic = 14695981039346656037ULL;  // FNV-1a
  for (const char letter : kind) {
    topic = (topic ^ static_cast<std::uint8_t>(letter)) * 1099511628211ULL;
  }
  return {seed, move, topic + attempt};
}

}  // namespace tubesight::board::campaign
