#include "drivers/files/pairs_file.h"

#include <csignal>
#include <filesystem>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

const std::string kHeader =
    "name,robot_x_mm,robot_y_mm,robot_z_mm,robot_alpha_deg,robot_beta_deg,robot_gamma_deg,"
    "tool_x_mm,tool_y_mm,tool_z_mm,tool_alpha_deg,tool_beta_deg,tool_gamma_deg,sigma_x_mm,"
    "sigma_y_mm,sigma_z_mm,use";

core::PosePair a_pair(std::int32_t joints = 0) {
  core::PosePair pair;
  pair.robot.position_nm = {-12'345'675'050, 5'000'050, 0};
  pair.robot.turned = true;
  pair.robot.angles_ndeg = {30'000'000'000, -5'000, 4'999};
  pair.robot.joints = joints;
  pair.robot.joints_ndeg = {90'000'000'000, -45'123'456'000};
  pair.seen.position_nm = {1'524'000'000, 1'016'000'000, -40'000'000};
  pair.seen.angles_ndeg = {55'000'000'000, 0, 0};
  pair.seen.position_sigma_nm = {20'000, 20'000, 41'000};
  return pair;
}

// Written out by hand: mm 4, deg 5 decimals, halves away from zero.
const std::string kCells =
    "-12345.6751,5.0001,0.0000,30.00000,-0.00001,0.00000,1524.0000,1016.0000,-40.0000,55.00000,"
    "0.00000,0.00000,0.0200,0.0200,0.0410,1";

TEST(PairsFile, AFirstPairMakesTheFile) {
  const support::TemporaryFolder folder;
  std::string message;

  ASSERT_TRUE(append_pair(folder.path("p.csv"), a_pair(), message)) << message;

  EXPECT_EQ(folder.read("p.csv"), kHeader + "\np1," + kCells + "\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path("")), {}), 1)
      << "nothing else stays";
}

TEST(PairsFile, NamesCountOnAndWhatAPersonWroteStays) {
  const support::TemporaryFolder folder;
  const std::string mine = "by hand," + kCells;
  // A row was taken out, and the last line has no end.
  const std::string before = kHeader + "\np1," + kCells + "\np7," + kCells + "\n" + mine;
  folder.write("p.csv", before);
  std::string message;

  ASSERT_TRUE(append_pair(folder.path("p.csv"), a_pair(), message)) << message;

  EXPECT_EQ(folder.read("p.csv"), before + "\np8," + kCells + "\n");
}

TEST(PairsFile, APlaceAloneLeavesTheAnglesEmptyAndJointsFollow) {
  const support::TemporaryFolder folder;
  core::PosePair pair = a_pair(2);
  pair.robot.turned = false;
  std::string message;

  ASSERT_TRUE(append_pair(folder.path("p.csv"), pair, message)) << message;
  ASSERT_TRUE(append_pair(folder.path("p.csv"), a_pair(2), message)) << message;

  const std::string text = folder.read("p.csv");
  EXPECT_TRUE(text.starts_with(kHeader + ",joint_1_deg,joint_2_deg\n"
                                         "p1,-12345.6751,5.0001,0.0000,,,,1524.0000,"))
      << text;
  EXPECT_TRUE(text.ends_with("\np2," + kCells + ",90.00000,-45.12346\n")) << text;
}

TEST(PairsFile, WhatDoesNotFitIsNotWritten) {
  const support::TemporaryFolder folder;
  std::string rows;
  for (int i = 0; i < 256; ++i) {
    rows += "x," + kCells + "\n";
  }
  struct Case {
    std::string text;
    std::string why;
  };
  for (const auto& [text, why] :
       {Case{"field,time_s\n1,2\n", "p.csv:1: wrong header, expected name,robot_x_mm"},
        Case{kHeader + ",weather\n", "p.csv:1: further columns"},
        Case{kHeader + "\np1,2\n", "p.csv:2: 2 cells, expected 17"},
        Case{kHeader + "\np1," + kCells.substr(0, 30), "p.csv:2: 5 cells"},
        Case{kHeader + "\n" + rows, "has 256 pairs, expected at most 256: move it away"},
        Case{kHeader + ",joint_1_deg\n", "has 1 joints' angles a row, the robot told 0"}}) {
    folder.write("p.csv", text);
    std::string message;

    const auto appended = append_pair(folder.path("p.csv"), a_pair(), message);

    ASSERT_FALSE(appended);
    EXPECT_EQ(appended.error(), core::Error::kInvalidArgument);
    EXPECT_NE(message.find(why), std::string::npos) << message;
    EXPECT_EQ(folder.read("p.csv"), text) << "as it was";
  }
}

TEST(PairsFile, AFolderThatIsNotThereIsSaid) {
  const support::TemporaryFolder folder;
  std::string message;

  const auto appended = append_pair(folder.path("gone/p.csv"), a_pair(), message);

  ASSERT_FALSE(appended);
  EXPECT_EQ(appended.error(), core::Error::kIo);
  EXPECT_NE(message.find("gone/p.csv: cannot be written"), std::string::npos) << message;
}

/// No file of this process may grow beyond so many bytes, as on a disk that is full.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(PairsFile, AFullDiskLeavesTheRowsThatAreThere) {
  const support::TemporaryFolder folder;
  std::string message;
  ASSERT_TRUE(append_pair(folder.path("p.csv"), a_pair(), message)) << message;
  const std::string before = folder.read("p.csv");
  {
    const SmallDisk full(before.size() + 20);  // in the middle of the second row
    const auto appended = append_pair(folder.path("p.csv"), a_pair(), message);
    ASSERT_FALSE(appended);
    EXPECT_EQ(appended.error(), core::Error::kIo);
  }
  EXPECT_NE(message.find("p.csv: cannot be written"), std::string::npos) << message;
  EXPECT_EQ(folder.read("p.csv"), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path("")), {}), 1);

  ASSERT_TRUE(append_pair(folder.path("p.csv"), a_pair(), message)) << message;
  EXPECT_EQ(folder.read("p.csv"), before + "p2," + kCells + "\n");
}

TEST(PairsFile, TellsWhatIsNoneBeforeAnyPair) {
  const support::TemporaryFolder folder;
  EXPECT_EQ(why_no_pairs(folder.path("p.csv")), "") << "it may come";
  folder.write("p.csv", kHeader + "\np1," + kCells + "\n");
  EXPECT_EQ(why_no_pairs(folder.path("p.csv")), "");
  folder.write("p.csv", "\x89PNG");
  EXPECT_NE(why_no_pairs(folder.path("p.csv")), "");
  EXPECT_NE(why_no_pairs(folder.path("")), "") << "a folder";
  EXPECT_NE(why_no_pairs("/dev/zero"), "") << "no file, and not read";
}

}  // namespace
}  // namespace tubesight::drivers
