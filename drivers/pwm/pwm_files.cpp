#include "drivers/pwm/pwm_files.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>

#include <fcntl.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

class SystemPwmFiles final : public PwmFiles {
 public:
  int write(const std::string& path, const std::string& value) override {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) {
      return -errno;
    }
    const std::string line = value + "\n";
    const ssize_t written = ::write(descriptor, line.data(), line.size());
    const int status = written == static_cast<ssize_t>(line.size()) ? 0 : -errno;
    ::close(descriptor);
    return status;
  }

  std::string read(const std::string& path) override {
    constexpr std::size_t kLongest = 32;
    std::string text(kLongest, '\0');
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
      return {};
    }
    const ssize_t bytes = ::read(descriptor, text.data(), text.size());
    ::close(descriptor);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(bytes, 0)));
    text.resize(std::min(text.find('\n'), text.size()));
    return text;
  }
};

}  // namespace

PwmFiles& system_pwm_files() {
  static SystemPwmFiles files;
  return files;
}

std::int64_t number_in(PwmFiles& files, const std::string& path) {
  const std::string text = files.read(path);
  std::int64_t value = -1;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace tubesight::drivers
