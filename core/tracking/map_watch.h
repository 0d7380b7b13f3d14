#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/tube_address.h"
#include "core/tracking/field_measurement.h"

namespace tubesight::core::tracking {

/// Counts the sites that are closed by the settings, plugged or without a tube, and look like open
/// tube-ends: where three do, the addresses are wrong, or the settings are another sheet's.
///
/// One or two may be a plug that fell out or a list that is out of date. A site counts after two
/// fields more in which it looked open than closed. Holds eight addresses, more than it takes.
class MapWatch {
 public:
  /// Of one field alone, a start's: enough where it shows as much.
  [[nodiscard]] static bool refuted_by(const SiteSightings& sites) {
    return sites.open.size() >= kMostOpen;
  }

  /// A new start: other addresses.
  void begin() { *this = {}; }

  /// What a field that is believed shows.
  void see(const SiteSightings& sites);

  /// Too many sites are open that should be closed.
  [[nodiscard]] bool refuted() const;

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [entries] = self;
    for (auto& entry : entries) {
      stream(entry);
    }
  }

 private:
  static constexpr std::int32_t kMostOpen = 3;
  static constexpr std::int8_t kOpen = 2;
  static constexpr std::int8_t kMost = 4;

  struct Entry {
    TubeAddress address{};
    std::int8_t score = 0;  ///< 0: the entry is free

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [tube, points] = self;
      stream(tube);
      stream.number(points, std::int8_t{0}, kMost);
    }
  };
  [[nodiscard]] Entry* find(TubeAddress address);

  std::array<Entry, 8> entries_{};
};

}  // namespace tubesight::core::tracking
