#pragma once

#include <cstdint>
#include <span>

namespace tubesight::drivers {

/// The check sum of Modbus RTU, sent low byte first: x^16 + x^15 + x^2 + 1, mirrored, from 0xFFFF.
/// Over a frame together with its own check sum it is 0. `before`: that of the bytes in front.
[[nodiscard]] constexpr std::uint16_t crc16(std::span<const std::uint8_t> bytes,
                                            std::uint16_t before = 0xFFFF) {
  constexpr std::uint32_t kPolynomial = 0xA001;
  std::uint32_t crc = before;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 1U) != 0 ? crc >> 1U ^ kPolynomial : crc >> 1U;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace tubesight::drivers
