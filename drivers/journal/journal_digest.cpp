#include "drivers/journal/journal_digest.h"

#include <array>

#include <openssl/evp.h>

namespace tubesight::drivers {
namespace {

constexpr std::string_view kDigits = "0123456789abcdef";

std::string digest_of(const void* bytes, std::size_t size) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(bytes, size, digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    return {};
  }
  return to_hex(std::span(digest).first(length));
}

}  // namespace

std::string sha256_hex(std::span<const std::byte> bytes) {
  return digest_of(bytes.data(), bytes.size());
}

std::string sha256_hex(std::string_view text) { return digest_of(text.data(), text.size()); }

std::string to_hex(std::span<const unsigned char> bytes) {
  std::string text;
  text.reserve(bytes.size() * 2);
  for (const unsigned char byte : bytes) {
    text += kDigits[byte / 16U];
    text += kDigits[byte % 16U];
  }
  return text;
}

std::optional<std::vector<unsigned char>> from_hex(std::string_view text) {
  if (text.size() % 2 != 0) {
    return std::nullopt;
  }
  std::vector<unsigned char> bytes;
  for (std::size_t i = 0; i < text.size(); i += 2) {
    const std::size_t high = kDigits.find(text[i]);
    const std::size_t low = kDigits.find(text[i + 1]);
    if (high == std::string_view::npos || low == std::string_view::npos) {
      return std::nullopt;
    }
    bytes.push_back(static_cast<unsigned char>(high * 16 + low));
  }
  return bytes;
}

}  // namespace tubesight::drivers
