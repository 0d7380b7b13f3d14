#include "drivers/pwm/pwm_dimmer.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Until a channel's files are there and ours: udev hands them over after they were made.
constexpr int kWaits = 50;
constexpr int kWait_ms = 10;

/// 0 or -errno.
int write_file(const std::string& path, const std::string& value) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return -errno;
  }
  const std::string line = value + "\n";
  const ssize_t written = write(descriptor, line.data(), line.size());
  const int status = written == static_cast<ssize_t>(line.size()) ? 0 : -errno;
  close(descriptor);
  return status;
}

std::int64_t read_number(const std::string& path) {
  std::array<char, 32> text{};
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  std::int64_t value = -1;
  if (descriptor >= 0) {
    const ssize_t bytes = read(descriptor, text.data(), text.size());
    std::from_chars(text.data(), text.data() + (bytes > 0 ? bytes : 0), value);
    close(descriptor);
  }
  return value;
}

/// A chip without polarity has no such file: its outputs are as usual.
bool usual_polarity(const std::string& channel) {
  constexpr std::string_view kUsual = "normal";
  std::array<char, kUsual.size()> text{};
  const int descriptor = open((channel + "/polarity").c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return true;
  }
  const ssize_t bytes = read(descriptor, text.data(), text.size());
  close(descriptor);
  return bytes == static_cast<ssize_t>(text.size()) &&
         std::string_view(text.data(), text.size()) == kUsual;
}

}  // namespace

PwmDimmer::PwmDimmer(PwmSettings settings, std::string root)
    : settings_(std::move(settings)), root_(std::move(root)) {}

Result<void> PwmDimmer::refuse(const std::string& what) {
  message_ =
      "lamp on " + settings_.chip + " channel " + std::to_string(settings_.channel) + ": " + what;
  return Unexpected(Error::kIo);
}

Result<void> PwmDimmer::put(const char* file, const std::string& value) {
  const int status = write_file(channel_ + "/" + file, value);
  return status == 0 ? Result<void>()
                     : refuse(std::string(file) + " = " + value + ": " + std::strerror(-status));
}

Result<void> PwmDimmer::open_channel() {
  const std::string chip = find_pwm_chip(root_, settings_.chip);
  if (chip.empty()) {
    std::string there;
    for (const PwmChip& other : list_pwm_chips(root_)) {
      there += (there.empty() ? "" : ", ") + (other.device.empty() ? other.name : other.device);
    }
    return refuse("there is no such chip, expected one of: " + (there.empty() ? "none is" : there));
  }
  const std::int64_t channels = read_number(chip + "/npwm");
  if (settings_.channel < 0 || settings_.channel >= channels) {
    return refuse("the chip has " + std::to_string(channels) + " channels");
  }
  channel_ = chip + "/pwm" + std::to_string(settings_.channel);
  const std::string duty = channel_ + "/duty_cycle";
  if (access(channel_.c_str(), F_OK) != 0) {
    if (const int status = write_file(chip + "/export", std::to_string(settings_.channel));
        status != 0) {
      return refuse(status == -EBUSY
                        ? "is used by another driver of the kernel, expected it free"
                        : std::string("cannot be exported: ") + std::strerror(-status));
    }
  }
  for (int i = 0; i < kWaits && access(duty.c_str(), W_OK) != 0; ++i) {
    poll(nullptr, 0, kWait_ms);
  }
  return access(duty.c_str(), W_OK) == 0
             ? Result<void>()
             : refuse(std::string("duty_cycle: ") + std::strerror(errno) +
                      ", expected it writable by the box's user");
}

Result<void> PwmDimmer::start() {
  if (duty_ >= 0) {
    return Unexpected(Error::kNotReady);
  }
  message_.clear();
  TUBESIGHT_TRY(open_channel());
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  period_ns_ = kSecond_ns / settings_.frequency_hz;
  const std::string period = std::to_string(period_ns_);
  // A channel that a box left at dark is taken over without a flash. Otherwise a period must not be
  // shorter than the pulse in it, whatever somebody left there, and polarity can be changed at rest
  // only; a chip without one keeps the usual.
  if (read_number(channel_ + "/period") != period_ns_ || read_number(channel_ + "/enable") != 1 ||
      !usual_polarity(channel_)) {
    TUBESIGHT_TRY(put("duty_cycle", "0"));
    TUBESIGHT_TRY(put("enable", "0"));
    static_cast<void>(write_file(channel_ + "/polarity", "normal"));
    TUBESIGHT_TRY(put("period", period));
  }
  if (!usual_polarity(channel_)) {
    return refuse("polarity is not normal, expected it so: dark would be light");
  }
  const std::int64_t kept = read_number(channel_ + "/period");
  constexpr std::int64_t kParts = 100;  // a chip may round to its clock, by 1 %
  if (kept < period_ns_ - period_ns_ / kParts || kept > period_ns_ + period_ns_ / kParts) {
    return refuse("period is " + std::to_string(kept) + " ns, expected " + period);
  }
  period_ns_ = kept;
  TUBESIGHT_TRY(put("duty_cycle", settings_.inverted ? std::to_string(kept) : "0"));
  TUBESIGHT_TRY(put("enable", "1"));
  duty_ = open((channel_ + "/duty_cycle").c_str(), O_WRONLY | O_CLOEXEC);
  level_permille_ = 0;
  return duty_ >= 0 ? Result<void>() : refuse(std::string("duty_cycle: ") + std::strerror(errno));
}

void PwmDimmer::stop() {
  if (duty_ < 0) {
    return;
  }
  static_cast<void>(write_level(0));
  close(duty_);
  duty_ = -1;
  level_permille_ = 0;
}

/// 0 or -errno. No heap.
int PwmDimmer::write_level(std::int32_t permille) const {
  const std::int64_t lit = period_ns_ * permille / hal::kFullLevel_permille;
  std::array<char, 24> text{};
  char* end = std::to_chars(text.data(), text.data() + text.size() - 1,
                            settings_.inverted ? period_ns_ - lit : lit)
                  .ptr;
  *end++ = '\n';
  const auto bytes = static_cast<std::size_t>(end - text.data());
  const ssize_t written = pwrite(duty_, text.data(), bytes, 0);
  return written == static_cast<ssize_t>(bytes) ? 0 : written < 0 ? -errno : -EIO;
}

Result<void> PwmDimmer::set_level(std::int32_t permille) {
  if (duty_ < 0) {
    return Unexpected(Error::kNotReady);
  }
  if (permille < 0 || permille > hal::kFullLevel_permille) {
    return Unexpected(Error::kOutOfRange);
  }
  const int status = write_level(permille);
  if (status != 0) {
    return Unexpected(status == -ENODEV ? Error::kDisconnected : Error::kIo);
  }
  level_permille_ = permille;
  return {};
}

}  // namespace tubesight::drivers
