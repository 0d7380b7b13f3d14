#include "drivers/watchdog/device_watchdog.h"

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::int32_t kLongest_s = 3600;
/// The kernel's drivers disarm when they are closed right behind it.
constexpr char kMagic = 'V';

std::string why_not_open(int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return "is not there: its driver is not loaded, or this machine has none (softdog stands in)";
    case EBUSY:
      return "is in use by another program, expected one owner (RuntimeWatchdogSec= of systemd "
             "takes it, too)";
    case EACCES:
    case EPERM: return "may not be opened by this user, expected a udev rule that lets it";
    default: return std::string("cannot be opened: ") + std::strerror(error);
  }
}

}  // namespace

DeviceWatchdog::~DeviceWatchdog() {
  if (device_ >= 0) {
    kernel_->close(device_);
  }
}

Result<void> DeviceWatchdog::refuse(Error error, const std::string& what) {
  message_ = path_ + ": " + what;
  return Unexpected(error);
}

Result<void> DeviceWatchdog::start(std::chrono::seconds timeout) {
  if (device_ >= 0) {
    return Unexpected(Error::kNotReady);
  }
  if (timeout.count() < 1 || timeout.count() > kLongest_s) {
    return refuse(Error::kOutOfRange, std::to_string(timeout.count()) + " s, expected 1 to 3600");
  }
  note_.clear();
  message_.clear();
  const int device = kernel_->open(path_);
  if (device < 0) {
    return refuse(Error::kIo, why_not_open(-device));
  }
  device_ = device;
  if (const int status = kernel_->abilities(device_, abilities_); status < 0) {
    kernel_->close(device_);  // nothing is written to what is no watchdog
    device_ = -1;
    return refuse(Error::kIo, std::string("is no watchdog: ") + std::strerror(-status));
  }
  auto seconds = static_cast<std::int32_t>(timeout.count());
  if (!abilities_.can_be_timed) {
    note_ = path_ + ": takes no time-out and keeps its own";
  } else if (const int status = kernel_->set_timeout(device_, seconds); status < 0) {
    disarm();
    return refuse(Error::kOutOfRange, "refuses " + std::to_string(timeout.count()) +
                                          " s: " + std::strerror(-status) +
                                          ", expected less: many take 15 s at most");
  } else if (seconds != timeout.count()) {
    note_ = path_ + ": takes " + std::to_string(seconds) + " s for " +
            std::to_string(timeout.count()) + " s";
  }
  if (!abilities_.can_be_stopped) {
    note_ += (note_.empty() ? path_ + ": " : "; ") +
             std::string("cannot be ended: the machine resets after the box has stopped");
  }
  timeout_ = std::chrono::seconds(seconds);
  return {};
}

/// A refusal changes nothing: nothing else can be done.
void DeviceWatchdog::disarm() {
  static_cast<void>(kernel_->write(device_, kMagic));
  kernel_->close(device_);
  device_ = -1;
  timeout_ = std::chrono::seconds(0);
}

void DeviceWatchdog::stop() {
  if (device_ >= 0) {
    disarm();
  }
}

Result<void> DeviceWatchdog::feed() {
  if (device_ < 0) {
    return Unexpected(Error::kNotReady);
  }
  if (const int status = kernel_->keep_alive(device_); status < 0) {
    return refuse(Error::kDisconnected, std::string("cannot be fed: ") + std::strerror(-status));
  }
  return {};
}

}  // namespace tubesight::drivers
