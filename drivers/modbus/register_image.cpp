#include "drivers/modbus/register_image.h"

#include "core/base/assert.h"

namespace tubesight::drivers {

std::size_t RegisterImage::index(std::int32_t address) {
  TUBESIGHT_ASSERT(address >= 0 && address < kMapWords);
  return static_cast<std::size_t>(address);
}

void RegisterImage::set(Register name, std::int64_t value) {
  const RegisterRow& row = row_of(name);
  const auto bits = static_cast<std::uint64_t>(value);
  const auto low = static_cast<std::uint16_t>(bits & 0xFFFFU);
  if (row.width == 1) {
    set_word(row.address, low);
    return;
  }
  const auto high = static_cast<std::uint16_t>((bits >> 16U) & 0xFFFFU);
  const bool high_first = order_ == WordOrder::kHighFirst;
  set_word(row.address, high_first ? high : low);
  set_word(row.address + 1, high_first ? low : high);
}

bool RegisterImage::set_scaled(Register name, std::int64_t value, std::int64_t per_unit) {
  const RegisterRow& row = row_of(name);
  // What a product of the two would not hold is far from what two words hold.
  constexpr std::int64_t kMost = INT64_MAX / 2 / 100'000;
  const bool one_word = row.width == 1;
  const std::int64_t highest = one_word ? kUnknownWord - 1 : INT32_MAX;
  const std::int64_t lowest = one_word ? 0 : std::int64_t{kUnknown} + 1;
  if (value <= kMost && value >= -kMost) {
    const std::int64_t product = value * row.per_unit;
    const std::int64_t half = product < 0 ? -(per_unit / 2) : per_unit / 2;
    const std::int64_t rounded = (product + half) / per_unit;
    if (rounded >= lowest && rounded <= highest) {
      set(name, rounded);
      return true;
    }
  }
  set_unknown(name);
  return false;
}

void RegisterImage::set_unknown(Register name) {
  set(name, row_of(name).width == 1 ? kUnknownWord : kUnknown);
}

std::int32_t RegisterImage::get(Register name) const {
  const RegisterRow& row = row_of(name);
  const std::uint32_t first = word(row.address);
  if (row.width == 1) {
    return static_cast<std::int32_t>(first);
  }
  const std::uint32_t second = word(row.address + 1);
  const bool high_first = order_ == WordOrder::kHighFirst;
  return static_cast<std::int32_t>(high_first ? first << 16U | second : second << 16U | first);
}

}  // namespace tubesight::drivers
