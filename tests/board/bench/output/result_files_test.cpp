#include "board/bench/output/result_files.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

core::TubeSighting tube(core::TubeAddress address, bool plug) {
  core::TubeSighting seen;
  seen.address = address;
  seen.center_px = {10 * 65536, 20 * 65536 + 32768};
  seen.quality_permyriad = plug ? 0 : 9000;
  seen.plug = plug;
  return seen;
}

TEST(ResultFiles, HoldOneRowAFieldAndOneATubeEnd) {
  const support::TemporaryFolder folder;
  core::Sighting sighting;
  core::tracking::TubeSightingList tubes;
  ASSERT_TRUE(tubes.try_push_back(tube({4, 6}, false)));
  ASSERT_TRUE(tubes.try_push_back(tube({4, 7}, true)));
  ResultFiles files;
  ASSERT_TRUE(files.open(folder.path("f.csv"), folder.path("c.csv")));

  ASSERT_TRUE(files.add(3, core::Parity::kOdd, sighting, tubes));
  ASSERT_TRUE(files.commit());

  EXPECT_EQ(folder.read("f.csv"),
            "field,frame,parity,time_s,state,tracked,primary_row,primary_column,primary_u_px,"
            "primary_v_px,tool_row,tool_column,tool_offset_mm,tool_height_mm,aligned,margin,"
            "reason,tool_dx_mm,tool_dy_mm,residual_px,liveness\n"
            "3,1,odd,0.000000,waiting,0,,,,,,,,,0,,no-start,,,,unknown\n");
  // A plug is no tube-end measured.
  EXPECT_EQ(folder.read("c.csv"),
            "field,row,column,u_px,v_px,quality\n3,4,6,10.000,20.500,0.9000\n");
}

TEST(ResultFiles, AreLeftOutWhenTheyHaveNoName) {
  const support::TemporaryFolder folder;
  ResultFiles files;
  ASSERT_TRUE(files.open("", folder.path("c.csv")));
  ASSERT_TRUE(files.add(0, core::Parity::kEven, {}, {}));
  ASSERT_TRUE(files.commit());

  EXPECT_EQ(folder.names(), (std::vector<std::string>{"c.csv"}));
}

TEST(ResultFiles, LeaveNothingWithoutCommit) {
  const support::TemporaryFolder folder;
  {
    ResultFiles files;
    ASSERT_TRUE(files.open(folder.path("f.csv"), folder.path("c.csv")));
    ASSERT_TRUE(files.add(0, core::Parity::kEven, {}, {}));
  }

  EXPECT_TRUE(folder.names().empty());
}

TEST(ResultFiles, TellThatTheDiskIsFull) {
  ResultFiles files;
  ASSERT_TRUE(files.open("/dev/full", ""));

  const auto committed = files.commit();

  ASSERT_FALSE(committed);
  EXPECT_EQ(files.message(), "/dev/full: cannot be written: No space left on device");
}

}  // namespace
}  // namespace tubesight::board
