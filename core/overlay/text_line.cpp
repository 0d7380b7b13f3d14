#include "core/overlay/text_line.h"

#include "core/base/assert.h"

namespace tubesight::core::overlay {
namespace {

// The magnitude of the lowest number does not fit its own type.
std::uint64_t magnitude_of(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  return value < 0 ? std::uint64_t{0} - bits : bits;
}

}  // namespace

TextLine& TextLine::words(std::string_view text) {
  for (const char character : text) {
    append(character);
  }
  return *this;
}

TextLine& TextLine::integer(std::int64_t value) {
  if (value < 0) {
    append('-');
  }
  digits(magnitude_of(value), 1);
  return *this;
}

TextLine& TextLine::decimal(std::int64_t value, std::int32_t decimals) {
  TUBESIGHT_ASSERT(decimals >= 1 && decimals <= 9);
  std::uint64_t scale = 1;
  for (std::int32_t i = 0; i < decimals; ++i) {
    scale *= 10;
  }
  const std::uint64_t magnitude = magnitude_of(value);
  if (value < 0) {
    append('-');
  }
  digits(magnitude / scale, 1);
  append('.');
  digits(magnitude % scale, decimals);
  return *this;
}

void TextLine::append(char character) {
  TUBESIGHT_ASSERT(size_ < kCapacity);
  characters_[static_cast<std::size_t>(size_)] = character;
  ++size_;
}

void TextLine::digits(std::uint64_t magnitude, std::int32_t at_least) {
  constexpr std::int32_t kMostDigits = 20;
  std::array<char, kMostDigits> reversed{};
  std::int32_t count = 0;
  while (magnitude != 0 || count < at_least) {
    reversed[static_cast<std::size_t>(count)] = static_cast<char>('0' + magnitude % 10);
    magnitude /= 10;
    ++count;
  }
  while (count > 0) {
    --count;
    append(reversed[static_cast<std::size_t>(count)]);
  }
}

}  // namespace tubesight::core::overlay
