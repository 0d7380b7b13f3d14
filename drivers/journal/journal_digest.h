#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tubesight::drivers {

/// SHA-256 as 64 lower-case hexadecimal digits; empty where the library has no memory left.
[[nodiscard]] std::string sha256_hex(std::span<const std::byte> bytes);
[[nodiscard]] std::string sha256_hex(std::string_view text);

/// Bytes as lower-case hexadecimal digits.
[[nodiscard]] std::string to_hex(std::span<const unsigned char> bytes);

/// The bytes of such a text; empty where it is none.
[[nodiscard]] std::optional<std::vector<unsigned char>> from_hex(std::string_view text);

}  // namespace tubesight::drivers
