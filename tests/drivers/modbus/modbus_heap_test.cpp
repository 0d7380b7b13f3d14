// A robot that polls and claims makes neither the loop's thread nor the link's ask for memory.

#include <array>

#include <gtest/gtest.h>

#include "drivers/modbus/modbus_robot_link.h"
#include "tests/drivers/modbus/link_bench.h"
#include "tests/drivers/modbus/serial_robot.h"
#include "tests/support/heap_guard.h"

namespace tubesight::tests {
namespace {

/// Sends a frame and counts the bytes that come, without memory of its own.
std::size_t exchange(const Pty& line, const Bytes& frame, std::size_t expected) {
  std::array<std::uint8_t, 256> got{};
  std::size_t count = 0;
  pollfd entry{line.descriptor(), POLLIN, 0};
  if (write(line.descriptor(), frame.data(), frame.size()) != std::ssize(frame)) {
    return 0;
  }
  while (count < expected && poll(&entry, 1, 1000) > 0) {
    const ssize_t more = read(line.descriptor(), got.data() + count, got.size() - count);
    count += more > 0 ? static_cast<std::size_t>(more) : 0;
  }
  return count;
}

/// Until so many cut frames were counted: a line that others delay joins the next frame to one.
void wait_for_silence_after_cut_frame(const drivers::ModbusRobotLink& link, std::uint32_t frames) {
  drivers::LinkCounters counters;
  for (int i = 0; i < 2000 && (!link.counters(counters) || counters.cut_frames < frames); ++i) {
    usleep(500);
  }
}

TEST(ModbusHeap, IsNotTouchedByRequests) {
  const Pty line;
  const SteadyClock clock;
  drivers::ModbusSettings settings;
  settings.serial.line.device = line.device();
  settings.serial.unit = 17;
  drivers::ModbusRobotLink link(settings, make_identity(), clock);
  ASSERT_TRUE(link.start());
  const Bytes poll_frame = rtu_frame(17, {3, 0, 100, 0, 52});
  const Bytes claim_frame =
      rtu_frame(17, {16, 1, 44, 0, 8, 16, 0, 0, 0, 9, 0, 0, 0, 12, 0, 0, 0, 7, 0, 0, 0, 1});
  const Bytes garbled{17, 3, 0, 1};

  std::size_t bytes = 0;
  int claims = 0;
  HeapCalls calls;
  {
    const HeapGuard guard;
    for (unsigned i = 0; i < 50; ++i) {
      bytes += exchange(line, poll_frame, 109) + exchange(line, claim_frame, 8);
      bytes += exchange(line, garbled, 0);
      wait_for_silence_after_cut_frame(link, i + 1U);
      const auto polled = link.poll_event();
      const auto event = polled ? polled : link.poll_event();  // after the garbled one
      claims += event && event->has_value() ? 1 : 0;
      core::Reply reply;
      reply.content = core::ClaimReply{};
      bytes += link.send_reply(reply) && link.send_sighting({}) ? 0U : 1U;
    }
    calls = guard.calls();
  }

  EXPECT_EQ(bytes, 50u * (109 + 8));
  EXPECT_EQ(claims, 50);
  EXPECT_EQ(calls.allocations, 0);
  EXPECT_EQ(calls.releases, 0);
}

}  // namespace
}  // namespace tubesight::tests
