#include "board/visionbox/page_tools.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include "drivers/web/page_certificate.h"
#include "drivers/web/page_passwords.h"

namespace tubesight::board {
namespace {

int complain(const std::string& words) {
  std::fprintf(stderr, "tubesightctl: %s\n", words.c_str());
  return 1;
}

/// A terminal does not show what is typed while this lives.
class WithoutEcho {
 public:
  WithoutEcho() {
    there_ = isatty(STDIN_FILENO) == 1 && tcgetattr(STDIN_FILENO, &before_) == 0;
    termios silent = before_;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    if (there_) {
      tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
    }
  }
  WithoutEcho(const WithoutEcho&) = delete;
  WithoutEcho& operator=(const WithoutEcho&) = delete;
  ~WithoutEcho() {
    if (there_) {
      tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
    }
  }
  [[nodiscard]] bool terminal() const { return there_; }

 private:
  termios before_{};
  bool there_ = false;
};

std::optional<std::string> ask_line(const WithoutEcho& silent, const char* words) {
  if (silent.terminal()) {
    std::fprintf(stderr, "%s: ", words);
  }
  std::string line;
  const bool got = static_cast<bool>(std::getline(std::cin, line));
  if (silent.terminal()) {
    std::fprintf(stderr, "\n");
  }
  return got ? std::optional(line) : std::nullopt;
}

bool write_new(const std::string& path, const std::string& text, mode_t mode) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) {
    return false;
  }
  const bool written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  return (close(file) == 0) && written;
}

}  // namespace

int set_page_password(const std::string& file, const std::string& role_word) {
  const auto role = drivers::role_of(role_word);
  if (!role) {
    return complain("'" + role_word + "' is no role, expected viewer, operator or engineer");
  }
  drivers::PagePasswords passwords;
  std::error_code unknown;
  if (std::filesystem::exists(file, unknown) && !passwords.load(file)) {
    return complain(passwords.message());
  }
  std::optional<std::string> password;
  {
    const WithoutEcho silent;
    password = ask_line(silent, "password");
    if (silent.terminal() && password != ask_line(silent, "once more")) {
      return complain("the two differ, nothing was changed");
    }
  }
  if (!password) {
    return complain("expected a password on standard input");
  }
  if (!passwords.set(*role, *password) || !passwords.save(file)) {
    return complain(passwords.message());
  }
  return 0;
}

int make_page_certificate(const std::string& certificate, const std::string& key,
                          const std::vector<std::string>& names) {
  drivers::PageCertificate made;
  std::string message;
  if (!drivers::make_certificate(names, std::time(nullptr), made, message)) {
    return complain(message);
  }
  constexpr mode_t kOwner = 0600;
  constexpr mode_t kAll = 0644;
  if (!write_new(key, made.key, kOwner)) {
    return complain(key + ": cannot be written: " + std::strerror(errno));
  }
  if (!write_new(certificate, made.certificate, kAll)) {
    return complain(certificate + ": cannot be written: " + std::strerror(errno));
  }
  std::printf("SHA-256 %s\n", made.fingerprint.c_str());
  return 0;
}

}  // namespace tubesight::board
