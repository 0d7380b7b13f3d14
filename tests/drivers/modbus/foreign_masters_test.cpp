// Programs that are not ours talk to the link: mbpoll, which stands on libmodbus, and pymodbus.

#include <cstdio>
#include <string>

#include <sys/wait.h>

#include "drivers/modbus/modbus_robot_link.h"
#include "tests/drivers/modbus/link_bench.h"
#include "tests/drivers/modbus/serial_robot.h"

namespace tubesight::drivers {
namespace {

/// What a program prints; a failure of the test when it does not end well.
std::string output_of(const std::string& command) {
  std::string output;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) {
    ADD_FAILURE() << command;
    return output;
  }
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) {
    output.push_back(static_cast<char>(letter));
  }
  const int status = pclose(pipe);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << command << "\n" << output;
  return output;
}

class ForeignMasters : public testing::Test {
 protected:
  ModbusSettings settings() {
    ModbusSettings settings;
    settings.serial.line.device = pair_.box.device();
    settings.serial.line.baud = 115'200;
    settings.serial.line.parity = SerialParity::kNone;
    settings.serial.unit = 17;
    return settings;
  }
  void SetUp() override { ASSERT_TRUE(link_.start()); }
  void show_sighting() {
    core::Sighting sighting = tests::make_full_sighting();
    sighting.time = clock_.now();
    EXPECT_TRUE(link_.send_sighting(sighting));
  }
  [[nodiscard]] std::string mbpoll(const std::string& arguments) const {
    return output_of("mbpoll -m rtu -b 115200 -P none -a 17 -0 -1 -q " + arguments + " " +
                     pair_.robot.device());
  }

  tests::PtyPair pair_;
  tests::SteadyClock clock_;
  ModbusRobotLink link_{settings(), tests::make_identity(), clock_};
};

TEST_F(ForeignMasters, MbpollReadsAndWrites) {
  const std::string read = mbpoll("-t 4:hex -r 2 -c 2");
  EXPECT_NE(read.find("[2]: \t0x0102"), std::string::npos) << read;
  EXPECT_NE(read.find("[3]: \t0x0304"), std::string::npos) << read;
  const std::string mark = mbpoll("-t 3:int -B -r 2 -c 1");
  EXPECT_NE(mark.find("[2]: \t16909060"), std::string::npos) << mark;

  const std::string written =
      output_of("mbpoll -m rtu -b 115200 -P none -a 17 -0 -1 -q -t 4 -r 330 " +
                pair_.robot.device() + " 640");
  EXPECT_NE(written.find("Written 1 references"), std::string::npos) << written;
  const std::string level = mbpoll("-t 4 -r 330 -c 1");
  EXPECT_NE(level.find("[330]: \t640"), std::string::npos) << level;
}

TEST_F(ForeignMasters, ADeadUnitOnTheLineTimesOutAndTheBoxAnswersAsBefore) {
  for (int i = 0; i < 3; ++i) {
    const std::string dead =
        output_of("{ mbpoll -m rtu -b 115200 -P none -a 5 -0 -1 -q -o 0.05 -t 4:hex -r 2 -c 2 " +
                  pair_.robot.device() + "; true; }");
    EXPECT_NE(dead.find("timed out"), std::string::npos) << dead;
    const std::string own = mbpoll("-t 4:hex -r 2 -c 2");
    EXPECT_NE(own.find("[2]: \t0x0102"), std::string::npos) << own;
  }

  const std::string others = mbpoll("-t 4 -r 523 -c 1");
  EXPECT_NE(others.find("[523]: \t3"), std::string::npos) << others;
}

TEST_F(ForeignMasters, PymodbusPollsAndClaims) {
  const tests::AnsweringLoop loop(link_, tests::vouch, [this] { show_sighting(); });

  const std::string told = output_of("/usr/bin/python3 -B " TUBESIGHT_SOURCE_DIR
                                     "/tests/drivers/modbus/pymodbus_master.py " +
                                     pair_.robot.device() + " 20");

  EXPECT_EQ(told,
            "mark [258, 772]\n"
            "input [258, 772]\n"
            "sighting 1023 12 -7 500\n"
            "verdict 1 4711 12 -7\n"
            "verdict 2 4712 12 -8\n"
            "one 330 640\n"
            "many 300 8\n"
            "two steps 1 5\n"
            "exception 2\n"
            "exception 3\n"
            "wrong 0\n");
}

}  // namespace
}  // namespace tubesight::drivers
