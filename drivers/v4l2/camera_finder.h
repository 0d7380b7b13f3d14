#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/v4l2/kernel.h"

namespace tubesight::drivers::v4l2 {

/// A camera as the system knows it; what is not known is empty.
struct CameraInfo {
  std::string node;     ///< "/dev/video0": another one after the next start
  std::string by_id;    ///< a path below /dev/v4l/by-id that leads to it
  std::string by_path;  ///< the same below /dev/v4l/by-path
  std::string bus;      ///< "usb-0000:00:14.0-1", as the driver says
  std::string serial;
  std::string card;  ///< what the driver calls it
  std::string driver;
  bool busy = false;  ///< it could not be opened: nothing but its name is known
  bool alone = true;  ///< no other one has its serial number
  std::vector<std::string> inputs;
  std::vector<std::string> formats;  ///< "GREY 640 x 480"; those of the input chosen

  /// How settings should name it.
  [[nodiscard]] std::string name() const;
  /// The place where it is plugged in, as settings may name it.
  [[nodiscard]] std::string place() const;
};

/// The cameras of the machine, with what they offer. Opens each, and changes nothing.
[[nodiscard]] std::vector<CameraInfo> list_cameras(Kernel& kernel);

/// The nodes of the device that settings name: below /dev, "bus:" or "serial:". Of several nobody
/// can tell which is meant: makers give all their cameras one number, and a camera may have two
/// sensors with pictures each.
[[nodiscard]] std::vector<std::string> find_cameras(Kernel& kernel, const std::string& device);

/// The serial number of the device behind a node; empty when it has none.
[[nodiscard]] std::string serial_of(Kernel& kernel, const std::string& node);

/// What a driver says in a field of fixed length, printable ASCII alone.
[[nodiscard]] std::string text_of(const unsigned char* letters, std::size_t length);

}  // namespace tubesight::drivers::v4l2
