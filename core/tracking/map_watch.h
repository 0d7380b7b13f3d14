#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/tube_address.h"
#include "core/tracking/field_measurement.h"

namespace tubesight::core::tracking {

/// Tells from what the settings say of plugs and voids that the addresses are wrong, or the
/// settings another sheet's.
///
/// Counts the sites that should be closed and look like open tube-ends: three are too many, one or
/// two may be a plug that fell out or a list that is out of date. A site counts after two fields
/// more in which it looked open than closed, and while it was seen in one of the last sixty: a long
/// way passes many. Holds eight addresses, more than it takes. Where fewer are in view, the pattern
/// of all may still fit other addresses (fits_other_addresses()): asked in each eighth field, and
/// believed when it says so twice in a row.
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

  /// Whether it is time to ask whether the field fits other addresses. Call once a field believed.
  [[nodiscard]] bool asks();
  /// The answer.
  void take_answer(bool fits_others) { for_others_ = fits_others ? for_others_ + 1 : 0; }

  /// The addresses are wrong.
  [[nodiscard]] bool refuted() const;

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [entries, fields, for_others] = self;
    for (auto& entry : entries) {
      stream(entry);
    }
    stream.number(fields, 0, kAskEvery);
    stream.number(for_others, 0, 1 << 30);
  }

 private:
  static constexpr std::int32_t kMostOpen = 3;
  static constexpr std::int8_t kOpen = 2;
  static constexpr std::int8_t kMost = 4;
  static constexpr std::int8_t kRemembered = 60;  ///< fields
  static constexpr std::int32_t kAskEvery = 8;
  static constexpr std::int32_t kAnswers = 2;

  struct Entry {
    TubeAddress address{};
    std::int8_t score = 0;   ///< 0: the entry is free
    std::int8_t unseen = 0;  ///< fields since it was seen

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [tube, points, fields_unseen] = self;
      stream(tube);
      stream.number(points, std::int8_t{0}, kMost);
      stream.number(fields_unseen, std::int8_t{0}, kRemembered);
    }
  };
  [[nodiscard]] Entry* find(TubeAddress address);

  std::array<Entry, 8> entries_{};
  std::int32_t fields_ = 0;      ///< since it was asked last
  std::int32_t for_others_ = 0;  ///< answers in a row that it fits others
};

}  // namespace tubesight::core::tracking
