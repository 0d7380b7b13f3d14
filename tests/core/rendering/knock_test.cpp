// Pictures of a camera that was knocked loose, against their truth.

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/drawn_sheet.h"

namespace tubesight::core::rendering {
namespace {

using tests::DrawnSheet;
using Picture = std::vector<std::uint8_t>;

/// The knock of a camera that is turned by `degrees` about one of its own axes: a point that stood
/// at p stands at R p [conventions.md, T_a_b].
Transform<frames::Camera, frames::Camera> knocked(int axis, double degrees) {
  const double c = std::cos(degrees * 3.14159265358979 / 180.0);
  const double s = std::sin(degrees * 3.14159265358979 / 180.0);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  const int next = (axis + 1) % 3;
  const int last = (axis + 2) % 3;
  R(next, next) = c;
  R(next, last) = -s;
  R(last, next) = s;
  R(last, last) = c;
  return {R, Eigen::Vector3d::Zero()};
}

class KnockedCamera : public ::testing::Test {
 protected:
  KnockedCamera() {
    tests::make_plain(sheet_.scene());
    sheet_.scene().guidetube.radius_mm = 0.0;
    EXPECT_TRUE(sheet_.configure());
  }

  /// The middle of the dark pixels in the box around a bore's image, px.
  std::array<double, 2> dark_middle(const Picture& picture, const Exposure& exposure,
                                    const std::array<double, 3>& sheet_mm) const {
    const auto pixel = sheet_.truth().image_of(exposure.opened, sheet_mm, exposure.knock);
    EXPECT_TRUE(pixel.has_value());
    const int u = static_cast<int>(std::lround((*pixel)[0]));
    const int v = static_cast<int>(std::lround((*pixel)[1]));
    constexpr int kHalf_u = 32;  // less than to the next bores
    constexpr int kHalf_v = 20;
    double sum = 0.0;
    std::array<double, 2> middle{};
    for (int y = v - kHalf_v; y <= v + kHalf_v; ++y) {
      for (int x = u - kHalf_u; x <= u + kHalf_u; ++x) {
        const double dark = picture[static_cast<std::size_t>(y * 635 + x)] < 40 ? 1.0 : 0.0;
        sum += dark;
        middle[0] += dark * x;
        middle[1] += dark * y;
      }
    }
    return {middle[0] / sum, middle[1] / sum};
  }
  std::array<double, 3> center(TubeAddress address) const {
    return sheet_.truth().tube_ends().at(address).center_mm;
  }

  mutable DrawnSheet sheet_;
};

TEST_F(KnockedCamera, SeesBoresWhereItsTruthSays) {
  for (const int axis : {0, 1, 2}) {
    for (const double degrees : {-1.0, 1.0}) {
      Exposure exposure = sheet_.exposure();
      exposure.knock = knocked(axis, degrees);
      const Picture picture = sheet_.draw(exposure);
      for (const TubeAddress tube : {TubeAddress{40, 57}, {40, 63}, {39, 58}}) {
        SCOPED_TRACE("axis " + std::to_string(axis) + ", " + std::to_string(degrees) +
                     " degrees, column " + std::to_string(tube.column));
        const auto knocked_px =
            sheet_.truth().image_of(exposure.opened, center(tube), exposure.knock);
        const auto calm_px = sheet_.truth().image_of(exposure.opened, center(tube));
        ASSERT_TRUE(knocked_px && calm_px);
        const auto dark = dark_middle(picture, exposure, center(tube));
        const auto from_dark = [&dark](const std::array<double, 2>& at) {
          return std::hypot(at[0] - dark[0], at[1] - dark[1]);
        };
        // The dark's middle, the ellipse's, is up to a pixel off the centre's image.
        EXPECT_LT(from_dark(*knocked_px), 1.5);
        // 1 degree moves all by 8 to 11 px, about the optical axis by less.
        EXPECT_GT(from_dark(*calm_px), axis == 2 ? 2.0 : 6.5);
      }
    }
  }
}

TEST_F(KnockedCamera, TurnedAboutItsYAxisMovesThePictureToTheRight) {
  // By hand: Ry(1 degree) turns the optical axis's points (0, 0, z) to (z sin 1, 0, z cos 1), x to
  // the right. On the sensor that is 5.06 mm * tan(1 degree) = 0.0883 mm, 0.0883 / (0.0084 / 1.021
  // * 768 / 635) = 8.88 px.
  Exposure exposure = sheet_.exposure();
  const std::array<double, 3> tube = center({41, 60});
  const auto before = dark_middle(sheet_.draw(exposure), exposure, tube);
  exposure.knock = knocked(1, 1.0);

  const auto after = dark_middle(sheet_.draw(exposure), exposure, tube);

  EXPECT_NEAR(after[0] - before[0], 8.88, 0.6);
  EXPECT_NEAR(after[1] - before[1], 0.0, 0.6);
}

}  // namespace
}  // namespace tubesight::core::rendering
