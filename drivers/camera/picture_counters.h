#pragma once

#include <cstdint>

namespace tubesight::drivers {

/// What cameras of all buses have come to since their first start; nothing is ever reset.
struct PictureCounters {
  std::int64_t buffers = 0;           ///< taken from the driver or library
  std::int64_t lost_fields = 0;       ///< missing by the camera's counter
  std::int64_t without_stamp = 0;     ///< pictures without a stamp to go by
  std::int64_t counter_back = 0;      ///< times that the camera's counter went back
  std::int64_t counter_repeated = 0;  ///< pictures with the number of the one before
  std::int64_t noise = 0;             ///< fields of snow
  std::int64_t blank = 0;             ///< fields of one grey that is not black
  std::int64_t black = 0;             ///< fields of black alone
  std::int64_t silences = 0;          ///< times that nothing came for too long
};

}  // namespace tubesight::drivers
