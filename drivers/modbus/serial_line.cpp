#include "drivers/modbus/serial_line.h"

#include <cerrno>

#include <fcntl.h>
#include <linux/serial.h>
#include <modbus/modbus.h>
#include <sys/file.h>
#include <sys/ioctl.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

char letter_of(SerialParity parity) {
  switch (parity) {
    case SerialParity::kNone: return 'N';
    case SerialParity::kEven: return 'E';
    case SerialParity::kOdd: return 'O';
  }
  return 'N';
}

/// The kernel drives the direction: from user space it would come too late (libmodbus 606). Level
/// and delays that the device tree gave stay as they are.
bool set_rs485(int descriptor) {
  serial_rs485 mode{};
  if (ioctl(descriptor, TIOCGRS485, &mode) < 0) {
    return false;
  }
  if ((mode.flags & (SER_RS485_RTS_ON_SEND | SER_RS485_RTS_AFTER_SEND)) == 0) {
    mode.flags |= SER_RS485_RTS_ON_SEND;
  }
  mode.flags |= SER_RS485_ENABLED;
  mode.flags &= ~static_cast<unsigned>(SER_RS485_RX_DURING_TX);  // what is sent is no request
  return ioctl(descriptor, TIOCSRS485, &mode) == 0;
}

/// Two programs on one line answer the same requests into each other. TIOCEXCL would not keep root
/// out; whoever locks as well is kept out by this (boxes, pyserial's `exclusive`).
bool take_for_itself(int descriptor) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    return true;
  }
  errno = errno == EWOULDBLOCK ? EBUSY : errno;
  return false;
}

/// USB adapters hold back what they got, some for 16 ms, unless told not to. Others know no such
/// thing, so that a refusal means nothing.
void ask_for_low_latency(int descriptor) {
  constexpr int kLowLatency = 1 << 13;  // ASYNC_LOW_LATENCY of <linux/tty_flags.h>
  serial_struct settings{};
  if (ioctl(descriptor, TIOCGSERIAL, &settings) == 0) {
    settings.flags |= kLowLatency;
    static_cast<void>(ioctl(descriptor, TIOCSSERIAL, &settings));
  }
}

}  // namespace

Result<void> SerialLine::open(const SerialSettings& settings) {
  modbus_t* const context = modbus_new_rtu(settings.device.c_str(), settings.baud,
                                           letter_of(settings.parity), 8, settings.stop_bits);
  if (context == nullptr) {
    return Unexpected(Error::kIo);
  }
  context_ = context;
  // libmodbus opens with O_NOCTTY and O_NONBLOCK, and without a slave's address asks nobody.
  if (modbus_connect(context) != 0) {
    modbus_free(context);
    context_ = nullptr;
    return Unexpected(Error::kIo);
  }
  descriptor_ = modbus_get_socket(context);
  const int flags = fcntl(descriptor_, F_GETFL);
  if (!take_for_itself(descriptor_) || flags < 0 ||
      fcntl(descriptor_, F_SETFL, flags | O_NONBLOCK) < 0) {
    const int cause = errno;
    close();
    errno = cause;
    return Unexpected(Error::kIo);
  }
  if (settings.rs485 && !set_rs485(descriptor_)) {
    const int cause = errno;
    close();
    errno = cause;
    return Unexpected(Error::kUnsupported);
  }
  ask_for_low_latency(descriptor_);
  return {};
}

void SerialLine::close() {
  if (context_ == nullptr) {
    return;
  }
  auto* const context = static_cast<modbus_t*>(context_);
  modbus_close(context);
  modbus_free(context);
  context_ = nullptr;
  descriptor_ = -1;
}

}  // namespace tubesight::drivers
