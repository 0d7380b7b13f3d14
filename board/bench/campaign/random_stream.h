#pragma once

#include <cstdint>
#include <string_view>

#include "board/bench/campaign/random_source.h"
#include "core/base/fnv1a.h"

namespace tubesight::board::campaign {

/// Random numbers of a kind of drawing that came later: seeded by the move and the kind's name, so
/// that what was drawn before it came stays as it was.
[[nodiscard]] inline RandomSource random_stream(std::uint64_t seed, std::int64_t move,
                                                std::string_view kind, std::uint64_t attempt = 0) {
  core::Fnv1a topic;
  topic.add(kind);
  return {seed, move, topic.value() + attempt};
}

}  // namespace tubesight::board::campaign
