// Lines by libgpiod 2.x, as Debian 13 has it; gpiod1_line_bank.cpp is the same by 1.6.

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include <gpiod.h>

#include "drivers/gpio/line_bank.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

namespace fs = std::filesystem;

constexpr const char* kConsumer = "tubesight";

/// What the library made, given back by its own function.
template <typename T, void (*Free)(T*)>
struct Freed {
  void operator()(T* made) const { Free(made); }
};
template <typename T, void (*Free)(T*)>
using Owned = std::unique_ptr<T, Freed<T, Free>>;

using Chip = Owned<gpiod_chip, gpiod_chip_close>;
using ChipInfo = Owned<gpiod_chip_info, gpiod_chip_info_free>;
using LineInfo = Owned<gpiod_line_info, gpiod_line_info_free>;
using LineSettings = Owned<gpiod_line_settings, gpiod_line_settings_free>;
using LineConfig = Owned<gpiod_line_config, gpiod_line_config_free>;
using RequestConfig = Owned<gpiod_request_config, gpiod_request_config_free>;
using Request = Owned<gpiod_line_request, gpiod_line_request_release>;

std::optional<unsigned int> number_of(const std::string& text) {
  unsigned int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number)
                                                                  : std::nullopt;
}

std::string text_of(const char* text) { return text == nullptr ? std::string() : text; }

std::vector<std::string> chip_paths() {
  std::vector<std::string> paths;
  std::error_code error;
  for (fs::directory_iterator entry("/dev", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string path = entry->path().string();
    if (path.starts_with("/dev/gpiochip") && gpiod_is_gpiochip_device(path.c_str())) {
      paths.push_back(path);
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// By its path, or by its label or name among those that there are.
Chip open_chip(const std::string& wanted) {
  if (wanted.starts_with('/')) {
    return Chip(gpiod_chip_open(wanted.c_str()));
  }
  for (const std::string& path : chip_paths()) {
    Chip chip(gpiod_chip_open(path.c_str()));
    const ChipInfo info(chip ? gpiod_chip_get_info(chip.get()) : nullptr);
    if (info && (wanted == gpiod_chip_info_get_label(info.get()) ||
                 wanted == gpiod_chip_info_get_name(info.get()))) {
      return chip;
    }
  }
  errno = ENOENT;
  return {};
}

class Gpiod2LineBank final : public LineBank {
 public:
  Result<void> open(const LineBankSettings& settings, std::string& message) override {
    close();
    const Chip chip = open_chip(settings.chip);
    const ChipInfo info(chip ? gpiod_chip_get_info(chip.get()) : nullptr);
    if (!info) {
      message = std::string("there is no such chip, or it is not ours: ") + std::strerror(errno);
      return Unexpected(Error::kIo);
    }
    std::vector<unsigned int> offsets;
    for (const std::string& name : settings.lines) {
      const auto number = number_of(name);
      const int offset = number ? static_cast<int>(*number)
                                : gpiod_chip_get_line_offset_from_name(chip.get(), name.c_str());
      const LineInfo line(
          offset < 0 ? nullptr
                     : gpiod_chip_get_line_info(chip.get(), static_cast<unsigned int>(offset)));
      if (!line) {
        message = "has no line '" + name + "', expected one of its " +
                  std::to_string(gpiod_chip_info_get_num_lines(info.get()));
        return Unexpected(Error::kIo);
      }
      if (gpiod_line_info_is_used(line.get())) {
        const std::string user = text_of(gpiod_line_info_get_consumer(line.get()));
        message = "line '" + name + "' is used by " +
                  (user.empty() ? std::string("the kernel") : "'" + user + "'") +
                  ", expected it free";
        return Unexpected(Error::kIo);
      }
      offsets.push_back(static_cast<unsigned int>(offset));
    }
    const LineSettings dark(gpiod_line_settings_new());
    const LineConfig lines(gpiod_line_config_new());
    const RequestConfig request(gpiod_request_config_new());
    if (!dark || !lines || !request) {
      message = "no memory for its lines";
      return Unexpected(Error::kIo);
    }
    gpiod_line_settings_set_direction(dark.get(), GPIOD_LINE_DIRECTION_OUTPUT);
    gpiod_line_settings_set_output_value(dark.get(), GPIOD_LINE_VALUE_INACTIVE);
    gpiod_line_settings_set_active_low(dark.get(), settings.active_low);
    gpiod_request_config_set_consumer(request.get(), kConsumer);
    if (gpiod_line_config_add_line_settings(lines.get(), offsets.data(), offsets.size(),
                                            dark.get()) == 0) {
      request_.reset(gpiod_chip_request_lines(chip.get(), request.get(), lines.get()));
    }
    if (!request_) {
      message = std::string("does not give its lines: ") + std::strerror(errno);
      return Unexpected(Error::kIo);
    }
    return {};
  }

  void close() override { request_.reset(); }

  int set(std::uint32_t lit) override {
    std::array<gpiod_line_value, kMostLines> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = (lit >> i & 1) != 0 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    }
    return gpiod_line_request_set_values(request_.get(), values.data()) == 0 ? 0 : -errno;
  }

 private:
  Request request_;
};

}  // namespace

std::unique_ptr<LineBank> make_gpiod_line_bank() { return std::make_unique<Gpiod2LineBank>(); }

std::vector<GpioChip> list_gpio_chips() {
  std::vector<GpioChip> chips;
  for (const std::string& path : chip_paths()) {
    const Chip chip(gpiod_chip_open(path.c_str()));
    const ChipInfo info(chip ? gpiod_chip_get_info(chip.get()) : nullptr);
    if (!info) {
      continue;
    }
    GpioChip found;
    found.name = gpiod_chip_info_get_name(info.get());
    found.label = gpiod_chip_info_get_label(info.get());
    for (unsigned int i = 0; i < gpiod_chip_info_get_num_lines(info.get()); ++i) {
      GpioChip::Line told;
      if (const LineInfo line(gpiod_chip_get_line_info(chip.get(), i)); line) {
        told.name = text_of(gpiod_line_info_get_name(line.get()));
        const std::string user = text_of(gpiod_line_info_get_consumer(line.get()));
        told.user = !gpiod_line_info_is_used(line.get()) ? "" : user.empty() ? "the kernel" : user;
      }
      found.lines.push_back(told);
    }
    chips.push_back(found);
  }
  return chips;
}

}  // namespace tubesight::drivers
