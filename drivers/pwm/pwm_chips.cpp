#include "drivers/pwm/pwm_chips.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

namespace fs = std::filesystem;

std::int32_t channels_of(const fs::path& chip) {
  std::array<char, 16> text{};
  const int descriptor = open((chip / "npwm").c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return 0;
  }
  const ssize_t bytes = read(descriptor, text.data(), text.size());
  close(descriptor);
  std::int32_t channels = 0;
  std::from_chars(text.data(), text.data() + std::max<ssize_t>(bytes, 0), channels);
  return channels;
}

}  // namespace

std::vector<PwmChip> list_pwm_chips(const std::string& root) {
  std::vector<PwmChip> chips;
  std::error_code error;
  for (fs::directory_iterator entry(root, error), end; !error && entry != end;
       entry.increment(error)) {
    PwmChip chip;
    chip.name = entry->path().filename().string();
    std::error_code absent;
    const fs::path device = fs::canonical(entry->path() / "device", absent);
    chip.device = absent ? std::string() : device.filename().string();
    chip.channels = channels_of(entry->path());
    chips.push_back(chip);
  }
  std::sort(chips.begin(), chips.end(),
            [](const PwmChip& a, const PwmChip& b) { return a.name < b.name; });
  return chips;
}

std::string find_pwm_chip(const std::string& root, const std::string& wanted) {
  for (const PwmChip& chip : list_pwm_chips(root)) {
    if (chip.device == wanted || chip.name == wanted) {
      return root + "/" + chip.name;
    }
  }
  return {};
}

}  // namespace tubesight::drivers
