#pragma once

#include <array>
#include <cstdint>

#include "core/base/tube_address.h"

namespace tubesight::drivers {

/// What a place of the sheet is to be corrected by, in the sheet frame.
struct ZoneAnswer {
  std::array<std::int64_t, 3> off_nm{};  ///< to be added to what the calibrated base tells
  std::int64_t across_nm = 0;            ///< one sigma along each axis of the sheet
  std::int64_t along_nm = 0;
};

/// Who knows the robot's corrections by zones.
class ZoneCorrections {
 public:
  /// The correction at a tube's centre; false where none is known (yet), or no such tube is on the
  /// drawing. Of the link's thread, within a millisecond; no heap.
  [[nodiscard]] virtual bool at(core::TubeAddress tube, ZoneAnswer& answer) const = 0;

 protected:
  ~ZoneCorrections() = default;
};

}  // namespace tubesight::drivers
