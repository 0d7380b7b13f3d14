#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/modbus/register_table.h"

namespace tubesight::drivers {

/// Which of the two words of a value comes first; controllers differ.
enum class WordOrder : std::uint8_t { kHighFirst, kLowFirst };

/// The words of the map. Some 1 KB; no heap.
class RegisterImage {
 public:
  explicit RegisterImage(WordOrder order) : order_(order) {}

  /// Sets a value as it stands in the register, modulo its width.
  void set(Register name, std::int64_t value);

  /// Sets a value given in 1/`per_unit` of the register's unit, rounded, or "unknown" and says
  /// false when the register cannot hold it: a wrong number is worse than none.
  [[nodiscard]] bool set_scaled(Register name, std::int64_t value, std::int64_t per_unit);

  /// Sets what stands for "not known".
  void set_unknown(Register name);

  /// The value: one word is unsigned, two are signed.
  [[nodiscard]] std::int32_t get(Register name) const;

  [[nodiscard]] std::uint16_t word(std::int32_t address) const { return words_[index(address)]; }
  void set_word(std::int32_t address, std::uint16_t word) { words_[index(address)] = word; }

 private:
  static std::size_t index(std::int32_t address);

  WordOrder order_;
  std::array<std::uint16_t, static_cast<std::size_t>(kMapWords)> words_{};
};

}  // namespace tubesight::drivers
