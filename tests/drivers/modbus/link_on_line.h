#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "drivers/modbus/modbus_robot_link.h"
#include "drivers/modbus/register_table.h"
#include "tests/drivers/modbus/link_bench.h"
#include "tests/drivers/modbus/serial_robot.h"

namespace tubesight::tests {

/// Unit 17 at a line without parity, as pseudo terminals have none.
inline drivers::ModbusSettings settings_for(const std::string& device) {
  drivers::ModbusSettings settings;
  settings.serial.line.device = device;
  settings.serial.line.baud = 115'200;
  settings.serial.line.parity = drivers::SerialParity::kNone;
  settings.serial.unit = 17;
  return settings;
}

inline const Bytes kReadMark{3, 0, 2, 0, 2};
inline const Bytes kMark{3, 4, 1, 2, 3, 4};

/// A claim of (12, -7) with its verdict, function 23.
inline Bytes claim(std::uint8_t id, std::uint8_t row = 12) {
  return {23, 0, 200, 0, 24,  1,    44,   0,    8,    16, 0, 0, 0,
          id, 0, 0,   0, row, 0xFF, 0xFF, 0xFF, 0xF9, 0,  0, 0, 1};
}

/// A counter of the block health, read by the robot.
inline std::uint32_t counter_on(const Pty& line, drivers::Register name) {
  const auto address = drivers::row_of(name).address;
  const Bytes answer = ask(
      line, {3, static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address), 0, 2});
  return answer.size() == 6 ? long_at(answer, 2) : UINT32_MAX;
}

/// A link on a line, with a robot at its other end.
class LinkOnLine : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(link_.start()); }

  std::uint32_t counter(drivers::Register name) { return counter_on(line_, name); }
  void expect_answer() { EXPECT_EQ(ask(line_, kReadMark), kMark); }
  /// Sends what is no request to this unit and waits until the link has counted it: where others
  /// delay the link, the next frame would else come before the silence that ends this one.
  void expect_silence(const Bytes& frame) {
    const std::uint32_t before = disturbances();
    line_.send(frame);
    for (int i = 0; i < 2000 && disturbances() == before; ++i) {
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    EXPECT_NE(disturbances(), before) << "nothing was counted";
    EXPECT_EQ(line_.receive(std::chrono::milliseconds(10)), Bytes());
  }
  [[nodiscard]] std::uint32_t disturbances() const {
    drivers::LinkCounters now;
    while (!link_.counters(now)) {
      std::this_thread::yield();
    }
    return now.crc_errors + now.cut_frames + now.other_units + now.broadcasts + now.stray_bytes;
  }

  Pty line_;
  SteadyClock clock_;
  drivers::ModbusRobotLink link_{settings_for(line_.device()), make_identity(), clock_};
};

}  // namespace tubesight::tests
