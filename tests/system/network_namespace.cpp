#include "tests/system/network_namespace.h"

#include <cerrno>
#include <cstring>

#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace tubesight::tests {
namespace {

std::string failed(const char* what) {
  return std::string(what) + ": " + std::strerror(errno) +
         "; this test needs a network namespace: run it as root, or allow users namespaces "
         "(sysctl kernel.unprivileged_userns_clone=1)";
}

}  // namespace

std::string enter_network_of_its_own() {
  static bool entered = false;
  if (entered) {
    return {};
  }
  if (unshare(CLONE_NEWNET) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
    return failed("unshare");
  }
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq loopback{};
  std::strcpy(loopback.ifr_name, "lo");
  loopback.ifr_flags = IFF_UP | IFF_RUNNING;
  const bool up = descriptor >= 0 && ioctl(descriptor, SIOCSIFFLAGS, &loopback) == 0;
  const std::string problem = up ? std::string() : failed("the loopback");
  close(descriptor);
  entered = up;
  return problem;
}

}  // namespace tubesight::tests
