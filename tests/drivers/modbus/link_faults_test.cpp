// Each fault that the document of the link tells of, injected on a line: the box is silent or
// refuses, the fault's own counter tells, and the next sound request is answered.

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/drivers/modbus/link_on_line.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using tests::ask;
using tests::Bytes;
using tests::claim;
using tests::kMark;
using tests::kReadMark;
using tests::long_at;
using tests::Pty;
using tests::rtu_frame;
using tests::settings_for;
using namespace std::chrono_literals;

class LinkFaults : public tests::LinkOnLine {
 protected:
  /// The block, whole.
  [[nodiscard]] Bytes health() const {
    Bytes block = ask(line_, {3, 500 >> 8, 500 & 0xFF, 0, 42});
    EXPECT_EQ(block.size(), 86U);
    block.resize(86);
    return block;
  }
  /// A counter in it.
  static std::uint32_t in(const Bytes& health, Register name) {
    return long_at(health, 2 + 2 * (row_of(name).address - 500U));
  }
};

/// Counters that a fault moves; the others must stand.
constexpr Register kFaultCounters[] = {
    Register::kExceptions, Register::kCrcErrors,     Register::kCutFrames,
    Register::kOtherUnits, Register::kBroadcasts,    Register::kStrayBytes,
    Register::kLateClaims, Register::kDroppedEvents, Register::kAbandonedAnswers};

struct Fault {
  const char* name;
  Bytes frame;
  Register counts;
  Bytes answer;  ///< empty: silence
};

Bytes wrong_check_sum() {
  Bytes frame = rtu_frame(17, kReadMark);
  frame[4] ^= 8;
  return frame;
}

/// A whole frame of 256 bytes and more to come.
Bytes too_long() {
  Bytes pdu{99};
  pdu.resize(300, 0x5A);
  return rtu_frame(17, pdu);
}

std::vector<Fault> faults() {
  const auto refusal = [](std::uint8_t function, std::uint8_t code) {
    return rtu_frame(17, {static_cast<std::uint8_t>(function | 0x80), code});
  };
  return {
      {"wrong check sum", wrong_check_sum(), Register::kCrcErrors, {}},
      {"cut after the address", {17}, Register::kCutFrames, {}},
      {"cut in the middle", {17, 3, 0}, Register::kCutFrames, {}},
      {"cut before the check sum", {17, 3, 0, 2, 0, 2, 0x67}, Register::kCutFrames, {}},
      {"another unit", rtu_frame(5, kReadMark), Register::kOtherUnits, {}},
      {"broadcast", rtu_frame(0, {6, 1, 74, 2, 128}), Register::kBroadcasts, {}},
      {"a read of all units", rtu_frame(0, kReadMark), Register::kBroadcasts, {}},
      {"no such function", rtu_frame(17, {99, 0, 0}), Register::kExceptions, refusal(99, 1)},
      {"out of the map", rtu_frame(17, {3, 0, 99, 0, 1}), Register::kExceptions, refusal(3, 2)},
      {"of two blocks", rtu_frame(17, {4, 0, 15, 0, 90}), Register::kExceptions, refusal(4, 2)},
      {"beyond the last", rtu_frame(17, {3, 0xFF, 0xFF, 0, 2}), Register::kExceptions,
       refusal(3, 2)},
      {"not to be written", rtu_frame(17, {6, 0, 100, 0, 1}), Register::kExceptions, refusal(6, 2)},
      {"no registers", rtu_frame(17, {3, 0, 100, 0, 0}), Register::kExceptions, refusal(3, 3)},
      {"126 registers", rtu_frame(17, {3, 0, 100, 0, 126}), Register::kExceptions, refusal(3, 3)},
      {"a length that lies", rtu_frame(17, {16, 1, 44, 0, 2, 4, 0, 0}), Register::kExceptions,
       refusal(16, 3)},
      {"a level too high", rtu_frame(17, {6, 1, 74, 3, 233}), Register::kExceptions, refusal(6, 3)},
      {"a claim too old", rtu_frame(17, {6, 1, 50, 39, 17}), Register::kExceptions, refusal(6, 3)},
  };
}

TEST_F(LinkFaults, EachMovesItsOwnCounterAndTheNextRequestIsAnswered) {
  for (const Fault& fault : faults()) {
    SCOPED_TRACE(fault.name);
    const Bytes before = health();

    if (fault.answer.empty()) {
      expect_silence(fault.frame);
    } else {
      line_.send(fault.frame);
      EXPECT_EQ(line_.receive(1000ms), fault.answer);
    }
    expect_answer();

    const Bytes after = health();
    for (const Register name : kFaultCounters) {
      EXPECT_EQ(in(after, name), in(before, name) + (name == fault.counts ? 1 : 0))
          << row_of(name).label;
    }
  }
  const auto event = link_.poll_event();
  EXPECT_TRUE(!event || !*event) << "nothing of it was taken for a claim or a command";
}

TEST_F(LinkFaults, AFrameWithoutAnEndIsCounted) {
  expect_silence(too_long());
  expect_answer();

  EXPECT_GT(counter(Register::kStrayBytes) + counter(Register::kCrcErrors), 0U);
}

TEST_F(LinkFaults, NoiseIsCountedAndNeverAnEvent) {
  std::mt19937 dice(11);  // NOLINT
  for (int burst = 0; burst < 40; ++burst) {
    Bytes noise(1 + dice() % 120);
    for (std::uint8_t& byte : noise) {
      byte = static_cast<std::uint8_t>(dice());
    }
    line_.send(noise);
    EXPECT_EQ(line_.receive(12ms), Bytes());
    // Where others delay the link, the first request may come before the noise has ended for it.
    Bytes answer;
    for (int i = 0; i < 3 && answer.empty(); ++i) {
      answer = ask(line_, kReadMark, 200ms);
    }
    EXPECT_EQ(answer, kMark);
  }

  EXPECT_GT(counter(Register::kStrayBytes) + counter(Register::kCrcErrors) +
                counter(Register::kCutFrames) + counter(Register::kOtherUnits),
            20U);
  EXPECT_EQ(counter(Register::kLateClaims), 0U);
  for (int i = 0; i < 100; ++i) {
    const auto event = link_.poll_event();
    EXPECT_TRUE(!event || !*event);
  }
}

/// A dead unit's time-outs are the master's; its requests look like ours but for the unit, a claim
/// among them.
TEST_F(LinkFaults, ADeadUnitsClaimIsNobodys) {
  const tests::AnsweringLoop loop(link_, tests::vouch);
  for (std::uint8_t i = 1; i <= 10; ++i) {
    expect_silence(rtu_frame(5, claim(i, 9)));
    const Bytes own = ask(line_, claim(static_cast<std::uint8_t>(100 + i)));
    ASSERT_EQ(own.size(), 50U);
    EXPECT_EQ(long_at(own, 18), 100U + i);
    EXPECT_EQ(own[13], 1) << "AGREE to its own claim";
  }

  EXPECT_EQ(counter(Register::kOtherUnits), 10U);
  EXPECT_EQ(counter(Register::kRequests), 12U) << "the claims and these counters";
}

/// What the dead unit is asked for reaches the box with the answer that is late, of a unit that is
/// slow: neither is a request to the box.
TEST_F(LinkFaults, ALateAnswerOfANeighbourIsNotMistaken) {
  Bytes late{3, 50};  // it carries a request to the box among its data
  for (const std::uint8_t byte : rtu_frame(17, claim(1))) {
    late.push_back(byte);
  }
  late.resize(52, 0);
  for (int i = 0; i < 5; ++i) {
    expect_silence(rtu_frame(5, {3, 0, 0, 0, 25}));
    expect_answer();  // the master gave the neighbour up
    expect_silence(rtu_frame(5, late));
    expect_answer();
  }

  EXPECT_EQ(counter(Register::kOtherUnits), 10U);
  EXPECT_TRUE(link_.poll_event());
  EXPECT_EQ(counter(Register::kLateClaims), 0U) << "no claim was heard";
}

TEST_F(LinkFaults, AClaimThatNobodyJudgesIsAnsweredInTimeAllTheSame) {
  std::chrono::nanoseconds quickest{1s};  // of several, as others use this machine
  for (std::uint8_t i = 0; i < 5; ++i) {
    const auto before = clock_.now();
    line_.send(rtu_frame(17, claim(i)));
    pollfd entry{line_.descriptor(), POLLIN, 0};
    ASSERT_EQ(poll(&entry, 1, 1000), 1);
    quickest = std::min(quickest, clock_.now() - before);
    const Bytes answer = line_.receive(5ms);
    ASSERT_EQ(answer.size(), 53U);
    EXPECT_EQ(answer[14], 3) << "CANNOT SAY";
    EXPECT_EQ(answer[16], 100) << "no-answer";
    EXPECT_TRUE(link_.poll_event()) << "the loop listens, and says nothing";
  }

  EXPECT_GE(quickest, 50ms) << "the step that judges it is waited for";
  EXPECT_LT(quickest, 80ms) << "55 ms where nobody else uses the machine";
  EXPECT_EQ(counter(Register::kLateClaims), 5U);
}

/// A line on which a frame may pause for longer than a claim waits.
class PausingLine : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(link_.start()); }
  static ModbusSettings settings(const Pty& line) {
    ModbusSettings settings = settings_for(line.device());
    settings.serial.frame_gap = 2s;
    return settings;
  }
  core::Event wait_for_event() {
    for (int i = 0; i < 4000; ++i) {
      if (const auto polled = link_.poll_event(); polled && *polled) {
        return **polled;
      }
      std::this_thread::sleep_for(250us);
    }
    ADD_FAILURE() << "no event";
    return {};
  }

  Pty line_;
  tests::SteadyClock clock_;
  ModbusRobotLink link_{settings(line_), tests::make_identity(), clock_};
};

TEST_F(PausingLine, AVerdictIsNotSentIntoARequestThatArrives) {
  const Bytes next = rtu_frame(17, kReadMark);
  for (const std::ptrdiff_t begun : {1, 5}) {
    line_.send(rtu_frame(17, claim(1)));
    const core::Event event = wait_for_event();
    line_.send(Bytes(next.begin(), next.begin() + begun));
    tests::vouch(link_, event);

    EXPECT_EQ(line_.receive(80ms), Bytes()) << begun;
    line_.send(Bytes(next.begin() + begun, next.end()));
    EXPECT_EQ(line_.receive(1000ms), rtu_frame(17, kMark)) << begun;
  }

  EXPECT_EQ(tests::counter_on(line_, Register::kAbandonedAnswers), 2U);
  EXPECT_EQ(tests::counter_on(line_, Register::kCutFrames), 0U);
}

/// A line that can be pulled out of its place and put in again.
class PulledLine : public testing::Test {
 protected:
  void SetUp() override {
    plug_in();
    ASSERT_TRUE(link_.start());
    ASSERT_EQ(ask(*line_, kReadMark), kMark);
  }
  void plug_in() {
    line_ = std::make_unique<Pty>();
    std::filesystem::create_symlink(line_->device(), device_);
  }
  void pull_out() {
    std::filesystem::remove(device_);
    line_.reset();
    for (int i = 0; i < 400 && link_.connected(); ++i) {
      std::this_thread::sleep_for(5ms);
    }
    EXPECT_FALSE(link_.connected());
  }
  void wait_for_line() {
    for (int i = 0; i < 400 && !link_.connected(); ++i) {
      std::this_thread::sleep_for(5ms);
    }
    EXPECT_TRUE(link_.connected());
  }

  support::TemporaryFolder folder_;
  std::string device_ = folder_.path("robot");
  std::unique_ptr<Pty> line_;
  tests::SteadyClock clock_;
  ModbusRobotLink link_{settings_for(device_), tests::make_identity(), clock_};
};

TEST_F(PulledLine, NoVerdictOfBeforeIsReadAfterwards) {
  {
    const tests::AnsweringLoop loop(link_, tests::vouch);
    ASSERT_EQ(ask(*line_, claim(1))[13], 1) << "AGREE";
  }
  line_->send(rtu_frame(17, claim(2)));  // nobody judges it before the line is gone
  pull_out();
  core::Event event;
  for (int i = 0; i < 10; ++i) {
    if (const auto polled = link_.poll_event(); polled && *polled) {
      event = **polled;
    }
  }
  plug_in();
  wait_for_line();

  tests::vouch(link_, event);  // too late: to whoever asks no more
  std::this_thread::sleep_for(20ms);
  const Bytes verdict = ask(*line_, {3, 0, 200, 0, 24});

  ASSERT_EQ(verdict.size(), 50U);
  EXPECT_EQ(long_at(verdict, 2), 0U) << "no claim since the line is there";
  EXPECT_EQ(verdict[11], 0) << "nothing valid";
  EXPECT_EQ(verdict[13], 0);
  EXPECT_EQ(tests::counter_on(*line_, Register::kReopenings), 1U);
}

TEST_F(PulledLine, TheRestOfAFrameIsNotTakenForItsEnd) {
  const Bytes frame = rtu_frame(17, {6, 1, 74, 2, 128});  // the lamp's level
  line_->send(Bytes(frame.begin(), frame.begin() + 5));
  pull_out();
  plug_in();
  wait_for_line();

  line_->send(Bytes(frame.begin() + 5, frame.end()));
  EXPECT_EQ(line_->receive(30ms), Bytes());

  EXPECT_EQ(ask(*line_, {3, 1, 74, 0, 1}), (Bytes{3, 2, 3, 232})) << "1000, as it was";
}

/// Signals that some thread of this program blocks, as the kernel tells them.
std::uint64_t blocked_by_some_thread() {
  std::uint64_t blocked = 0;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream status(thread.path() / "status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("SigBlk:")) {
        blocked |= std::stoull(line.substr(7), nullptr, 16);
      }
    }
  }
  return blocked;
}

TEST_F(LinkFaults, ItsThreadDoesNotBlockSignalsOfItsOwnMistakes) {
  expect_answer();
  const auto bit = [](int signal) { return std::uint64_t{1} << (signal - 1); };

  const std::uint64_t blocked = blocked_by_some_thread();

  // The emulator has a thread of its own, which blocks others.
  EXPECT_EQ(blocked & (bit(SIGSEGV) | bit(SIGFPE) | bit(SIGILL)), 0U)
      << "blocked they kill past every handler, and the lamp would stay lit";
}

}  // namespace
}  // namespace tubesight::drivers
