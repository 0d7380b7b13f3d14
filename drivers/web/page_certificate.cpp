#include "drivers/web/page_certificate.h"

#include <array>
#include <cstddef>
#include <ctime>
#include <memory>
#include <string_view>

#include <arpa/inet.h>
#include <gnutls/abstract.h>
#include <gnutls/crypto.h>
#include <gnutls/gnutls.h>
#include <gnutls/x509.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

struct FreeCertificate {
  using pointer = gnutls_x509_crt_t;
  void operator()(gnutls_x509_crt_t certificate) const { gnutls_x509_crt_deinit(certificate); }
};
struct FreeKey {
  using pointer = gnutls_x509_privkey_t;
  void operator()(gnutls_x509_privkey_t key) const { gnutls_x509_privkey_deinit(key); }
};
using Certificate = std::unique_ptr<gnutls_x509_crt_t, FreeCertificate>;
using Key = std::unique_ptr<gnutls_x509_privkey_t, FreeKey>;

Certificate new_certificate() {
  gnutls_x509_crt_t made = nullptr;
  return Certificate(gnutls_x509_crt_init(&made) < 0 ? nullptr : made);
}

Key new_key() {
  gnutls_x509_privkey_t made = nullptr;
  return Key(gnutls_x509_privkey_init(&made) < 0 ? nullptr : made);
}

gnutls_datum_t datum_of(const std::string& text) {
  auto* const bytes = reinterpret_cast<unsigned char*>(const_cast<char*>(text.data()));
  return {bytes, static_cast<unsigned>(text.size())};
}

std::string take(gnutls_datum_t& datum) {
  std::string text(reinterpret_cast<const char*>(datum.data), datum.size);
  gnutls_free(datum.data);
  datum = {};
  return text;
}

/// As a name, or as an address where it is one.
int add_name(gnutls_x509_crt_t certificate, const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  unsigned size = 0;
  if (inet_pton(AF_INET, name.c_str(), bytes.data()) == 1) {
    size = sizeof(in_addr);
  } else if (inet_pton(AF_INET6, name.c_str(), bytes.data()) == 1) {
    size = sizeof(in6_addr);
  }
  return size > 0 ? gnutls_x509_crt_set_subject_alt_name(certificate, GNUTLS_SAN_IPADDRESS,
                                                         bytes.data(), size, GNUTLS_FSAN_APPEND)
                  : gnutls_x509_crt_set_subject_alt_name(
                        certificate, GNUTLS_SAN_DNSNAME, name.data(),
                        static_cast<unsigned>(name.size()), GNUTLS_FSAN_APPEND);
}

int fill(gnutls_x509_crt_t certificate, gnutls_x509_privkey_t key,
         const std::vector<std::string>& names, std::int64_t now_s) {
  constexpr std::int64_t kDay_s = 86'400;
  constexpr std::int64_t kYears = 10;
  constexpr std::string_view kSubject = "CN=Tubesight vision box";
  std::array<unsigned char, 16> serial{};
  int status = gnutls_rnd(GNUTLS_RND_NONCE, serial.data(), serial.size());
  serial[0] &= 0x7FU;  // a number above zero
  const auto next = [&status](int outcome) { status = status < 0 ? status : outcome; };
  next(gnutls_x509_privkey_generate(key, GNUTLS_PK_ECDSA,
                                    GNUTLS_CURVE_TO_BITS(GNUTLS_ECC_CURVE_SECP256R1), 0));
  next(gnutls_x509_crt_set_version(certificate, 3));
  next(gnutls_x509_crt_set_serial(certificate, serial.data(), serial.size()));
  next(gnutls_x509_crt_set_activation_time(certificate, static_cast<std::time_t>(now_s - kDay_s)));
  next(gnutls_x509_crt_set_expiration_time(
      certificate, static_cast<std::time_t>(now_s + kYears * 365 * kDay_s)));
  next(gnutls_x509_crt_set_dn(certificate, kSubject.data(), nullptr));
  next(gnutls_x509_crt_set_key(certificate, key));
  next(gnutls_x509_crt_set_basic_constraints(certificate, 0, -1));
  next(gnutls_x509_crt_set_key_usage(certificate, GNUTLS_KEY_DIGITAL_SIGNATURE));
  next(gnutls_x509_crt_set_key_purpose_oid(certificate, GNUTLS_KP_TLS_WWW_SERVER, 0));
  for (const std::string& name : names) {
    next(add_name(certificate, name));
  }
  next(gnutls_x509_crt_sign2(certificate, certificate, key, GNUTLS_DIG_SHA256, 0));
  return status;
}

std::string fingerprint_of(gnutls_x509_crt_t certificate) {
  std::array<unsigned char, 32> digest{};
  std::size_t size = digest.size();
  if (gnutls_x509_crt_get_fingerprint(certificate, GNUTLS_DIG_SHA256, digest.data(), &size) < 0) {
    return {};
  }
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const unsigned char byte : digest) {
    text += text.empty() ? "" : ":";
    text += kDigits[byte / 16U];
    text += kDigits[byte % 16U];
  }
  return text;
}

}  // namespace

Result<void> make_certificate(const std::vector<std::string>& names, std::int64_t now_s,
                              PageCertificate& made, std::string& message) {
  const Certificate certificate = new_certificate();
  const Key key = new_key();
  int status =
      certificate && key ? fill(certificate.get(), key.get(), names, now_s) : GNUTLS_E_MEMORY_ERROR;
  gnutls_datum_t text{};
  if (status >= 0) {
    status = gnutls_x509_crt_export2(certificate.get(), GNUTLS_X509_FMT_PEM, &text);
  }
  if (status >= 0) {
    made.certificate = take(text);
    status = gnutls_x509_privkey_export2_pkcs8(key.get(), GNUTLS_X509_FMT_PEM, nullptr,
                                               GNUTLS_PKCS_PLAIN, &text);
  }
  if (status < 0) {
    message = std::string("no certificate can be made: ") + gnutls_strerror(status);
    return Unexpected(Error::kIo);
  }
  made.key = take(text);
  made.fingerprint = fingerprint_of(certificate.get());
  return {};
}

Result<void> check_certificate(PageCertificate& checked, std::string& message) {
  const Certificate certificate = new_certificate();
  const Key key = new_key();
  const gnutls_datum_t certificate_text = datum_of(checked.certificate);
  const gnutls_datum_t key_text = datum_of(checked.key);
  if (!certificate ||
      gnutls_x509_crt_import(certificate.get(), &certificate_text, GNUTLS_X509_FMT_PEM) < 0) {
    message = "the certificate is none in PEM form";
    return Unexpected(Error::kInvalidArgument);
  }
  if (!key ||
      gnutls_x509_privkey_import2(key.get(), &key_text, GNUTLS_X509_FMT_PEM, nullptr, 0) < 0) {
    message = "the key is none in PEM form without a password";
    return Unexpected(Error::kInvalidArgument);
  }
  std::array<unsigned char, 64> of_key{};
  std::array<unsigned char, 64> of_certificate{};
  std::size_t key_size = of_key.size();
  std::size_t certificate_size = of_certificate.size();
  if (gnutls_x509_privkey_get_key_id(key.get(), GNUTLS_KEYID_USE_SHA256, of_key.data(), &key_size) <
          0 ||
      gnutls_x509_crt_get_key_id(certificate.get(), GNUTLS_KEYID_USE_SHA256, of_certificate.data(),
                                 &certificate_size) < 0 ||
      key_size != certificate_size || of_key != of_certificate) {
    message = "the key is not the certificate's";
    return Unexpected(Error::kInvalidArgument);
  }
  checked.fingerprint = fingerprint_of(certificate.get());
  return {};
}

}  // namespace tubesight::drivers
