// In how many ways a lattice found in a picture can lie on the sheet's, and that the right one is
// among them.

#include "board/bench/cold_start/lattice_readings.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::TubeAddress;

class LatticeReadings : public ::testing::Test {
 protected:
  LatticeReadings() {
    sheet_->row_step_mm = {0.0, 25.4};
    sheet_->column_step_mm = {25.4, 0.0};
    sheet_->bore_mm = 18.6;
    sheet_->rows = {0, 100};
    sheet_->columns = {0, 100};
  }

  /// What the finder would tell of tubes (40 ± 3, 60 ± 3), seen aslant by 48 degrees, the tool
  /// turned by 20 degrees; `side` -1: the picture is mirrored.
  void draw(double side = 1.0) {
    core::CameraSettings camera;
    camera.width_px = 635;
    camera.height_px = 480;
    camera.focal_length_mm = 5.06;
    camera.cell_width_mm = 0.0084;
    camera.cell_height_mm = 0.0098;
    camera.sensor_columns = 768;
    camera.frame_columns = 635;
    camera.horizontal_scale = 1.021;
    camera.center_px = {317.0, 239.5};
    camera.distortion_per_mm2 = 0.0092;
    model_ = *core::pose::make_pose_model(camera, {}, *sheet_);
    const Eigen::Matrix3d turn = core::rotation_from_degrees({0.0, 0.0, 48.0}) *
                                 core::rotation_from_degrees({20.0, 0.0, 0.0});
    const Eigen::Vector2d middle = model_.center_mm({40, 60});
    for (std::int32_t row = -3; row <= 3; ++row) {
      for (std::int32_t column = -3; column <= 3; ++column) {
        const TubeAddress tube{40 + row, 60 + column};
        const Eigen::Vector2d at = model_.center_mm(tube) - middle;
        const Eigen::Vector3d p =
            turn * Eigen::Vector3d(at.x(), at.y(), 0.0) + Eigen::Vector3d(0.0, 0.0, 260.0);
        const auto pixel = model_.camera.to_pixel({p.x() / p.z(), p.y() / p.z()});
        ASSERT_TRUE(pixel);
        core::detection::LatticeElement element;
        element.row = row;
        element.column = static_cast<std::int32_t>(side) * column;
        element.center_px = {317.0 + side * (pixel->x - 317.0), pixel->y};
        anchor_ = row == 0 && column == 0 ? found_->elements.size() : anchor_;
        ASSERT_TRUE(found_->elements.try_push_back(element));
        tubes_.push_back(tube);
      }
    }
    const auto in_radii = [&](const std::array<double, 2>& step) {
      const double radius = 0.5 * sheet_->bore_mm;
      return Eigen::Vector2d(step[0] / radius, step[1] / radius);
    };
    found_->steps.row = in_radii(sheet_->row_step_mm);
    found_->steps.column = in_radii(sheet_->column_step_mm);
    if (side < 0.0) {
      found_->steps.column.x() *= -side;
      found_->steps.row.x() *= side;
    }
  }

  [[nodiscard]] std::vector<LatticeReading> readings() const {
    return find_readings(*found_, anchor_, {40, 60}, model_, *sheet_);
  }

  [[nodiscard]] int right(const std::vector<LatticeReading>& readings) const {
    return static_cast<int>(
        std::count_if(readings.begin(), readings.end(), [&](const LatticeReading& reading) {
          return reading.tubes == tubes_ && reading.rms_px < 0.01;
        }));
  }

  std::unique_ptr<core::TubesheetSettings> sheet_ = std::make_unique<core::TubesheetSettings>();
  std::unique_ptr<core::detection::FoundLattice> found_ =
      std::make_unique<core::detection::FoundLattice>();
  core::pose::PoseModel model_;
  std::int32_t anchor_ = 0;
  std::vector<TubeAddress> tubes_;
};

TEST_F(LatticeReadings, OfASquareSheetAreFour) {
  draw();

  EXPECT_EQ(readings().size(), 4U);
  EXPECT_EQ(right(readings()), 1);
}

TEST_F(LatticeReadings, OfATriangularSheetAreSix) {
  sheet_->row_step_mm = {12.7, 21.997};
  draw();

  EXPECT_EQ(readings().size(), 6U);
  EXPECT_EQ(right(readings()), 1);
}

TEST_F(LatticeReadings, OfAnyOtherSheetAreTwo) {
  sheet_->row_step_mm = {6.0, 27.0};
  draw();

  EXPECT_EQ(readings().size(), 2U);
  EXPECT_EQ(right(readings()), 1);
}

TEST_F(LatticeReadings, OfSidesThatDifferByATwentiethAreTwoByTheCamera) {
  sheet_->row_step_mm = {0.0, 26.7};
  draw();

  EXPECT_EQ(readings().size(), 2U);
  EXPECT_EQ(right(readings()), 1);
}

TEST_F(LatticeReadings, OfAMirroredObliqueSheetAreNone) {
  sheet_->row_step_mm = {8.0, 27.0};
  draw(-1.0);

  EXPECT_EQ(readings().size(), 0U);
}

TEST_F(LatticeReadings, OfElementsOfAnotherSizeAreNone) {
  draw();
  found_->steps.row *= 1.4;
  found_->steps.column *= 1.4;

  EXPECT_EQ(readings().size(), 0U);
}

}  // namespace
}  // namespace tubesight::board
