#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/static_vector.h"
#include "core/base/tube_address.h"

namespace tubesight::core::tracking {

/// Remembers the sites that the settings list as open and that never once looked like a tube-end:
/// voids and plugs that nobody listed. Under them nothing is vouched for.
///
/// A tube-end may look closed later, behind the guidetube or under a glare: so those in view that
/// have looked like one are remembered, too, for as long as there is room. Holds 64 of these, more
/// than are measured in a window, and 32 that were closed alone; of more, those nearest to
/// the tool.
class SiteMemory {
 public:
  /// A new start.
  void begin() { *this = {}; }

  /// A field that is believed shows a tube-end there.
  void saw_tube_end(TubeAddress address);
  /// It shows the site darker than what is around it, and no rim of the plane: a plug may be so.
  void saw_dark(TubeAddress address) { static_cast<void>(is_known(short_of(address))); }
  /// It shows it bright, or as dark as what is around it, which plate is in the light of LEDs
  /// alone. `clear`: nothing can stand before it. `tool`: whereabouts the tool is.
  void saw_closed(TubeAddress address, bool clear, TubeAddress tool);
  /// All sites of the field are told.
  void end_field();

  /// Whether nothing is known that speaks against a tube-end there.
  [[nodiscard]] bool vouches_for(TubeAddress address) const {
    return !has(closed_, short_of(address));
  }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [known, closed, in_view] = self;  // the last is of one field
    stream(known, closed);
  }

 private:
  // Addresses have four digits in the settings.
  struct Short {
    std::int16_t row = 0;
    std::int16_t column = 0;

    friend bool operator==(const Short&, const Short&) = default;

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [r, c] = self;
      stream.number(r, std::int16_t{-32768}, std::int16_t{32767});
      stream.number(c, std::int16_t{-32768}, std::int16_t{32767});
    }
  };
  static Short short_of(TubeAddress address) {
    return {static_cast<std::int16_t>(address.row), static_cast<std::int16_t>(address.column)};
  }
  template <typename List>
  static bool has(const List& list, Short site) {
    return std::find(list.begin(), list.end(), site) != list.end();
  }
  [[nodiscard]] bool is_known(Short site);

  StaticVector<Short, 64> known_;   ///< that have looked like tube-ends
  StaticVector<Short, 32> closed_;  ///< never looked like one
  std::uint64_t in_view_ = 0;       ///< in this field: bit n is known_[n]
};

}  // namespace tubesight::core::tracking
