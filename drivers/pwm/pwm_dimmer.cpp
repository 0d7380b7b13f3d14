#include "drivers/pwm/pwm_dimmer.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Until a channel's files are there and ours: udev hands them over after they were made.
constexpr int kWaits = 50;
constexpr int kWait_ms = 10;

/// A chip without polarity has no such file: its outputs are as usual.
bool usual_polarity(PwmFiles& files, const std::string& channel) {
  return access((channel + "/polarity").c_str(), F_OK) != 0 ||
         files.read(channel + "/polarity") == "normal";
}

}  // namespace

PwmDimmer::PwmDimmer(PwmSettings settings, std::string root, PwmFiles& files)
    : settings_(std::move(settings)), root_(std::move(root)), files_(&files) {}

Result<void> PwmDimmer::refuse(const std::string& what) {
  message_ =
      "lamp on " + settings_.chip + " channel " + std::to_string(settings_.channel) + ": " + what;
  return Unexpected(Error::kIo);
}

Result<void> PwmDimmer::put(const char* file, const std::string& value) {
  const int status = files_->write(channel_ + "/" + file, value);
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
  const std::int64_t channels = number_in(*files_, chip + "/npwm");
  if (settings_.channel < 0 || settings_.channel >= channels) {
    return refuse("the chip has " + std::to_string(channels) + " channels");
  }
  channel_ = chip + "/pwm" + std::to_string(settings_.channel);
  const std::string duty = channel_ + "/duty_cycle";
  if (access(channel_.c_str(), F_OK) != 0) {
    if (const int status = files_->write(chip + "/export", std::to_string(settings_.channel));
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

/// Nothing is written before the channel is ours.
Result<void> PwmDimmer::take_channel() {
  duty_ = open((channel_ + "/duty_cycle").c_str(), O_WRONLY | O_CLOEXEC);
  if (duty_ < 0) {
    return refuse(std::string("duty_cycle: ") + std::strerror(errno));
  }
  return flock(duty_, LOCK_EX | LOCK_NB) == 0
             ? Result<void>()
             : refuse("is busy: another box or lamp has it, expected it free");
}

/// A channel that is left at rest has no light of ours; an enabled one is dark at one end of its
/// pulse, by its polarity.
Result<void> PwmDimmer::set_period(std::int64_t old_period_ns) {
  const bool runs = number_in(*files_, channel_ + "/enable") == 1;
  const std::string period = std::to_string(period_ns_);
  if (old_period_ns == 0) {
    return put("period", period);  // a channel without one has no pulse, and takes none
  }
  if (!runs || old_period_ns <= 0 || !settings_.inverted) {
    TUBESIGHT_TRY(put("duty_cycle", "0"));
    return put("period", period);
  }
  // The kernel takes no pulse that is longer than its period: the nearest to dark that it takes on
  // the way. What lies between is over at the end of a period.
  TUBESIGHT_TRY(put("duty_cycle", std::to_string(std::min(period_ns_, old_period_ns))));
  return put("period", period);
}

/// Polarity can be changed at rest only, and rest is dark for no lamp with certainty: as shortly as
/// may be, with dark on both sides of it.
Result<void> PwmDimmer::turn_over() {
  const std::int64_t old_period_ns = number_in(*files_, channel_ + "/period");
  if (number_in(*files_, channel_ + "/enable") == 1) {
    TUBESIGHT_TRY(put("duty_cycle", settings_.inverted ? "0" : std::to_string(old_period_ns)));
    TUBESIGHT_TRY(put("enable", "0"));
  }
  static_cast<void>(files_->write(channel_ + "/polarity", "normal"));
  return usual_polarity(*files_, channel_)
             ? Result<void>()
             : refuse("polarity is not normal, expected it so: dark would be light");
}

/// A channel that a box left at dark is taken over without a flash.
Result<void> PwmDimmer::make_dark() {
  if (!usual_polarity(*files_, channel_)) {
    TUBESIGHT_TRY(turn_over());
  }
  const std::int64_t old_period_ns = number_in(*files_, channel_ + "/period");
  if (old_period_ns != period_ns_) {
    TUBESIGHT_TRY(set_period(old_period_ns));
  }
  const std::int64_t kept = number_in(*files_, channel_ + "/period");
  constexpr std::int64_t kParts = 100;  // a chip may round to its clock, by 1 %
  if (kept < period_ns_ - period_ns_ / kParts || kept > period_ns_ + period_ns_ / kParts) {
    return refuse("period is " + std::to_string(kept) + " ns, expected " +
                  std::to_string(period_ns_));
  }
  period_ns_ = kept;
  TUBESIGHT_TRY(put("duty_cycle", settings_.inverted ? std::to_string(kept) : "0"));
  return put("enable", "1");
}

Result<void> PwmDimmer::start() {
  if (duty_ >= 0) {
    return Unexpected(Error::kNotReady);
  }
  message_.clear();
  TUBESIGHT_TRY(open_channel());
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  period_ns_ = kSecond_ns / settings_.frequency_hz;
  level_permille_ = 0;
  auto ready = take_channel();
  if (ready) {
    ready = make_dark();
  }
  if (!ready && duty_ >= 0) {
    close(duty_);
    duty_ = -1;
  }
  return ready;
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
