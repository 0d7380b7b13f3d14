#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace tubesight::drivers {

/// A box's Ed25519 key (RFC 8032), by which it signs its journal.
///
/// Copied nowhere: the private part stays in its file, readable by its owner alone, and in memory.
class SigningKey {
 public:
  SigningKey() = default;
  SigningKey(const SigningKey&) = delete;
  SigningKey& operator=(const SigningKey&) = delete;
  ~SigningKey();

  /// Reads the key, or makes one where there is no file: PKCS #8 as PEM, mode 0600; and beside it
  /// `path`.pub, the public key as PEM, which is made where it is not there. `message` says why it
  /// failed, in one line.
  ///
  /// Errors: kIo it cannot be read or made, kDataLoss what stands there is no Ed25519 key,
  /// kInvalidArgument others than its owner may read it.
  [[nodiscard]] core::Result<void> load_or_make(const std::string& path, std::string& message);

  [[nodiscard]] bool is_loaded() const { return key_ != nullptr; }

  /// The public key's 32 bytes, as 64 hexadecimal digits; empty before it is loaded.
  [[nodiscard]] const std::string& public_hex() const { return public_hex_; }

  /// The signature's 64 bytes as hexadecimal digits; empty where it cannot be made.
  [[nodiscard]] std::string sign(std::string_view text) const;

 private:
  void* key_ = nullptr;  ///< EVP_PKEY, whose header stays in the source
  std::string public_hex_;
};

/// Whether that key, in hexadecimal digits, has signed the text.
[[nodiscard]] bool is_signed_by(std::string_view public_hex, std::string_view text,
                                std::string_view signature_hex);

/// The public key in a file: PEM, or 64 hexadecimal digits. Empty, and why, where it is none.
[[nodiscard]] std::optional<std::string> read_public_key(const std::string& path,
                                                         std::string& message);

}  // namespace tubesight::drivers
