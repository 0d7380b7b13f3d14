#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace tubesight::drivers {

enum class SerialParity : std::uint8_t { kNone, kEven, kOdd };

/// A serial line as Modbus wants it: 8 bits, and by default 19,200 baud, even parity, 1 stop bit.
struct SerialSettings {
  std::string device;  ///< "/dev/ttyUSB0"; better a name below /dev/serial/by-id
  std::int32_t baud = 19'200;
  SerialParity parity = SerialParity::kEven;
  std::int32_t stop_bits = 1;
  bool rs485 = false;  ///< the kernel switches the direction
};

/// An open serial line; libmodbus opens and sets it. One thread.
class SerialLine {
 public:
  SerialLine() = default;
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;
  ~SerialLine() { close(); }

  /// Opens the device, without waiting; needs it closed. It does not become the controlling
  /// terminal. kIo: it cannot be opened or set so, or another program has locked it; kUnsupported:
  /// its driver cannot switch the direction of RS-485; errno says more.
  [[nodiscard]] core::Result<void> open(const SerialSettings& settings);
  void close();

  [[nodiscard]] bool is_open() const { return context_ != nullptr; }
  /// For poll(), read() and write(), none of which waits; -1: closed.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  void* context_ = nullptr;  ///< of libmodbus, whose header stays in the source
  int descriptor_ = -1;
};

}  // namespace tubesight::drivers
