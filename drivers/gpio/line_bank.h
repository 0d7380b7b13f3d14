#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace tubesight::drivers {

/// Lines of a GPIO chip that drive a lamp.
struct LineBankSettings {
  std::string chip;                ///< by its label, which stays: "pinctrl-bcm2711"; or a path
  std::vector<std::string> lines;  ///< by number or name: "18", "GPIO18"; 1 to kMostLines
  bool active_low = false;         ///< the lamp shines while a line is low
};

inline constexpr std::int32_t kMostLines = 8;

/// A GPIO chip as the system knows it.
struct GpioChip {
  std::string name;   ///< "gpiochip0", which may change from one start to the next
  std::string label;  ///< what settings should name
  struct Line {
    std::string name;  ///< may be empty
    std::string user;  ///< who has it; empty: it is free
  };
  std::vector<Line> lines;
};

/// Output lines by the library at hand: where the versions of libgpiod differ, and where tests put
/// lines of their own. One thread at a time, but for set(0), which may come from another while one
/// sets.
class LineBank {
 public:
  virtual ~LineBank() = default;

  /// Takes the lines, all dark. Errors: kIo, with what is wrong in `message`.
  [[nodiscard]] virtual core::Result<void> open(const LineBankSettings& settings,
                                                std::string& message) = 0;

  /// Gives them back; what they do then is the chip's business.
  virtual void close() = 0;

  /// Line i shines where bit i is 1. No heap. Gives 0 or -errno.
  [[nodiscard]] virtual int set(std::uint32_t lit) = 0;
};

/// By libgpiod.
[[nodiscard]] std::unique_ptr<LineBank> make_gpiod_line_bank();

/// The chips of this machine. Takes no line.
[[nodiscard]] std::vector<GpioChip> list_gpio_chips();

}  // namespace tubesight::drivers
