#include "drivers/journal/signing_key.h"

#include <array>
#include <memory>

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <sys/stat.h>

#include "drivers/journal/journal_digest.h"
#include "drivers/journal/synced_file.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

struct Free {
  void operator()(BIO* bio) const { BIO_free(bio); }
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

constexpr std::size_t kKeyBytes = 32;
constexpr std::size_t kSignatureBytes = 64;

const unsigned char* bytes_of(std::string_view text) {
  return static_cast<const unsigned char*>(static_cast<const void*>(text.data()));
}

Owned<BIO> reader_of(const std::string& text) {
  return Owned<BIO>(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

std::string text_of(BIO* bio) {
  std::string text(BIO_ctrl_pending(bio), '\0');
  const int got = BIO_read(bio, text.data(), static_cast<int>(text.size()));
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return text;
}

std::string public_hex_of(const EVP_PKEY* key) {
  std::array<unsigned char, kKeyBytes> bytes{};
  std::size_t size = bytes.size();
  if (key == nullptr || EVP_PKEY_get_id(key) != EVP_PKEY_ED25519 ||
      EVP_PKEY_get_raw_public_key(key, bytes.data(), &size) != 1 || size != bytes.size()) {
    return {};
  }
  return to_hex(bytes);
}

std::string private_pem(EVP_PKEY* key) {
  const Owned<BIO> bio(BIO_new(BIO_s_mem()));
  const bool written =
      bio && PEM_write_bio_PrivateKey(bio.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1;
  return written ? text_of(bio.get()) : std::string();
}

std::string public_pem(EVP_PKEY* key) {
  const Owned<BIO> bio(BIO_new(BIO_s_mem()));
  return bio && PEM_write_bio_PUBKEY(bio.get(), key) == 1 ? text_of(bio.get()) : std::string();
}

Result<void> make_key(const std::string& path, std::string& message) {
  const Owned<EVP_PKEY> key(EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519"));
  const std::string pem = key ? private_pem(key.get()) : std::string();
  if (pem.empty()) {
    message = path + ": no key can be made";
    return Unexpected(Error::kIo);
  }
  return make_synced_file(path, pem, 0600, message);
}

}  // namespace

SigningKey::~SigningKey() { EVP_PKEY_free(static_cast<EVP_PKEY*>(key_)); }

Result<void> SigningKey::load_or_make(const std::string& path, std::string& message) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) {
    if (const auto made = make_key(path, message); !made) {
      return Unexpected(Error::kIo);
    }
  } else if ((found.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    message = path + ": others than its owner may use this key, expected mode 0600";
    return Unexpected(Error::kInvalidArgument);
  }
  const auto text = read_small_file(path, message);
  if (!text) {
    return Unexpected(Error::kIo);
  }
  const Owned<BIO> bio = reader_of(*text);
  Owned<EVP_PKEY> key(PEM_read_bio_PrivateKey(bio.get(), nullptr, nullptr, nullptr));
  const std::string hex = public_hex_of(key.get());
  if (hex.empty()) {
    message = path + ": is no Ed25519 key (PEM, PKCS #8)";
    return Unexpected(Error::kDataLoss);
  }
  const std::string pub = path + ".pub";
  if (::stat(pub.c_str(), &found) != 0) {
    if (const auto made = make_synced_file(pub, public_pem(key.get()), 0644, message); !made) {
      return Unexpected(Error::kIo);
    }
  }
  EVP_PKEY_free(static_cast<EVP_PKEY*>(key_));
  key_ = key.release();
  public_hex_ = hex;
  return {};
}

std::string SigningKey::sign(std::string_view text) const {
  const Owned<EVP_MD_CTX> context(EVP_MD_CTX_new());
  std::array<unsigned char, kSignatureBytes> signature{};
  std::size_t size = signature.size();
  if (!context || key_ == nullptr ||
      EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, static_cast<EVP_PKEY*>(key_)) !=
          1 ||
      EVP_DigestSign(context.get(), signature.data(), &size, bytes_of(text), text.size()) != 1) {
    return {};
  }
  return to_hex(std::span(signature).first(size));
}

bool is_signed_by(std::string_view public_hex, std::string_view text,
                  std::string_view signature_hex) {
  const auto key_bytes = from_hex(public_hex);
  const auto signature = from_hex(signature_hex);
  if (!key_bytes || key_bytes->size() != kKeyBytes || !signature) {
    return false;
  }
  const Owned<EVP_PKEY> key(
      EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, key_bytes->data(), key_bytes->size()));
  const Owned<EVP_MD_CTX> context(EVP_MD_CTX_new());
  return key && context &&
         EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1 &&
         EVP_DigestVerify(context.get(), signature->data(), signature->size(), bytes_of(text),
                          text.size()) == 1;
}

std::optional<std::string> read_public_key(const std::string& path, std::string& message) {
  const auto text = read_small_file(path, message);
  if (!text) {
    return std::nullopt;
  }
  const std::string hex = text->substr(0, text->find_last_not_of(" \r\n") + 1);
  if (hex.size() == 2 * kKeyBytes && from_hex(hex)) {
    return hex;
  }
  const Owned<BIO> bio = reader_of(*text);
  const Owned<EVP_PKEY> key(PEM_read_bio_PUBKEY(bio.get(), nullptr, nullptr, nullptr));
  const std::string found = public_hex_of(key.get());
  if (found.empty()) {
    message = path + ": is no Ed25519 public key, expected PEM or 64 hexadecimal digits";
    return std::nullopt;
  }
  return found;
}

}  // namespace tubesight::drivers
