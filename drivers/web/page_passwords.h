#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "drivers/web/page_sessions.h"

namespace tubesight::drivers {

/// The passwords of the page's roles: a file with a line for each, the role and what libcrypt made
/// of the password (scrypt, `$7$`). The words themselves stand nowhere.
class PagePasswords {
 public:
  static constexpr std::size_t kShortest = 8;
  static constexpr std::size_t kLongest = 200;

  /// Reads a file. Errors: kIo it cannot be read, kInvalidArgument a line is none; both with
  /// message().
  [[nodiscard]] core::Result<void> load(const std::string& path);
  /// Writes it, for its owner alone, whole or not at all. Errors: kIo with message().
  [[nodiscard]] core::Result<void> save(const std::string& path);

  /// Sets a role's password. Errors: kInvalidArgument too short or too long, with message().
  [[nodiscard]] core::Result<void> set(PageRole role, const std::string& password);
  /// Whether this is the role's. Takes a tenth of a second by design, and as long for a role that
  /// has none.
  [[nodiscard]] bool is_right(PageRole role, const std::string& password) const;

  [[nodiscard]] bool empty() const { return hashes_.empty(); }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  std::map<PageRole, std::string> hashes_;
  std::string message_;
};

}  // namespace tubesight::drivers
