#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/tube_address.h"

namespace tubesight::core::tracking {

/// Remembers tube-ends that looked like plugs though no list names them [Fallon 6.5].
///
/// A tube counts as plugged after three sightings more as a plug than as an open tube-end. Holds 64
/// addresses, more than a window shows; a new one replaces the weakest.
class PlugMemory {
 public:
  void clear() {
    entries_ = {};
    used_ = 0;
  }

  /// Notes that the tube looked like a plug in this field.
  void saw_plug(TubeAddress address);
  /// Notes that it was measured as an open tube-end.
  void saw_open(TubeAddress address);
  /// Whether it counts as plugged.
  [[nodiscard]] bool is_plug(TubeAddress address) const;

 private:
  struct Entry {
    TubeAddress address{};
    std::int8_t score = 0;
  };
  [[nodiscard]] std::array<Entry, 64>::iterator end() {
    return entries_.begin() + static_cast<std::ptrdiff_t>(used_);
  }

  static constexpr std::int8_t kPlugged = 3;
  static constexpr std::int8_t kMost = 12;

  std::array<Entry, 64> entries_{};
  std::size_t used_ = 0;  ///< entries from here on were never written
};

}  // namespace tubesight::core::tracking
