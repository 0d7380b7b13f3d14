#pragma once

#include <cerrno>
#include <cstdint>
#include <string>

#include "drivers/watchdog/watchdog_kernel.h"

namespace tubesight::support {

/// One device that behaves as the kernel's, and writes down each call.
class FakeWatchdogKernel final : public drivers::WatchdogKernel {
 public:
  int open_status = 0;
  int abilities_status = 0;
  int timeout_status = 0;
  int feed_status = 0;
  std::int32_t most_s = 60;
  bool timed = true;
  bool stopped = true;
  std::string calls;
  bool armed = false;

  int open(const std::string& path) override {
    calls += "open " + path + ";";
    if (open_status != 0) {
      return open_status;
    }
    if (is_open_) {
      return -EBUSY;
    }
    is_open_ = true;
    armed = true;
    return 7;
  }
  int abilities(int, drivers::WatchdogAbilities& abilities) override {
    abilities = {"fake", timed, stopped};
    return abilities_status;
  }
  int set_timeout(int, std::int32_t& wanted) override {
    calls += "timeout " + std::to_string(wanted) + ";";
    if (wanted > most_s) {
      wanted = most_s;
    }
    return timeout_status;
  }
  int keep_alive(int) override {
    calls += "feed;";
    return feed_status;
  }
  int write(int, char character) override {
    calls += std::string("write ") + character + ";";
    magic_ = character == 'V';
    return 0;
  }
  void close(int) override {
    calls += "close;";
    is_open_ = false;
    if (magic_ && stopped) {
      armed = false;
    }
    magic_ = false;
  }

 private:
  bool is_open_ = false;
  bool magic_ = false;
};

}  // namespace tubesight::support
