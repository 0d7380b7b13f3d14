#include "drivers/web/page_passwords.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include <crypt.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "drivers/files/atomic_file.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr const char* kScrypt = "$7$";
/// 16 MB and some 50 ms on a PC; a box takes two or three times as long.
constexpr unsigned long kCost = 7;

std::string hash(const std::string& password, const std::string& setting) {
  const auto data = std::make_unique<crypt_data>();
  const char* const made = crypt_r(password.c_str(), setting.c_str(), data.get());
  return made == nullptr || made[0] == '*' ? std::string() : made;
}

std::string new_setting() {
  std::array<char, 32> drawn{};
  if (getrandom(drawn.data(), drawn.size(), 0) != static_cast<ssize_t>(drawn.size())) {
    return {};
  }
  std::array<char, CRYPT_GENSALT_OUTPUT_SIZE> setting{};
  const char* const made =
      crypt_gensalt_rn(kScrypt, kCost, drawn.data(), static_cast<int>(drawn.size()), setting.data(),
                       static_cast<int>(setting.size()));
  return made == nullptr ? std::string() : made;
}

/// In a time that does not tell how much of them agrees.
bool are_equal(const std::string& one, const std::string& other) {
  if (one.size() != other.size()) {
    return false;
  }
  unsigned difference = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    difference |= static_cast<unsigned>(one[i] ^ other[i]);
  }
  return difference == 0;
}

}  // namespace

Result<void> PagePasswords::load(const std::string& path) {
  hashes_.clear();
  std::ifstream file(path);
  if (!file) {
    message_ = path + ": cannot be read: " + std::strerror(errno);
    return Unexpected(Error::kIo);
  }
  std::int32_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line.front() == '#') {
      continue;
    }
    const std::size_t space = line.find(' ');
    const auto role = role_of(line.substr(0, space));
    if (!role || space == std::string::npos || !line.substr(space + 1).starts_with(kScrypt)) {
      hashes_.clear();
      message_ = path + ":" + std::to_string(number) +
                 ": expected viewer, operator or engineer and what `tubesightctl page-password` "
                 "makes";
      return Unexpected(Error::kInvalidArgument);
    }
    hashes_[*role] = line.substr(space + 1);
  }
  return {};
}

Result<void> PagePasswords::save(const std::string& path) {
  std::string text = "# Passwords of the operator's page, by role: tubesightctl page-password\n";
  for (const auto& [role, hashed] : hashes_) {
    text += std::string(name_of(role)) + " " + hashed + "\n";
  }
  const mode_t before = umask(S_IRWXG | S_IRWXO);
  AtomicFile file;
  auto outcome = file.open(path);
  if (outcome) {
    outcome = file.write(text);
  }
  if (outcome) {
    outcome = file.commit_to_disk();
  }
  umask(before);
  if (!outcome) {
    message_ = file.message();
  }
  return outcome;
}

Result<void> PagePasswords::set(PageRole role, const std::string& password) {
  if (password.size() < kShortest || password.size() > kLongest) {
    message_ = std::to_string(password.size()) + " letters, expected 8 to 200";
    return Unexpected(Error::kInvalidArgument);
  }
  const std::string made = hash(password, new_setting());
  if (made.empty()) {
    message_ = "this system's libcrypt has no scrypt";
    return Unexpected(Error::kInvalidArgument);
  }
  hashes_[role] = made;
  return {};
}

bool PagePasswords::is_right(PageRole role, const std::string& password) const {
  const auto found = hashes_.find(role);
  const std::string& kept = found != hashes_.end()
                                ? found->second
                                : (hashes_.empty() ? std::string() : hashes_.begin()->second);
  if (kept.empty() || password.size() > kLongest) {
    return false;
  }
  return are_equal(hash(password, kept), kept) && found != hashes_.end();
}

}  // namespace tubesight::drivers
