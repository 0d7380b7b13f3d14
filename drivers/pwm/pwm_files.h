#pragma once

#include <cstdint>
#include <string>

namespace tubesight::drivers {

/// The files of the kernel's PWM, as settings of a channel are read and written: where a test looks
/// at what is written, and in which order.
class PwmFiles {
 public:
  /// Gives 0, or -errno of the kernel's refusal.
  [[nodiscard]] virtual int write(const std::string& path, const std::string& value) = 0;
  /// What stands there, without the line's end; empty where nothing can be read.
  [[nodiscard]] virtual std::string read(const std::string& path) = 0;

 protected:
  ~PwmFiles() = default;
};

/// This machine's.
[[nodiscard]] PwmFiles& system_pwm_files();

/// The number in such a file; -1: there is none.
[[nodiscard]] std::int64_t number_in(PwmFiles& files, const std::string& path);

}  // namespace tubesight::drivers
