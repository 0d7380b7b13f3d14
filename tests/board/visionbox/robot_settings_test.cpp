// The tables of the box's settings that serve the calibration of a robot: pairs.

#include <string>

#include <gtest/gtest.h>

#include "tests/board/visionbox/box_settings_bench.h"

namespace tubesight::board {
namespace {

TEST_F(BoxSettingsTest, WhereGoPairsIsRead) {
  ASSERT_TRUE(load(kSource));
  EXPECT_FALSE(box_->pairs.wanted());
  ASSERT_TRUE(load(std::string(kSource) + "[pairs]\nfile = \"kept/pairs.csv\"\n"))
      << messages_.front();
  EXPECT_EQ(box_->pairs.file, folder_.path("kept/pairs.csv"));

  EXPECT_FALSE(load(std::string(kSource) + "[pairs]\nfile = \"recording.y4m\"\n"));
  EXPECT_TRUE(told("recording.y4m:1: wrong header")) << messages_.front();
  EXPECT_FALSE(load(std::string(kSource) + "[pairs]\nfile = \"\"\n"));
  EXPECT_TRUE(told("file: '', expected the path of a file of pairs"));
  EXPECT_FALSE(load(std::string(kSource) + "[pairs]\n"));
  EXPECT_FALSE(load(std::string(kSource) + "[pairs]\nfile = \"p.csv\"\nrows = 3\n"));
}

}  // namespace
}  // namespace tubesight::board
