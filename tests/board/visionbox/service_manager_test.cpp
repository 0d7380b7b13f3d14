#include "board/visionbox/service_manager.h"

#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/environment_variable.h"
#include "tests/support/notify_socket.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr milliseconds kLong{5000};

/// An abstract name that no other test of this machine has.
std::string abstract_name() { return "@tubesight-test-" + std::to_string(getpid()); }

class ServiceManagerTest : public testing::Test {
 protected:
  ServiceManager::Tell tell() {
    return [this](const std::string& line) { told_.push_back(line); };
  }
  support::TemporaryFolder folder_;
  std::vector<std::string> told_;
};

TEST_F(ServiceManagerTest, HearsEachMessageByAPathAndByAnAbstractName) {
  for (const std::string& name : {folder_.path("notify"), abstract_name()}) {
    const support::NotifySocket socket(name);
    ServiceManager manager({name, microseconds(5'000'000), {}}, tell());

    manager.say_ready();
    manager.say_status("tracking: waiting");
    manager.feed();
    manager.say_stopping();

    EXPECT_EQ(socket.next(kLong), "READY=1");
    EXPECT_EQ(socket.next(kLong), "STATUS=tracking: waiting");
    EXPECT_EQ(socket.next(kLong), "WATCHDOG=1");
    EXPECT_EQ(socket.next(kLong), "STOPPING=1");
    EXPECT_EQ(manager.watchdog(), microseconds(5'000'000));
    EXPECT_EQ(manager.lost(), 0);
  }
  EXPECT_TRUE(told_.empty());
}

TEST_F(ServiceManagerTest, WithoutOneNothingIsSaid) {
  ServiceManager manager({{}, microseconds(5'000'000), {}}, tell());

  manager.say_ready();

  EXPECT_FALSE(manager.there());
  EXPECT_EQ(manager.watchdog().count(), 0) << "nobody to feed";
  EXPECT_EQ(manager.lost(), 0);
  EXPECT_TRUE(told_.empty());
}

TEST_F(ServiceManagerTest, ASocketThatIsGoneIsToldOnceAndSoIsItsReturn) {
  const std::string name = folder_.path("notify");
  support::NotifySocket socket(name);
  ServiceManager manager({name, microseconds(5'000'000), {}}, tell());
  manager.say_ready();
  socket.close();

  manager.feed();
  manager.feed();

  EXPECT_EQ(manager.lost(), 2);
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_EQ(told_[0], "service manager: cannot be told how the box is doing: NOTIFY_SOCKET=" +
                          name + ": No such file or directory; the box goes on");
  const support::NotifySocket again(name);
  manager.feed();
  EXPECT_EQ(again.next(kLong), "WATCHDOG=1");
  ASSERT_EQ(told_.size(), 2U);
  EXPECT_EQ(told_[1], "service manager: hears the box again");
}

TEST_F(ServiceManagerTest, NeverWaitsForOneThatDoesNotListen) {
  const std::string name = folder_.path("notify");
  const support::NotifySocket socket(name);
  ServiceManager manager({name, microseconds(5'000'000), {}}, tell());

  for (int i = 0; i < 10'000 && manager.lost() == 0; ++i) {
    manager.feed();
  }

  EXPECT_GT(manager.lost(), 0) << "a socket that holds 10,000 datagrams?";
}

TEST_F(ServiceManagerTest, AnAddressThatIsNoneIsTold) {
  const std::string longest = "/" + std::string(200, 'x');
  for (const std::string& name : {std::string("notify"), std::string("@"), longest}) {
    told_.clear();
    ServiceManager manager({name, microseconds(0), {}}, tell());
    manager.say_ready();
    ASSERT_EQ(told_.size(), 1U) << name;
    EXPECT_NE(told_[0].find("no path and no abstract name"), std::string::npos) << told_[0];
  }
}

TEST(ServiceEnvironment, IsReadAndANumberForAnotherProcessIsNot) {
  const support::EnvironmentVariable socket("NOTIFY_SOCKET", "@box");
  const support::EnvironmentVariable watchdog("WATCHDOG_USEC", "5000000");
  const support::EnvironmentVariable folder("STATE_DIRECTORY", "/var/lib/tubesight:/var/lib/other");
  EXPECT_EQ(service_environment().socket, "@box");
  EXPECT_EQ(service_environment().watchdog, microseconds(5'000'000));
  EXPECT_EQ(service_environment().state_folder, "/var/lib/tubesight");
  {
    const support::EnvironmentVariable own("WATCHDOG_PID", std::to_string(getpid()));
    EXPECT_EQ(service_environment().watchdog, microseconds(5'000'000));
  }
  const support::EnvironmentVariable other("WATCHDOG_PID", std::to_string(getpid() + 1));
  EXPECT_EQ(service_environment().watchdog.count(), 0);
}

TEST(ServiceEnvironment, WhatIsNoNumberIsNone) {
  for (const char* text : {"", "soon", "-5", "0", "5s", "99999999999999999999"}) {
    const support::EnvironmentVariable watchdog("WATCHDOG_USEC", text);
    EXPECT_EQ(service_environment().watchdog.count(), 0) << text;
  }
}

}  // namespace
}  // namespace tubesight::board
