#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdlib.h>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "drivers/modbus/crc16.h"
#include "hal/clock.h"
#include "hal/robot_link.h"

namespace tubesight::tests {

using Bytes = std::vector<std::uint8_t>;

/// The clock of the PC.
class SteadyClock final : public hal::Clock {
 public:
  [[nodiscard]] core::FieldTime now() const override {
    return std::chrono::steady_clock::now().time_since_epoch();
  }
};

/// A clock that the test moves while the link's thread reads it.
class SharedClock final : public hal::Clock {
 public:
  void set(core::FieldTime now) { now_ns_ = now.count(); }
  [[nodiscard]] core::FieldTime now() const override { return core::FieldTime(now_ns_); }

 private:
  std::atomic<std::int64_t> now_ns_{0};
};

/// A pseudo terminal: the kernel's own serial line without a wire. What is written to it comes out
/// of the device with its name.
class Pty {
 public:
  Pty() : descriptor_(posix_openpt(O_RDWR | O_NOCTTY)) {
    EXPECT_EQ(grantpt(descriptor_), 0);
    EXPECT_EQ(unlockpt(descriptor_), 0);
    device_ = ptsname(descriptor_);
    // Until the device is opened and set, it would echo.
    termios raw{};
    cfmakeraw(&raw);
    tcsetattr(descriptor_, TCSANOW, &raw);
  }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;
  ~Pty() { unplug(); }

  void unplug() {
    if (descriptor_ >= 0) {
      close(std::exchange(descriptor_, -1));
    }
  }
  [[nodiscard]] const std::string& device() const { return device_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Sends all, waiting where the box is slower.
  void send(const Bytes& bytes) const {
    std::size_t sent = 0;
    for (int attempt = 0; attempt < 1000 && sent < bytes.size(); ++attempt) {
      const ssize_t count = write(descriptor_, bytes.data() + sent, bytes.size() - sent);
      sent += count > 0 ? static_cast<std::size_t>(count) : 0;
      if (sent < bytes.size()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    EXPECT_EQ(sent, bytes.size());
  }
  /// What comes until nothing has come for so long.
  [[nodiscard]] Bytes receive(std::chrono::milliseconds patience) const {
    Bytes got;
    pollfd entry{descriptor_, POLLIN, 0};
    while (poll(&entry, 1, static_cast<int>(patience.count())) > 0) {
      Bytes chunk(256);
      const ssize_t count = read(descriptor_, chunk.data(), chunk.size());
      if (count <= 0) {
        break;
      }
      got.insert(got.end(), chunk.begin(), chunk.begin() + count);
      patience = std::chrono::milliseconds(5);
    }
    return got;
  }

 private:
  int descriptor_;
  std::string device_;
};

/// Two pseudo terminals wired to each other, for programs that want a device at either end.
class PtyPair {
 public:
  PtyPair() {
    thread_ = std::thread([this] {
      std::vector<pollfd> ends{{box.descriptor(), POLLIN, 0}, {robot.descriptor(), POLLIN, 0}};
      while (!done_) {
        poll(ends.data(), 2, 10);
        copy(ends[0], robot);
        copy(ends[1], box);
      }
    });
  }
  PtyPair(const PtyPair&) = delete;
  PtyPair& operator=(const PtyPair&) = delete;
  ~PtyPair() {
    done_ = true;
    thread_.join();
  }

  Pty box;
  Pty robot;

 private:
  static void copy(const pollfd& from, const Pty& to) {
    std::uint8_t bytes[256];
    if ((from.revents & POLLIN) != 0) {
      const ssize_t count = read(from.fd, bytes, sizeof bytes);
      if (count > 0) {
        EXPECT_EQ(write(to.descriptor(), bytes, static_cast<std::size_t>(count)), count);
      }
    } else if ((from.revents & POLLHUP) != 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // nobody has opened that end
    }
  }

  std::atomic<bool> done_{false};
  std::thread thread_;
};

/// A request or an answer with its unit and its check sum.
inline Bytes rtu_frame(std::uint8_t unit, const Bytes& pdu) {
  Bytes frame;
  frame.reserve(pdu.size() + 3);
  frame.push_back(unit);
  for (const std::uint8_t byte : pdu) {
    frame.push_back(byte);
  }
  const std::uint16_t crc = drivers::crc16(frame);
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  return frame;
}

/// A master of Modbus RTU, written for the tests: asks unit 17 and gives the answer without unit
/// and check sum; empty: none came.
inline Bytes ask(const Pty& line, const Bytes& request,
                 std::chrono::milliseconds patience = std::chrono::milliseconds(1000)) {
  line.send(rtu_frame(17, request));
  const Bytes frame = line.receive(patience);
  if (frame.size() < 4) {
    return {};
  }
  EXPECT_EQ(drivers::crc16(frame), 0);
  EXPECT_EQ(frame[0], 17);
  return {frame.begin() + 1, frame.end() - 2};
}

/// 32 bits, high byte first.
inline std::uint32_t long_at(const Bytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | bytes.at(at + i);
  }
  return value;
}

/// The loop's thread: takes the robot's events and answers them, and does what a field brings.
class AnsweringLoop {
 public:
  using Answer = std::function<void(hal::RobotLink&, const core::Event&)>;

  AnsweringLoop(
      hal::RobotLink& link, Answer answer, std::function<void()> turn = [] {})
      : thread_([this, &link, answer = std::move(answer), turn = std::move(turn)] {
          while (!done_) {
            turn();
            const auto polled = link.poll_event();
            if (polled && polled->has_value()) {
              answer(link, **polled);
            } else {
              std::this_thread::sleep_for(std::chrono::microseconds(500));
            }
          }
        }) {}
  AnsweringLoop(const AnsweringLoop&) = delete;
  AnsweringLoop& operator=(const AnsweringLoop&) = delete;
  ~AnsweringLoop() {
    done_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> done_{false};
  std::thread thread_;
};

/// Vouches for tube (12, -7) and nothing else.
inline void vouch(hal::RobotLink& link, const core::Event& event) {
  const auto* const claim = core::content_if<core::Claim>(event);
  if (claim == nullptr) {
    return;
  }
  constexpr core::TubeAddress kTube{12, -7};
  core::Reply reply;
  reply.id = event.id;
  reply.content = core::ClaimReply{
      claim->tube,
      claim->tube == kTube ? core::ClaimVerdict::kConfirmed : core::ClaimVerdict::kContradicted,
      core::ClaimDoubt::kNone, kTube, 3601};
  EXPECT_TRUE(link.send_reply(reply));
}

}  // namespace tubesight::tests
