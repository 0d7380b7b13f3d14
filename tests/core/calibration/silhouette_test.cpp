#include "core/calibration/silhouette.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "core/camera/camera_setup.h"
#include "tests/support/source_camera.h"

namespace tubesight::core::calibration {
namespace {

using CameraTool = Transform<frames::Camera, frames::Tool>;

constexpr std::int32_t kWidth = 635;
constexpr std::int32_t kHeight = 480;
constexpr GuidetubeShape kShape{18.2, 33.0};

camera::CameraModel<double> the_camera() {
  const auto made = camera::make_camera_model<double>(tests::source_camera());
  EXPECT_TRUE(made.has_value());
  return *made;
}

CameraTool tool_at(double x_mm) {
  return {rotation_from_degrees({-0.06, -0.8, 48.0}), {x_mm, 31.6, 112.8}};
}

/// Whether a ray meets the cylinder, by the quadratic of its side and the disc of its tip.
bool meets(const Eigen::Vector3d& eye, const Eigen::Vector3d& way) {
  const double radius = 0.5 * kShape.diameter_mm;
  const double a = way.head<2>().squaredNorm();
  const double b = eye.head<2>().dot(way.head<2>());
  const double c = eye.head<2>().squaredNorm() - radius * radius;
  const double root = b * b - a * c;
  if (root >= 0.0) {
    const double z = eye.z() + (-b - std::sqrt(root)) / a * way.z();
    if (z <= 0.0 && z >= -kShape.length_mm) {
      return true;
    }
  }
  const Eigen::Vector3d top = eye - eye.z() / way.z() * way;
  return eye.z() > 0.0 && top.head<2>().norm() <= radius;
}

/// A dark guidetube before a bright ground, by one ray for each quarter of a pixel.
std::vector<std::uint16_t> drawn(const CameraTool& T, double ground = 180.0) {
  const auto camera = the_camera();
  const auto back = T.inverse();
  std::vector<std::uint16_t> pixels;
  for (std::int32_t v = 0; v < kHeight; ++v) {
    for (std::int32_t u = 0; u < kWidth; ++u) {
      double inside = 0.0;
      for (const double du : {-0.25, 0.25}) {
        for (const double dv : {-0.25, 0.25}) {
          const auto plane = camera.to_plane({u + du, v + dv});
          const Eigen::Vector3d way = back.rotation() * Eigen::Vector3d(plane.x, plane.y, 1.0);
          inside += meets(back.translation_mm(), way) ? 0.25 : 0.0;
        }
      }
      pixels.push_back(static_cast<std::uint16_t>(
          std::lround(picture::kGreyScale * (30.0 * inside + ground * (1.0 - inside)))));
    }
  }
  return pixels;
}

double grey(const picture::AveragedPicture& picture, const Eigen::Vector2d& at) {
  const auto u = std::min(static_cast<std::int32_t>(at.x()), kWidth - 2);
  const auto v = std::min(static_cast<std::int32_t>(at.y()), kHeight - 2);
  const double du = at.x() - u;
  const double dv = at.y() - v;
  return ((1.0 - dv) * ((1.0 - du) * picture.at(u, v) + du * picture.at(u + 1, v)) +
          dv * ((1.0 - du) * picture.at(u, v + 1) + du * picture.at(u + 1, v + 1))) /
         picture::kGreyScale;
}

TEST(Silhouette, IsWhereRaysBeginToMeetTheGuidetube) {
  const auto pixels = drawn(tool_at(-3.0));
  const picture::AveragedPicture picture{pixels.data(), kWidth, kHeight};

  const Silhouette silhouette =
      computed_silhouette(the_camera(), tool_at(-3.0), kShape, kWidth, kHeight);

  for (const SilhouetteEdge& edge : silhouette.edges) {
    ASSERT_GE(edge.points_px.size(), 12);
    for (std::int32_t i = 1; i + 1 < edge.points_px.size(); ++i) {
      EXPECT_NEAR(grey(picture, edge.points_px[i]), 105.0, 45.0) << i;
    }
  }
  EXPECT_LT(silhouette.edge(SilhouettePart::kLeft).points_px[0].x(),
            silhouette.edge(SilhouettePart::kRight).points_px[0].x() - 50.0);
}

TEST(Silhouette, MovesToTheEdgesThatThePictureShows) {
  const auto pixels = drawn(tool_at(-2.4));
  const picture::AveragedPicture picture{pixels.data(), kWidth, kHeight};
  Silhouette silhouette = computed_silhouette(the_camera(), tool_at(-3.0), kShape, kWidth, kHeight);

  measure_silhouette(picture, 9.0, silhouette);

  for (const SilhouettePart part : {SilhouettePart::kLeft, SilhouettePart::kRight}) {
    const SilhouetteEdge& edge = silhouette.edge(part);
    EXPECT_TRUE(edge.measured);
    // 0.6 mm to the right: inwards on the left, outwards on the right.
    EXPECT_GT((part == SilhouettePart::kRight ? 1.0 : -1.0) * edge.shift_px, 2.0);
    EXPECT_LT(edge.sigma_px, 0.3);
    for (std::int32_t i = 2; i + 2 < edge.points_px.size(); ++i) {
      EXPECT_NEAR(grey(picture, edge.points_px[i]), 105.0, 50.0) << i;
    }
  }
}

// The left side comes near the picture's left edge at its lower end, and stands farther out.
TEST(Silhouette, LeavesOutPointsThatLeaveThePicture) {
  const auto pixels = drawn(tool_at(-59.2));
  const picture::AveragedPicture picture{pixels.data(), kWidth, kHeight};
  Silhouette silhouette =
      computed_silhouette(the_camera(), tool_at(-58.0), kShape, kWidth, kHeight);
  const std::int32_t computed = silhouette.edge(SilhouettePart::kLeft).points_px.size();

  measure_silhouette(picture, 9.0, silhouette);

  const SilhouetteEdge& left = silhouette.edge(SilhouettePart::kLeft);
  EXPECT_TRUE(left.measured);
  EXPECT_GT(left.shift_px, 4.0);
  EXPECT_LT(left.points_px.size(), computed);
  for (const SilhouetteEdge& edge : silhouette.edges) {
    for (const Eigen::Vector2d& at : edge.points_px) {
      EXPECT_TRUE(at.x() >= 0.0 && at.y() >= 0.0 && at.x() <= kWidth - 1.0 &&
                  at.y() <= kHeight - 1.0)
          << at.transpose();
    }
  }
}

TEST(Silhouette, StaysAsComputedWhereNothingIsSeen) {
  const auto pixels = drawn(tool_at(-3.0), 34.0);  // as dark as the guidetube
  const picture::AveragedPicture picture{pixels.data(), kWidth, kHeight};
  const Silhouette computed =
      computed_silhouette(the_camera(), tool_at(-3.0), kShape, kWidth, kHeight);
  Silhouette silhouette = computed;

  measure_silhouette(picture, 9.0, silhouette);

  for (std::size_t i = 0; i < kSilhouetteParts; ++i) {
    EXPECT_FALSE(silhouette.edges[i].measured);
    EXPECT_EQ(silhouette.edges[i].points_px[0], computed.edges[i].points_px[0]);
  }
}

TEST(Silhouette, TellsWhatItHides) {
  const Silhouette silhouette =
      computed_silhouette(the_camera(), tool_at(-3.0), kShape, kWidth, kHeight);
  const Eigen::Vector2d middle = 0.5 * (silhouette.edge(SilhouettePart::kLeft).points_px[8] +
                                        silhouette.edge(SilhouettePart::kRight).points_px[8]);
  picture::Rim behind;
  picture::Rim beside;
  picture::Rim above;
  const Eigen::Vector2d tip = silhouette.edge(SilhouettePart::kTip).points_px[12];
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d round(15.0 * std::cos(0.3 * i), 15.0 * std::sin(0.3 * i));
    picture::RimPoint point;
    const auto put = [&](picture::Rim& rim, const Eigen::Vector2d& at) {
      point.u_px = at.x();
      point.v_px = at.y();
      EXPECT_TRUE(rim.points.try_push_back(point));
    };
    put(behind, middle + round);
    put(beside, middle + round + Eigen::Vector2d(90.0, 0.0));
    put(above, tip + round - Eigen::Vector2d(0.0, 20.0));
  }

  EXPECT_EQ(points_hidden(silhouette, behind, 4.0), 20);
  EXPECT_EQ(points_hidden(silhouette, beside, 4.0), 0);
  EXPECT_EQ(points_hidden(silhouette, above, 4.0), 0);
}

}  // namespace
}  // namespace tubesight::core::calibration
