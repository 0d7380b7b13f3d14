#include "drivers/watchdog/watchdog_kernel.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <linux/watchdog.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

int status_of(int result) { return result < 0 ? -errno : 0; }

class SystemKernel final : public WatchdogKernel {
 public:
  int open(const std::string& path) override {
    const int device = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    return device < 0 ? -errno : device;
  }

  int abilities(int device, WatchdogAbilities& abilities) override {
    watchdog_info info{};
    if (ioctl(device, WDIOC_GETSUPPORT, &info) < 0) {
      return -errno;
    }
    const char* const name = reinterpret_cast<const char*>(info.identity);
    abilities.name.assign(name, strnlen(name, sizeof info.identity));
    abilities.can_be_timed = (info.options & WDIOF_SETTIMEOUT) != 0;
    abilities.can_be_stopped = (info.options & WDIOF_MAGICCLOSE) != 0;
    return 0;
  }

  int set_timeout(int device, std::int32_t& seconds) override {
    return status_of(ioctl(device, WDIOC_SETTIMEOUT, &seconds));
  }

  int keep_alive(int device) override { return status_of(ioctl(device, WDIOC_KEEPALIVE, 0)); }

  int write(int device, char character) override {
    return ::write(device, &character, 1) == 1 ? 0 : -errno;
  }

  void close(int device) override { ::close(device); }
};

}  // namespace

WatchdogKernel& system_watchdog_kernel() {
  static SystemKernel kernel;
  return kernel;
}

}  // namespace tubesight::drivers
