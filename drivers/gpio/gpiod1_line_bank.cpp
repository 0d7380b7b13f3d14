// Lines by libgpiod 1.6, as Debian 12 has it; gpiod2_line_bank.cpp is the same by 2.x.

#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <optional>

#include <gpiod.h>

#include "drivers/gpio/line_bank.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr const char* kConsumer = "tubesight";

std::optional<unsigned int> number_of(const std::string& text) {
  unsigned int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number)
                                                                  : std::nullopt;
}

class Gpiod1LineBank final : public LineBank {
 public:
  ~Gpiod1LineBank() override { close(); }

  Result<void> open(const LineBankSettings& settings, std::string& message) override {
    close();
    chip_ = gpiod_chip_open_lookup(settings.chip.c_str());
    if (chip_ == nullptr) {
      message = std::string("there is no such chip, or it is not ours: ") + std::strerror(errno);
      return Unexpected(Error::kIo);
    }
    gpiod_line_bulk_init(&lines_);
    for (const std::string& name : settings.lines) {
      const auto number = number_of(name);
      gpiod_line* const line =
          number ? gpiod_chip_get_line(chip_, *number) : gpiod_chip_find_line(chip_, name.c_str());
      if (line == nullptr) {
        message = "has no line '" + name + "', expected one of its " +
                  std::to_string(gpiod_chip_num_lines(chip_));
        close();
        return Unexpected(Error::kIo);
      }
      if (gpiod_line_is_used(line)) {
        const char* const user = gpiod_line_consumer(line);
        message = "line '" + name + "' is used by " +
                  (user == nullptr ? std::string("the kernel") : "'" + std::string(user) + "'") +
                  ", expected it free";
        close();
        return Unexpected(Error::kIo);
      }
      gpiod_line_bulk_add(&lines_, line);
    }
    const std::array<int, kMostLines> dark{};
    const int flags = settings.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
    if (gpiod_line_request_bulk_output_flags(&lines_, kConsumer, flags, dark.data()) != 0) {
      message = std::string("does not give its lines: ") + std::strerror(errno);
      close();
      return Unexpected(Error::kIo);
    }
    taken_ = true;
    return {};
  }

  void close() override {
    if (taken_) {
      gpiod_line_release_bulk(&lines_);
    }
    taken_ = false;
    if (chip_ != nullptr) {
      gpiod_chip_close(chip_);
    }
    chip_ = nullptr;
  }

  int set(std::uint32_t lit) override {
    std::array<int, kMostLines> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<int>(lit >> i & 1);
    }
    return gpiod_line_set_value_bulk(&lines_, values.data()) == 0 ? 0 : -errno;
  }

 private:
  gpiod_chip* chip_ = nullptr;
  gpiod_line_bulk lines_{};
  bool taken_ = false;
};

std::string text_of(const char* text) { return text == nullptr ? std::string() : text; }

}  // namespace

std::unique_ptr<LineBank> make_gpiod_line_bank() { return std::make_unique<Gpiod1LineBank>(); }

std::vector<GpioChip> list_gpio_chips() {
  std::vector<GpioChip> chips;
  gpiod_chip_iter* const all = gpiod_chip_iter_new();
  if (all == nullptr) {
    return chips;
  }
  for (gpiod_chip* chip = gpiod_chip_iter_next(all); chip != nullptr;
       chip = gpiod_chip_iter_next(all)) {
    GpioChip found;
    found.name = gpiod_chip_name(chip);
    found.label = gpiod_chip_label(chip);
    for (unsigned int i = 0; i < gpiod_chip_num_lines(chip); ++i) {
      GpioChip::Line told;
      if (gpiod_line* const line = gpiod_chip_get_line(chip, i); line != nullptr) {
        told.name = text_of(gpiod_line_name(line));
        const std::string user = text_of(gpiod_line_consumer(line));
        told.user = !gpiod_line_is_used(line) ? "" : user.empty() ? "the kernel" : user;
      }
      found.lines.push_back(told);
    }
    chips.push_back(found);
  }
  gpiod_chip_iter_free(all);
  return chips;
}

}  // namespace tubesight::drivers
