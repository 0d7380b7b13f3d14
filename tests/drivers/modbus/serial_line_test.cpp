// The line on a kernel of which a part is faked: what a pseudo terminal does not have, RS-485 and
// the settings of a UART, is taken by the ioctl() below; all else goes to the kernel.

#include "drivers/modbus/serial_line.h"

#include <cstdarg>
#include <optional>

#include <linux/serial.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>

#include "tests/drivers/modbus/serial_robot.h"

namespace tubesight::tests {
namespace {

struct FakeUart {
  std::optional<serial_rs485> rs485;      ///< empty: its driver has none
  std::optional<serial_struct> settings;  ///< as above
};
FakeUart uart;

int take(std::optional<serial_rs485>& part, bool set, void* argument) {
  if (!part) {
    errno = ENOTTY;
    return -1;
  }
  auto* const told = static_cast<serial_rs485*>(argument);
  (set ? *part : *told) = set ? *told : *part;
  return 0;
}

int take(std::optional<serial_struct>& part, bool set, void* argument) {
  if (!part) {
    errno = ENOTTY;
    return -1;
  }
  auto* const told = static_cast<serial_struct*>(argument);
  (set ? *part : *told) = set ? *told : *part;
  return 0;
}

}  // namespace
}  // namespace tubesight::tests

extern "C" int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  using tubesight::tests::take;
  using tubesight::tests::uart;
  switch (request) {
    case TIOCGRS485: return take(uart.rs485, false, argument);
    case TIOCSRS485: return take(uart.rs485, true, argument);
    case TIOCGSERIAL: return take(uart.settings, false, argument);
    case TIOCSSERIAL: return take(uart.settings, true, argument);
    default: return static_cast<int>(syscall(SYS_ioctl, descriptor, request, argument));
  }
}

namespace tubesight::tests {
namespace {

using drivers::SerialLine;
using drivers::SerialSettings;

SerialSettings settings_for(const Pty& pty) {
  SerialSettings settings;
  settings.device = pty.device();
  return settings;
}

TEST(SerialLine, LetsTheKernelSwitchRs485) {
  const Pty pty;
  uart = {serial_rs485{}, std::nullopt};
  uart.rs485->flags = SER_RS485_RX_DURING_TX;
  uart.rs485->delay_rts_before_send = 3;
  SerialSettings settings = settings_for(pty);
  settings.rs485 = true;
  SerialLine line;

  ASSERT_TRUE(line.open(settings));

  EXPECT_EQ(uart.rs485->flags, unsigned{SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND});
  EXPECT_EQ(uart.rs485->delay_rts_before_send, 3u) << "as the board has it";
}

TEST(SerialLine, KeepsTheLevelThatTheBoardHas) {
  const Pty pty;
  uart = {serial_rs485{}, std::nullopt};
  uart.rs485->flags = SER_RS485_RTS_AFTER_SEND;
  SerialSettings settings = settings_for(pty);
  settings.rs485 = true;
  SerialLine line;

  ASSERT_TRUE(line.open(settings));

  EXPECT_EQ(uart.rs485->flags, unsigned{SER_RS485_ENABLED | SER_RS485_RTS_AFTER_SEND});
}

TEST(SerialLine, IsClosedWhereRs485CannotBeSwitched) {
  const Pty pty;
  uart = {};
  SerialSettings settings = settings_for(pty);
  settings.rs485 = true;
  SerialLine line;

  const auto opened = line.open(settings);

  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error(), core::Error::kUnsupported);
  EXPECT_FALSE(line.is_open());
  EXPECT_EQ(line.descriptor(), -1);
  settings.rs485 = false;
  EXPECT_TRUE(line.open(settings));
}

TEST(SerialLine, BelongsToOneProgramAtATime) {
  const Pty pty;
  uart = {};
  SerialSettings settings = settings_for(pty);
  settings.parity = drivers::SerialParity::kNone;
  SerialLine first;
  SerialLine second;
  ASSERT_TRUE(first.open(settings));

  const auto opened = second.open(settings);
  const int cause = errno;

  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error(), core::Error::kIo);
  EXPECT_EQ(cause, EBUSY) << "so that it can be told";
  first.close();
  EXPECT_TRUE(second.open(settings));
}

TEST(SerialLine, AsksAdaptersNotToHoldBack) {
  const Pty pty;
  uart = {std::nullopt, serial_struct{}};
  SerialLine line;

  ASSERT_TRUE(line.open(settings_for(pty)));

  EXPECT_EQ(uart.settings->flags, 1 << 13);
}

TEST(SerialLine, SetsTheLineAndNeverWaits) {
  const Pty pty;
  uart = {};
  SerialSettings settings = settings_for(pty);
  settings.baud = 9600;
  settings.stop_bits = 2;
  SerialLine line;

  ASSERT_TRUE(line.open(settings));

  termios set{};
  ASSERT_EQ(tcgetattr(line.descriptor(), &set), 0);
  EXPECT_EQ(cfgetospeed(&set), speed_t{B9600});
  EXPECT_EQ(cfgetispeed(&set), speed_t{B9600});
  EXPECT_NE(set.c_cflag & CSTOPB, 0u);
  EXPECT_EQ(set.c_cflag & CSIZE, tcflag_t{CS8});
  EXPECT_EQ(set.c_lflag & (ICANON | ECHO | ISIG), 0u);
  EXPECT_EQ(set.c_iflag & (ICRNL | INLCR | IGNCR | IXON | IXOFF | ISTRIP), 0u);
  EXPECT_EQ(set.c_oflag & OPOST, 0u);
  EXPECT_NE(fcntl(line.descriptor(), F_GETFL) & O_NONBLOCK, 0);
}

TEST(SerialLine, SaysWhatCannotBeOpened) {
  uart = {};
  SerialSettings settings;
  settings.device = "/dev/no-such-line";
  SerialLine line;

  const auto opened = line.open(settings);

  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error(), core::Error::kIo);
  line.close();
}

}  // namespace
}  // namespace tubesight::tests
