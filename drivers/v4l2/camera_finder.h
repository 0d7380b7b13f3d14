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
  std::string refused;  ///< why it could not be opened: nothing but its name is known
  bool taken = false;   ///< another program takes its pictures
  bool alone = true;    ///< no other one has its serial number
  std::vector<std::string> inputs;
  std::string standard;                ///< "NTSC": the one that is set
  std::vector<std::string> standards;  ///< that its inputs know
  std::vector<std::string> formats;    ///< "GREY 640 x 480"; those of the input chosen
  std::vector<std::string> controls;   ///< by their names

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

/// Why a node could not be opened, by open()'s -errno, for a person.
[[nodiscard]] std::string words_of_refusal(int status);

/// What a driver says in a field of fixed length, printable ASCII alone.
[[nodiscard]] std::string text_of(const unsigned char* letters, std::size_t length);

}  // namespace tubesight::drivers::v4l2
