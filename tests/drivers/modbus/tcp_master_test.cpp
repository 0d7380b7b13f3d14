#include "drivers/modbus/tcp_master.h"

#include <arpa/inet.h>
#include <sys/socket.h>

#include "drivers/modbus/modbus_robot_link.h"
#include "tests/drivers/modbus/link_bench.h"
#include "tests/drivers/modbus/serial_robot.h"

namespace tubesight::drivers {
namespace {

using tests::Bytes;
using namespace std::chrono_literals;

/// A master of Modbus TCP, written for the tests.
class TcpRobot {
 public:
  explicit TcpRobot(std::int32_t port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  TcpRobot(const TcpRobot&) = delete;
  TcpRobot& operator=(const TcpRobot&) = delete;
  ~TcpRobot() { close(socket_); }

  [[nodiscard]] bool connected() const { return connected_; }
  void send(const Bytes& bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), std::ssize(bytes));
  }
  [[nodiscard]] Bytes receive(std::size_t count) const {
    Bytes got(count);
    pollfd entry{socket_, POLLIN, 0};
    std::size_t have = 0;
    while (have < count && poll(&entry, 1, 1000) > 0) {
      const ssize_t more = read(socket_, got.data() + have, count - have);
      if (more <= 0) {
        break;
      }
      have += static_cast<std::size_t>(more);
    }
    got.resize(have);
    return got;
  }

 private:
  int socket_;
  bool connected_ = false;
};

const Bytes kReadMark{0, 7, 0, 0, 0, 6, 1, 3, 0, 2, 0, 2};
const Bytes kMark{0, 7, 0, 0, 0, 7, 1, 3, 4, 1, 2, 3, 4};

class TcpMasterTest : public testing::Test {
 protected:
  static ModbusSettings settings() {
    ModbusSettings settings;
    settings.tcp_port = 0;
    return settings;
  }
  void SetUp() override { ASSERT_TRUE(link_.start()); }

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

  tests::SteadyClock clock_;
  ModbusRobotLink link_{settings(), tests::make_identity(), clock_};
};

TEST(TcpMaster, IsOffUnlessTheSettingsSayAPort) {
  const tests::SteadyClock clock;
  ModbusRobotLink link(ModbusSettings{}, tests::make_identity(), clock);
  ASSERT_TRUE(link.start());
  EXPECT_EQ(link.tcp_port(), 0);
}

TEST_F(TcpMasterTest, AnswersOnTheSameMap) {
  const TcpRobot robot(link_.tcp_port());
  ASSERT_TRUE(robot.connected());

  robot.send(kReadMark);
  EXPECT_EQ(robot.receive(kMark.size()), kMark);

  Bytes both = kReadMark;  // two requests in one segment
  both.insert(both.end(), kReadMark.begin(), kReadMark.end());
  robot.send(both);
  EXPECT_EQ(robot.receive(2 * kMark.size()).size(), 2 * kMark.size());
}

TEST_F(TcpMasterTest, AnswersRequestsSentAheadOfAVerdictInTheirOrder) {
  const tests::AnsweringLoop loop(link_, tests::vouch);
  const TcpRobot robot(link_.tcp_port());
  Bytes requests{0, 1, 0, 0, 0, 27, 1, 23, 0,    200,  0,    24,   1, 44, 0, 8, 16,
                 0, 0, 0, 9, 0, 0,  0, 12, 0xFF, 0xFF, 0xFF, 0xF9, 0, 0,  0, 1};
  requests.insert(requests.end(), kReadMark.begin(), kReadMark.end());

  robot.send(requests);

  const Bytes verdict = robot.receive(7 + 50);
  ASSERT_EQ(verdict.size(), 57u);
  EXPECT_EQ(verdict[1], 1);
  EXPECT_EQ(verdict[7 + 13], 1) << "AGREE";
  EXPECT_EQ(robot.receive(kMark.size()), kMark);
}

/// A claim of (12, -7), function 23, under a number of the master's that is its id as well.
Bytes claim(std::uint8_t id) {
  return {0, id, 0, 0,  0, 27, 1, 23, 0,    200,  0,    24,   1, 44, 0, 8, 16,
          0, 0,  0, id, 0, 0,  0, 12, 0xFF, 0xFF, 0xFF, 0xF9, 0, 0,  0, 1};
}

/// When it came nobody knows afterwards: judged, it would be at an instant that is not its own.
TEST_F(TcpMasterTest, RefusesAClaimThatCameWhileOneWaited) {
  const TcpRobot robot(link_.tcp_port());
  robot.send(claim(1));
  const core::Event first = wait_for_event();
  robot.send(claim(2));
  robot.send({0, 3, 0, 0, 0, 11, 1, 16, 1, 50, 0, 2, 4, 0, 0, 0, 1});  // function 16, a claim
  robot.send({0, 4, 0, 0, 0, 6, 1, 6, 1, 51, 0, 1});                   // function 6, a claim
  robot.send({0, 5, 0, 0, 0, 6, 1, 6, 1, 50, 0, 0});                   // none yet
  robot.send(kReadMark);
  std::this_thread::sleep_for(5ms);
  tests::vouch(link_, first);

  const Bytes verdict = robot.receive(57);
  ASSERT_EQ(verdict.size(), 57u);
  EXPECT_EQ(verdict[7 + 13], 1) << "AGREE";
  EXPECT_EQ(robot.receive(9), (Bytes{0, 2, 0, 0, 0, 3, 1, 0x97, 6}));
  EXPECT_EQ(robot.receive(9), (Bytes{0, 3, 0, 0, 0, 3, 1, 0x90, 6}));
  EXPECT_EQ(robot.receive(9), (Bytes{0, 4, 0, 0, 0, 3, 1, 0x86, 6}));
  EXPECT_EQ(robot.receive(12), (Bytes{0, 5, 0, 0, 0, 6, 1, 6, 1, 50, 0, 0}));
  EXPECT_EQ(robot.receive(kMark.size()), kMark);
  for (int i = 0; i < 5; ++i) {
    const auto event = link_.poll_event();  // an error as well, that requests were refused
    EXPECT_TRUE(!event || !*event) << "none of them reached the box";
  }

  const auto before = clock_.now();
  robot.send(claim(6));
  EXPECT_GE(wait_for_event().at, before) << "sent again, it is taken";
}

TEST_F(TcpMasterTest, AClaimBehindAClaimInOneSegmentKeepsItsInstant) {
  const TcpRobot robot(link_.tcp_port());
  Bytes both = claim(1);
  const Bytes second = claim(2);
  both.insert(both.end(), second.begin(), second.end());
  robot.send(both);

  const core::Event one = wait_for_event();
  const core::Event two = wait_for_event();  // after the time in which nobody judged the first

  EXPECT_EQ(one.at, two.at);
}

TEST_F(TcpMasterTest, HangsUpOnWhatIsNotModbus) {
  const TcpRobot stranger(link_.tcp_port());
  stranger.send({'G', 'E', 'T', ' ', '/', '\r', '\n', '\r', '\n'});
  EXPECT_EQ(stranger.receive(1), Bytes());

  const TcpRobot robot(link_.tcp_port());
  robot.send(kReadMark);
  EXPECT_EQ(robot.receive(kMark.size()), kMark);
}

TEST_F(TcpMasterTest, OtherUnitsAreNotAnswered) {
  const TcpRobot robot(link_.tcp_port());
  Bytes other = kReadMark;
  other[6] = 9;
  robot.send(other);
  robot.send(kReadMark);
  EXPECT_EQ(robot.receive(kMark.size()), kMark);
}

TEST_F(TcpMasterTest, MakesRoomForANewMaster) {
  std::vector<std::unique_ptr<TcpRobot>> robots;
  for (int i = 0; i < 5; ++i) {
    robots.push_back(std::make_unique<TcpRobot>(link_.tcp_port()));
    robots.back()->send(kReadMark);
    ASSERT_EQ(robots.back()->receive(kMark.size()), kMark) << i;
  }
  EXPECT_EQ(robots[0]->receive(1), Bytes()) << "hung up";
  robots[1]->send(kReadMark);
  EXPECT_EQ(robots[1]->receive(kMark.size()), kMark);
}

TEST_F(TcpMasterTest, NoneReadsTheVerdictOfAnother) {
  const tests::AnsweringLoop loop(link_, tests::vouch);
  const TcpRobot one(link_.tcp_port());
  const TcpRobot other(link_.tcp_port());
  one.send({0, 1, 0, 0, 0, 27, 1, 23, 0,    200,  0,    24,   1, 44, 0, 8, 16,
            0, 0, 0, 9, 0, 0,  0, 12, 0xFF, 0xFF, 0xFF, 0xF9, 0, 0,  0, 1});
  ASSERT_EQ(one.receive(57).size(), 57u);

  other.send({0, 2, 0, 0, 0, 6, 1, 3, 0, 204, 0, 2});

  EXPECT_EQ(other.receive(13), (Bytes{0, 2, 0, 0, 0, 7, 1, 3, 4, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace tubesight::drivers
