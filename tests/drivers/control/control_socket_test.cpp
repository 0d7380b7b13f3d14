#include "drivers/control/control_socket.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "drivers/control/socket_address.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

/// What a killed program leaves: a bound socket on which nobody listens.
void leave_behind(const std::string& path) {
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  const auto address = socket_address(path);
  ASSERT_TRUE(address);
  ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&*address), sizeof(*address)), 0);
  close(fd);
}

TEST(ControlSocket, IsThereForOwnerAndGroupWhileOpen) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path("box");
  ControlSocket listening;

  ASSERT_TRUE(listening.open(path)) << listening.message();
  struct stat there {};
  ASSERT_EQ(stat(path.c_str(), &there), 0);
  EXPECT_EQ(there.st_mode & 07777U, 0660U);
  listening.close();

  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
}

TEST(ControlSocket, ReplacesOneThatAKilledProgramLeft) {
  const support::TemporaryFolder folder;
  leave_behind(folder.path("box"));
  ControlSocket listening;

  EXPECT_TRUE(listening.open(folder.path("box"))) << listening.message();
  const int client = connect_to(folder.path("box"));
  EXPECT_GE(client, 0);
  close(client);
}

TEST(ControlSocket, RefusesOneThatSomebodyListensOn) {
  const support::TemporaryFolder folder;
  ControlSocket first;
  ASSERT_TRUE(first.open(folder.path("box")));
  ControlSocket second;

  const auto opened = second.open(folder.path("box"));

  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error(), core::Error::kNotReady);
  EXPECT_EQ(second.message(), folder.path("box") + ": another program listens there");
  second.close();
  const int client = connect_to(folder.path("box"));
  EXPECT_GE(client, 0) << "the first one still listens";
  close(client);
}

TEST(ControlSocket, LeavesAloneWhatIsNoSocket) {
  const support::TemporaryFolder folder;
  folder.write("box", "precious");
  ControlSocket listening;

  const auto opened = listening.open(folder.path("box"));

  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error(), core::Error::kInvalidArgument);
  EXPECT_EQ(folder.read("box"), "precious");
}

TEST(ControlSocket, RefusesPathsThatNoSocketCanHave) {
  const support::TemporaryFolder folder;
  for (const std::string& path :
       {std::string(), folder.path(std::string(120, 'x')), folder.path("no/folder/box")}) {
    ControlSocket listening;
    EXPECT_FALSE(listening.open(path)) << path;
    EXPECT_FALSE(listening.message().empty());
    EXPECT_EQ(listening.fd(), -1);
  }
}

}  // namespace
}  // namespace tubesight::drivers
