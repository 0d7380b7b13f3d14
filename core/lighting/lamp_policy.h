#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "core/base/field.h"
#include "core/base/words.h"

namespace tubesight::core::lighting {

/// The dimmest light of which a swing of 1 permille, the least that a dimmer takes, is 1 %.
inline constexpr std::int32_t kDimmest_permille = 100;

/// What the box may do with a lamp of its own. All off: it does what it is told.
struct LampPolicy {
  bool follows_picture = false;  ///< sets the level by the picture, until somebody commands one
  bool pattern = false;          ///< swings the level and looks for it in the picture
  std::uint32_t seed = 1;        ///< of the pattern; another one at each start of a box
  std::int32_t most_permille = kFullLamp_permille;  ///< never more, kDimmest_permille or above

  friend constexpr bool operator==(const LampPolicy&, const LampPolicy&) = default;
};

template <typename Self, typename Stream>
requires std::same_as<std::remove_const_t<Self>, LampPolicy>
void transfer(Self& self, Stream& stream) {
  auto& [follows_picture, pattern, seed, most] = self;
  stream(follows_picture, pattern, seed);
  stream.number(most, kDimmest_permille, kFullLamp_permille);
}

/// How the lamp is doing, as far as the picture shows it.
enum class LampCondition : std::uint8_t {
  kUnknown,  ///< nothing shows it
  kWell,     ///< its light is seen to follow
  kWeak,     ///< its light fell though its level did not, or all it may give is too little
  kDark,     ///< it should shine, and the picture is dark
  kUnseen,   ///< the picture is bright and does not follow the lamp
};

[[nodiscard]] constexpr bool is_fault(LampCondition condition) {
  return condition == LampCondition::kWeak || condition == LampCondition::kDark ||
         condition == LampCondition::kUnseen;
}

/// The word of a condition, and a few for a person; empty: nothing to say.
[[nodiscard]] constexpr Words words_of(LampCondition condition) {
  switch (condition) {
    case LampCondition::kUnknown: return {"unknown", ""};
    case LampCondition::kWell: return {"well", "the picture follows it"};
    case LampCondition::kWeak: return {"weak", "it gives too little light"};
    case LampCondition::kDark: return {"dark", "it should shine, and the picture is dark"};
    case LampCondition::kUnseen: return {"unseen", "the picture does not follow it"};
  }
  return {};
}

}  // namespace tubesight::core::lighting
