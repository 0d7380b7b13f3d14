#include "drivers/modbus/modbus_robot_link.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

#include "tests/drivers/modbus/link_bench.h"
#include "tests/drivers/modbus/link_on_line.h"
#include "tests/drivers/modbus/serial_robot.h"
#include "tests/hal/robot_link_contract.h"
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

/// A robot that says by registers what the suite wants said.
class ModbusMaker {
 public:
  static constexpr int kStartTubes = 3;

  hal::RobotLink& link() { return link_; }

  void say(const core::Event& event) {
    clock_.set(event.at.value_or(core::FieldTime(1s)));
    RegisterImage image(WordOrder::kHighFirst);
    std::visit(
        core::Overloaded{[&](const core::Claim& claim) {
                           image.set(Register::kClaimId, event.id);
                           image.set(Register::kClaimRow, claim.tube.row);
                           image.set(Register::kClaimColumn, claim.tube.column);
                           image.set(Register::kClaimCommit, 1);
                           write(image, 300, 307);
                         },
                         [&](const core::LampCommand& lamp) {
                           image.set(Register::kLampLevel, lamp.permille);
                           command(image, CommandBit::kLamp);
                         },
                         [&](const core::PoseRequest&) { command(image, CommandBit::kPose); },
                         [&](const core::Pick& pick) {
                           image.set(Register::kSeenField, *pick.seen_field);
                           set_place(image, Register::kPickU, pick.at_px);
                           command(image, CommandBit::kPick);
                         },
                         [&](const core::Start& start) {
                           for (std::int32_t i = 0; i < start.tubes.size(); ++i) {
                             const Register row = after(Register::kStart1Row, 4 * i);
                             image.set(row, start.tubes[i].address.row);
                             image.set(after(row, 1), start.tubes[i].address.column);
                             set_place(image, after(row, 2), start.tubes[i].at_px);
                           }
                           command(image, CommandBit::kStart);
                         },
                         [](const auto&) { FAIL() << "no robot says this"; }},
        event.content);
  }

  [[nodiscard]] std::size_t replies() const { return ask_word(204) & 1U; }
  [[nodiscard]] std::size_t sightings() const { return ask_word(101); }

 private:
  static Register after(Register name, std::int32_t steps) {
    return static_cast<Register>(static_cast<std::int32_t>(name) + steps);
  }
  static void set_place(RegisterImage& image, Register u, const std::array<double, 2>& at_px) {
    image.set(u, static_cast<std::int64_t>(at_px[0] * 1000.0));
    image.set(after(u, 1), static_cast<std::int64_t>(at_px[1] * 1000.0));
  }
  void command(RegisterImage& image, CommandBit bit) {
    image.set(Register::kCommand, bit_of(bit));
    image.set(Register::kLampMode, 1);
    for (std::int32_t i = 0; i < 4; ++i) {
      image.set(after(Register::kWindowLeft, i), identity_.window_px[static_cast<std::size_t>(i)]);
    }
    set_place(image, Register::kOptimumU, identity_.optimum_px);
    write(image, 320, 363);
    EXPECT_EQ(ask(line_, {6, 1, 64, 0, 0}).size(), 5u) << "the bit is cleared";
  }
  void write(const RegisterImage& image, std::int32_t first, std::int32_t last) {
    const std::int32_t count = last - first + 1;
    Bytes request{16, static_cast<std::uint8_t>(first >> 8), static_cast<std::uint8_t>(first),
                  0,  static_cast<std::uint8_t>(count),      static_cast<std::uint8_t>(2 * count)};
    for (std::int32_t address = first; address <= last; ++address) {
      request.push_back(static_cast<std::uint8_t>(image.word(address) >> 8));
      request.push_back(static_cast<std::uint8_t>(image.word(address) & 0xFF));
    }
    EXPECT_EQ(ask(line_, request).size(), 5u);
  }
  [[nodiscard]] std::uint32_t ask_word(std::uint8_t address) const {
    const Bytes answer = ask(line_, {3, 0, address, 0, 1});
    return answer.size() == 4 ? answer[2] * 256U + answer[3] : 0;
  }

  Pty line_;
  tests::SharedClock clock_;
  LinkIdentity identity_ = tests::make_identity();
  ModbusRobotLink link_{settings_for(line_.device()), identity_, clock_};
};

}  // namespace
}  // namespace tubesight::drivers

namespace tubesight::support {
INSTANTIATE_TYPED_TEST_SUITE_P(Modbus, RobotLinkContract, drivers::ModbusMaker);
}  // namespace tubesight::support

namespace tubesight::drivers {
namespace {

using ModbusRobotLinkTest = tests::LinkOnLine;

TEST_F(ModbusRobotLinkTest, AnswersWithinMilliseconds) {
  std::vector<std::chrono::nanoseconds> took;
  for (int i = 0; i < 200; ++i) {
    const auto before = clock_.now();
    line_.send(rtu_frame(17, kReadMark));
    pollfd entry{line_.descriptor(), POLLIN, 0};
    ASSERT_EQ(poll(&entry, 1, 1000), 1);
    took.push_back(clock_.now() - before);
    ASSERT_EQ(line_.receive(5ms).size(), 9u);
  }
  std::ranges::sort(took);

  EXPECT_LT(took[100], 5ms);
  EXPECT_LT(counter(Register::kResponseLast), 5000u);
  EXPECT_GE(counter(Register::kAnswers), 200u);
}

TEST_F(ModbusRobotLinkTest, Function23BringsTheVerdictOfItsOwnClaim) {
  const tests::AnsweringLoop loop(link_, [](hal::RobotLink& link, const core::Event& event) {
    std::this_thread::sleep_for(16ms);  // the next field
    tests::vouch(link, event);
  });

  const Bytes agree = ask(line_, claim(1));
  const Bytes disagree = ask(line_, claim(2, 13));

  ASSERT_EQ(agree.size(), 50u);
  EXPECT_EQ(agree[11], 3) << "verdict and tube";
  EXPECT_EQ(agree[13], 1) << "AGREE";
  EXPECT_EQ(long_at(agree, 18), 1u) << "its id";
  ASSERT_EQ(disagree.size(), 50u);
  EXPECT_EQ(disagree[13], 2) << "DISAGREE";
  EXPECT_EQ(long_at(disagree, 18), 2u);
  EXPECT_EQ(long_at(disagree, 22), 13u);
  EXPECT_EQ(long_at(disagree, 30), 12u) << "the tube vouched for";
}

TEST_F(ModbusRobotLinkTest, Function23CannotSayWhenNobodyJudges) {
  const auto before = clock_.now();

  const Bytes answer = ask(line_, claim(1));

  EXPECT_GE(clock_.now() - before, 50ms);
  ASSERT_EQ(answer.size(), 50u);
  EXPECT_EQ(answer[13], 3);
  EXPECT_EQ(answer[15], 100);
  EXPECT_EQ(counter(Register::kLateClaims), 1u);
}

TEST_F(ModbusRobotLinkTest, AnAnswerThatNobodyWaitsForIsNotSent) {
  line_.send(rtu_frame(17, claim(1)));
  ASSERT_EQ(line_.receive(10ms), Bytes());

  EXPECT_EQ(ask(line_, kReadMark), kMark) << "and nothing of the claim's";

  EXPECT_EQ(line_.receive(80ms), Bytes());
  EXPECT_EQ(counter(Register::kAbandonedAnswers), 1u);
}

TEST_F(ModbusRobotLinkTest, SurvivesWhatIsNoRequestAndCountsIt) {
  Bytes garbled = rtu_frame(17, kReadMark);
  garbled[4] ^= 8;
  expect_silence(garbled);
  expect_answer();
  expect_silence({17, 3, 0});
  expect_answer();
  expect_silence(rtu_frame(5, kReadMark));
  expect_answer();
  expect_silence({0xFF, 0, 0x55, 0xAA, 1, 2});
  expect_answer();
  expect_silence(rtu_frame(0, {6, 1, 74, 2, 128}));
  EXPECT_EQ(ask(line_, {3, 1, 74, 0, 1}), (Bytes{3, 2, 2, 128})) << "obeyed, not answered";
  expect_silence(rtu_frame(0, claim(1)));
  expect_silence(rtu_frame(0, kReadMark));
  EXPECT_EQ(ask(line_, {3, 0, 204, 0, 1}), (Bytes{3, 2, 0, 0})) << "only 6 and 16 are for all";

  EXPECT_EQ(counter(Register::kCrcErrors) + counter(Register::kCutFrames), 3u);
  EXPECT_EQ(counter(Register::kOtherUnits), 1u);
  EXPECT_EQ(counter(Register::kBroadcasts), 3u);
}

TEST_F(ModbusRobotLinkTest, RefusesWithExceptionsAtOnce) {
  EXPECT_EQ(ask(line_, {3, 0, 99, 0, 1}), (Bytes{0x83, 2}));
  EXPECT_EQ(ask(line_, {3, 0, 100, 0, 0}), (Bytes{0x83, 3}));
  EXPECT_EQ(ask(line_, {99, 0, 0}), (Bytes{0xE3, 1}));
  EXPECT_EQ(ask(line_, {23, 0, 0, 0, 1, 1, 44, 0, 1, 4, 0, 0}), (Bytes{0x97, 3}));
  expect_answer();
  EXPECT_EQ(counter(Register::kExceptions), 4u);
  EXPECT_LT(counter(Register::kResponseWorst), 200'000u) << "libmodbus sleeps 500 ms";
}

TEST_F(ModbusRobotLinkTest, TakesAFrameInPieces) {
  const Bytes frame = rtu_frame(17, kReadMark);
  for (const std::uint8_t byte : frame) {
    line_.send({byte});
    std::this_thread::sleep_for(200us);
  }
  EXPECT_EQ(line_.receive(1000ms), rtu_frame(17, kMark));
}

TEST_F(ModbusRobotLinkTest, ADeadNeighbourDisturbsNobody) {
  for (std::uint8_t i = 0; i < 20; ++i) {
    expect_silence(rtu_frame(5, {3, 0, i, 0, 2}));
    expect_answer();
  }
  EXPECT_EQ(counter(Register::kOtherUnits), 20u);
}

TEST_F(ModbusRobotLinkTest, AFloodIsSurvived) {
  const Bytes frame = rtu_frame(17, kReadMark);
  for (int i = 0; i < 3000; ++i) {
    line_.send(frame);
    if (i % 10 == 0) {
      static_cast<void>(line_.receive(0ms));  // or the answers fill the line
    }
  }
  static_cast<void>(line_.receive(100ms));

  expect_answer();
  EXPECT_EQ(counter(Register::kRequests), 3002u);
}

TEST_F(ModbusRobotLinkTest, TellsTheLoopOfGarbledMessages) {
  expect_silence({17, 3, 0});

  const auto polled = link_.poll_event();

  ASSERT_FALSE(polled);
  EXPECT_EQ(polled.error(), core::Error::kDataLoss);
  EXPECT_TRUE(link_.poll_event());
}

TEST(ModbusRobotLink, ComesBackAfterTheLineWasPulledInTheMiddleOfAFrame) {
  const support::TemporaryFolder folder;
  const std::string device = folder.path("robot");
  auto line = std::make_unique<Pty>();
  std::filesystem::create_symlink(line->device(), device);
  const tests::SteadyClock clock;
  ModbusRobotLink link(settings_for(device), tests::make_identity(), clock);
  ASSERT_TRUE(link.start());
  ASSERT_EQ(ask(*line, kReadMark), kMark);
  line->send({17, 3, 0, 2});
  std::filesystem::remove(device);
  line.reset();
  core::Result<void> sent;
  for (int i = 0; i < 200 && sent; ++i) {
    std::this_thread::sleep_for(5ms);
    sent = link.send_sighting({});
  }
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error(), core::Error::kDisconnected);
  EXPECT_FALSE(link.poll_event());

  line = std::make_unique<Pty>();
  std::filesystem::create_symlink(line->device(), device);
  for (int i = 0; i < 400 && !link.poll_event(); ++i) {
    std::this_thread::sleep_for(5ms);
  }

  EXPECT_EQ(ask(*line, kReadMark), kMark);
  const Bytes reopenings = ask(*line, {3, 2, 22, 0, 2});
  ASSERT_EQ(reopenings.size(), 6u);
  EXPECT_EQ(long_at(reopenings, 2), 1u);
}

TEST(ModbusRobotLink, CallsAtItsThreadsStartWhatItIsGiven) {
  static std::atomic<int> calls{0};
  static std::thread::id caller;
  const Pty line;
  const tests::SteadyClock clock;
  ModbusRobotLink link(settings_for(line.device()), tests::make_identity(), clock, [] {
    caller = std::this_thread::get_id();
    ++calls;
  });
  ASSERT_TRUE(link.start());
  EXPECT_EQ(ask(line, kReadMark), kMark);
  link.stop();

  EXPECT_EQ(calls, 1);
  EXPECT_NE(caller, std::this_thread::get_id());
}

TEST(ModbusRobotLink, DoesNotStartWithoutItsLine) {
  const tests::SteadyClock clock;
  ModbusRobotLink link(settings_for("/dev/no-such-line"), tests::make_identity(), clock);

  const auto started = link.start();

  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), core::Error::kIo);
}

TEST(ModbusRobotLink, DoesNotStartWhereRs485CannotBeSwitched) {
  const Pty line;  // it has no direction
  const tests::SteadyClock clock;
  ModbusSettings settings = settings_for(line.device());
  settings.serial.line.rs485 = true;
  ModbusRobotLink link(settings, tests::make_identity(), clock);

  const auto started = link.start();

  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), core::Error::kUnsupported);
}

}  // namespace
}  // namespace tubesight::drivers
