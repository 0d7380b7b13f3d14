#include "tests/drivers/aravis/fake_gige_camera.h"

namespace tubesight::tests {
namespace {

void put_bit(std::byte* to, std::size_t bit, bool set) {
  const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
  to[bit / 8] = set ? to[bit / 8] | mask : to[bit / 8] & ~mask;
}

/// Bit by bit, the lowest first: formats ending in p.
void lay_run(std::size_t bits, std::span<const std::uint8_t> greys, std::byte* to) {
  for (std::size_t i = 0; i < greys.size(); ++i) {
    const unsigned value = static_cast<unsigned>(greys[i]) << (bits - 8) | (i % 2 == 0 ? 3U : 1U);
    for (std::size_t bit = 0; bit < bits; ++bit) {
      put_bit(to, i * bits + bit, (value >> bit & 1U) != 0);
    }
  }
}

}  // namespace

std::size_t line_bytes(const std::string& format, std::int32_t width_px) {
  const auto width = static_cast<std::size_t>(width_px);
  if (format == "Mono8") {
    return width;
  }
  if (format == "Mono10p") {
    return width * 10 / 8;
  }
  return format == "Mono10" || format == "Mono12" ? 2 * width : width * 3 / 2;
}

std::uint32_t code_of(const std::string& format) {
  const std::map<std::string, std::uint32_t> codes{
      {"Mono8", 0x01080001},  {"Mono10", 0x01100003},       {"Mono10Packed", 0x010C0004},
      {"Mono12", 0x01100005}, {"Mono12Packed", 0x010C0006}, {"Mono10p", 0x010A0046},
      {"Mono12p", 0x010C0047}};
  const auto found = codes.find(format);
  return found == codes.end() ? 0 : found->second;
}

void lay_line(const std::string& format, std::span<const std::uint8_t> greys, std::byte* to) {
  if (format == "Mono10p" || format == "Mono12p") {
    lay_run(format == "Mono10p" ? 10 : 12, greys, to);
    return;
  }
  for (std::size_t i = 0; i < greys.size(); ++i) {
    const unsigned grey = greys[i];
    if (format == "Mono8") {
      to[i] = static_cast<std::byte>(grey);
    } else if (format == "Mono10" || format == "Mono12") {
      const unsigned value = format == "Mono10" ? grey << 2 | 1U : grey << 4 | 9U;
      to[2 * i] = static_cast<std::byte>(value & 0xffU);
      to[2 * i + 1] = static_cast<std::byte>(value >> 8);
    } else {
      to[i / 2 * 3 + (i % 2 == 0 ? 0 : 2)] = static_cast<std::byte>(grey);
      to[i / 2 * 3 + 1] = std::byte{0x21};
    }
  }
}

}  // namespace tubesight::tests
