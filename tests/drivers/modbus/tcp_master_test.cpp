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
