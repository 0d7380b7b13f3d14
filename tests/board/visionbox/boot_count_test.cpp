#include "board/visionbox/boot_count.h"

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

class BootCountTest : public testing::Test {
 protected:
  /// One more start in the boot of this name.
  BootCount start(const std::string& id) {
    return count_boot(state_.path("."), folder_.write("boot_id", id + "\n"));
  }
  support::TemporaryFolder folder_;
  support::TemporaryFolder state_;
};

TEST_F(BootCountTest, TellsAStartOfTheProgramFromOneOfTheMachine) {
  EXPECT_EQ(start("aaaa").words(), "boot 1, start 1");
  EXPECT_EQ(start("aaaa").words(), "boot 1, start 2");
  EXPECT_EQ(start("bbbb").words(), "boot 2, start 1");
  EXPECT_EQ(start("aaaa").words(), "boot 3, start 1") << "not the one before: that was another";
  EXPECT_EQ(state_.read("boots"), "boot 3\nstart 1\nid aaaa\n");
}

TEST_F(BootCountTest, ReadsTheKernelsOwnName) {
  EXPECT_TRUE(count_boot(state_.path(".")).known());
  const BootCount again = count_boot(state_.path("."));
  EXPECT_EQ(again.boot, 1);
  EXPECT_EQ(again.start, 2);
}

TEST_F(BootCountTest, WhatCannotBeWrittenDownIsNotUsed) {
  ASSERT_TRUE(start("aaaa").known());
  const std::string before = state_.read("boots");

  const BootCount none = count_boot(state_.path("none"), folder_.path("boot_id"));

  EXPECT_FALSE(none.known());
  EXPECT_TRUE(none.wanted);
  EXPECT_EQ(none.words(), "boots are not numbered: " + state_.path("none") +
                              "/boots: cannot be written: No such file or directory");
  EXPECT_EQ(state_.read("boots"), before);
}

TEST_F(BootCountTest, ADiskThatIsFullLeavesTheNumberUnknownAndTheFileAsItWas) {
  ASSERT_TRUE(start("aaaa").known());
  const std::string before = state_.read("boots");
  const std::string other = folder_.write("other_id", "bbbb\n");
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit none{0, limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &none), 0);

  const BootCount count = count_boot(state_.path("."), other);

  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(count.known());
  EXPECT_EQ(count.trouble, state_.path(".") + "/boots: cannot be written: File too large");
  EXPECT_EQ(state_.read("boots"), before);
  EXPECT_EQ(state_.names(), std::vector<std::string>{"boots"}) << "no remains";
}

TEST_F(BootCountTest, WhatNeverEndsIsDamaged) {
  std::filesystem::create_symlink("/dev/zero", state_.path("boots"));

  EXPECT_FALSE(start("aaaa").known());
}

TEST_F(BootCountTest, ADamagedFileIsLeftAndSaid) {
  for (const char* text :
       {"", "boot 5\nstart 1\nid ", "boot 5\nstart 1\nid aaaa", "boot 0\nstart 1\nid aaaa\n",
        "boot 5\nstart -1\nid aaaa\n", "boot 99999999999999999999\nstart 1\nid aaaa\n",
        "boot 5\nstart 1\nid aaaa\nmore\n"}) {
    state_.write("boots", text);
    const BootCount count = start("bbbb");
    EXPECT_FALSE(count.known()) << text;
    EXPECT_NE(count.trouble.find("boots: damaged, expected boot, start and id: remove it"),
              std::string::npos)
        << count.trouble;
    EXPECT_EQ(state_.read("boots"), text);
  }
}

TEST_F(BootCountTest, WithoutAFolderOrANameOfTheBootNothingIsCounted) {
  const BootCount no_folder = count_boot("");
  EXPECT_FALSE(no_folder.known());
  EXPECT_FALSE(no_folder.wanted);
  EXPECT_EQ(no_folder.words(),
            "boots are not numbered: no folder to count them in, expected STATE_DIRECTORY in the "
            "environment");
  const BootCount no_name = count_boot(state_.path("."), folder_.path("none"));
  EXPECT_FALSE(no_name.known());
  EXPECT_EQ(no_name.trouble, folder_.path("none") + ": cannot be read");
}

}  // namespace
}  // namespace tubesight::board
