#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/field.h"
#include "core/base/result.h"
#include "drivers/aravis/aravis_settings.h"
#include "drivers/aravis/grey_format.h"
#include "drivers/aravis/library.h"

namespace tubesight::drivers::aravis {

/// What was agreed with a camera, read back from it.
struct AgreedPicture {
  GreyFormat format;
  bool pair = false;  ///< a picture holds both fields of an interlaced frame, line by line
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::size_t bytes = 0;         ///< of the grey values
  std::size_t buffer_bytes = 0;  ///< of all that the camera sends
  core::FieldTime span{0};       ///< from one field to the next
  core::FieldTime exposure{0};
  core::FieldTime readout{0};     ///< from the end of the last exposure to the arrival
  std::int32_t packet_bytes = 0;  ///< 0: there are none

  [[nodiscard]] core::FieldTime frame() const { return pair ? 2 * span : span; }
};

/// A packet that goes through any network, tunnels and all.
inline constexpr std::int32_t kSafePacket = 1400;

/// Sets an open camera as the settings want it and reads back what became of it. `safe_packets`:
/// packets are not negotiated but as small as need be.
///
/// Errors: kUnsupported it does not have what is wanted, kIo it refused; `message` says which, what
/// it offers and what was wanted.
[[nodiscard]] core::Result<void> set_up(Device& device, const AravisSettings& settings,
                                        bool safe_packets, AgreedPicture& agreed,
                                        std::string& message);

}  // namespace tubesight::drivers::aravis
