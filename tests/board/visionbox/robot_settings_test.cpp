// The tables of the box's settings that serve the calibration of a robot: pairs and zones.

#include <string>

#include <gtest/gtest.h>

#include "tests/board/visionbox/box_settings_bench.h"

namespace tubesight::board {
namespace {

TEST_F(BoxSettingsTest, WhereTheJournalGoesIsRead) {
  ASSERT_TRUE(load(kSource));
  EXPECT_FALSE(box_->journal.wanted());
  ASSERT_TRUE(load(std::string(kSource) + "[journal]\nfile = \"kept/J.db\"\n"))
      << messages_.front();
  EXPECT_EQ(box_->journal.file, folder_.path("kept/J.db"));
  EXPECT_EQ(box_->journal.key, folder_.path("kept/J.db.key"));
  EXPECT_EQ(box_->journal.pictures, 2000);
  ASSERT_TRUE(
      load(std::string(kSource) + "[journal]\nfile = \"J.db\"\nkey = \"k\"\npictures = 0\n"));
  EXPECT_EQ(box_->journal.key, folder_.path("k"));

  EXPECT_FALSE(load(std::string(kSource) + "[journal]\n"));
  EXPECT_FALSE(load(std::string(kSource) + "[journal]\nfile = \".\"\n"));
  EXPECT_TRUE(told("file: '.', expected the path of a file, there or not"));
  EXPECT_FALSE(load(std::string(kSource) + "[journal]\nfile = \"J.db\"\nkey = \"J.db\"\n"));
  EXPECT_TRUE(told("key: 'J.db' is the journal's own file, expected another"));
  EXPECT_FALSE(load(std::string(kSource) + "[journal]\nfile = \"J.db\"\nrows = 3\n"));
}

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

TEST_F(BoxSettingsTest, CorrectionsByZonesAreReadWhereARobotCanAsk) {
  const std::string link = std::string(kSource) + "[link]\nkind = \"modbus\"\ntcp_port = 1502\n";
  folder_.write("zones.csv", "sheet_x_mm,sheet_y_mm,dx_mm,dy_mm,dz_mm,sigma_mm\n1,2,3,4,5,0.6\n");
  ASSERT_TRUE(load(link));
  EXPECT_FALSE(box_->zones.wanted());
  ASSERT_TRUE(load(link + "[zones]\nfile = \"zones.csv\"\n")) << messages_.front();
  ASSERT_EQ(box_->zones.points.size(), 1);
  EXPECT_TRUE(box_->zones.points[0].off_mm.isApprox(Eigen::Vector3d(3.0, 4.0, 5.0)));
  EXPECT_DOUBLE_EQ(box_->zones.points[0].sigma_mm, 0.6);

  EXPECT_FALSE(load(std::string(kSource) + "[zones]\nfile = \"zones.csv\"\n"));
  EXPECT_TRUE(told("of a robot's link, which is \"none\", expected it left out"));
  EXPECT_FALSE(load(link + "[zones]\nfile = \"gone.csv\"\n"));
  EXPECT_TRUE(told("gone.csv' cannot be read")) << messages_.front();
  folder_.write("zones.csv", "sheet_x_mm,sheet_y_mm,dx_mm,dy_mm,dz_mm,sigma_mm\n");
  EXPECT_FALSE(load(link + "[zones]\nfile = \"zones.csv\"\n"));
  EXPECT_TRUE(told("has no corrections, expected one at least"));
  folder_.write("zones.csv",
                "sheet_x_mm,sheet_y_mm,dx_mm,dy_mm,dz_mm,sigma_mm\n1,2,3,4,5,0\n1,2,3,4,x,1\n");
  EXPECT_FALSE(load(link + "[zones]\nfile = \"zones.csv\"\n"));
  EXPECT_TRUE(told("zones.csv:2: sigma_mm: '0'"));
  EXPECT_TRUE(told("zones.csv:3: dz_mm: 'x'"));
}

}  // namespace
}  // namespace tubesight::board
