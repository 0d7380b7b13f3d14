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

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [entries, used] = self;
    auto count = static_cast<std::uint32_t>(used);
    stream.number(count, 0, static_cast<std::uint32_t>(entries.size()));
    if constexpr (Stream::kReads) {
      used = count;
    }
    // In shape all: what is used differs from state to state.
    const std::size_t end = Stream::kShape ? entries.size() : used;
    for (std::size_t i = 0; i < end; ++i) {
      stream(entries[i]);
    }
  }

 private:
  static constexpr std::int8_t kPlugged = 3;
  static constexpr std::int8_t kMost = 12;

  struct Entry {
    TubeAddress address{};
    std::int8_t score = 0;

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [tube, points] = self;
      stream(tube);
      stream.number(points, std::int8_t{-kMost}, kMost);
    }
  };
  [[nodiscard]] std::array<Entry, 64>::iterator end() {
    return entries_.begin() + static_cast<std::ptrdiff_t>(used_);
  }

  std::array<Entry, 64> entries_{};
  std::size_t used_ = 0;  ///< entries from here on were never written
};

}  // namespace tubesight::core::tracking
