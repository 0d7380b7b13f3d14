#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace tubesight::drivers {

/// A certificate that nobody but itself vouches for, and its key, as PEM texts: for a box without
/// one of the plant's. People compare its fingerprint once.
struct PageCertificate {
  std::string certificate;
  std::string key;
  std::string fingerprint;  ///< SHA-256 in pairs of digits with colons between
};

/// Makes one for these names and addresses, valid for ten years from `now_s` (seconds since 1970)
/// less a day. Errors: kIo, with `message`.
[[nodiscard]] core::Result<void> make_certificate(const std::vector<std::string>& names,
                                                  std::int64_t now_s, PageCertificate& made,
                                                  std::string& message);

/// Whether the two texts are a certificate and its key; else `message` says why not. Of a good one
/// the fingerprint is filled in.
[[nodiscard]] core::Result<void> check_certificate(PageCertificate& certificate,
                                                   std::string& message);

}  // namespace tubesight::drivers
