#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/pwm/pwm_dimmer.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::support {

/// A folder that looks like the kernel's, with one chip of two channels, the first exported.
class PwmFolder {
 public:
  PwmFolder() {
    std::filesystem::create_directories(folder_.path("devices/fe20c000.pwm"));
    std::filesystem::create_directories(folder_.path("class/pwmchip0/pwm0"));
    std::filesystem::create_directory_symlink(folder_.path("devices/fe20c000.pwm"),
                                              folder_.path("class/pwmchip0/device"));
    set("npwm", "2\n");
    set("export", "");
    for (const char* file : {"pwm0/duty_cycle", "pwm0/period", "pwm0/enable"}) {
      set(file, "0\n");
    }
    set("pwm0/polarity", "normal\n");
  }

  [[nodiscard]] std::string root() const { return folder_.path("class"); }
  [[nodiscard]] std::string file(const std::string& name) const {
    return folder_.path("class/pwmchip0/" + name);
  }
  void set(const std::string& name, const std::string& text) {
    folder_.write("class/pwmchip0/" + name, text);
  }
  /// What the kernel would read: the first line.
  [[nodiscard]] std::string value(const std::string& name) const {
    std::ifstream read(file(name));
    std::string line;
    std::getline(read, line);
    return line;
  }

 private:
  TemporaryFolder folder_;
};

inline drivers::PwmSettings pwm_settings(bool inverted = false) {
  return {"fe20c000.pwm", 0, 1000, inverted};
}

}  // namespace tubesight::support
