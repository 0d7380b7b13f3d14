#include "core/lighting/lamp_pattern.h"

#include <algorithm>

#include "core/lighting/lamp_policy.h"

namespace tubesight::core::lighting {
namespace {

constexpr std::uint32_t kAll = 0x7FFF'FFFFU;

constexpr std::uint32_t next(std::uint32_t bits) {
  const std::uint32_t fed_back = ((bits >> 30) ^ (bits >> 27)) & 1U;
  return ((bits << 1) | fed_back) & kAll;
}

}  // namespace

void LampPattern::begin(std::uint32_t seed) {
  // Seeds that differ little begin at places far apart.
  register_ = (seed * 2'654'435'761U) & kAll;
  register_ = register_ == 0 ? 1 : register_;
  for (int i = 0; i < 64; ++i) {
    register_ = next(register_);
  }
  until_ = FieldTime(0);
}

std::int32_t LampPattern::sign_after(FieldTime now) {
  const FieldTime late = now - until_;
  if (late >= FieldTime(0) || late < -kChip) {
    register_ = next(register_);
    // In step with the time where fields are late, and anew after a pause or a jump of the clock.
    until_ = late >= FieldTime(0) && late < kChip ? until_ + kChip : now + kChip;
  }
  return (register_ & 1U) != 0 ? 1 : -1;
}

std::int32_t swung_permille(std::int32_t permille, std::int32_t sign, std::int32_t share_permille,
                            std::int32_t most_permille) {
  if (permille < kDimmest_permille) {
    return permille;
  }
  const std::int32_t swing = permille * share_permille / 1000;
  return std::min(permille, most_permille - swing) + (sign < 0 ? -swing : swing);
}

}  // namespace tubesight::core::lighting
