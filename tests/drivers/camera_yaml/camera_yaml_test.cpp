// Cameras of OpenCV and ROS: files as those programs write them, and what must be refused.

#include "drivers/camera_yaml/camera_yaml.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/replaced_text.h"

namespace tubesight::drivers {
namespace {

// As ROS's camera_calibration writes it.
const std::string kRosFile =
    "image_width: 640\nimage_height: 480\ncamera_name: narrow_stereo\ncamera_matrix:\n"
    "  rows: 3\n  cols: 3\n  data: [438.78, 0.0, 305.59, 0.0, 437.35, 243.74, 0.0, 0.0, 1.0]\n"
    "distortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n"
    "  data: [-0.3614, 0.1108, 0.0012, -0.0003, 0.0]\nrectification_matrix:\n  rows: 3\n"
    "  cols: 3\n  data: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\n";

// As OpenCV's calibration program writes it, shortened.
const std::string kOpencvFile =
    "%YAML:1.0\n---\ncalibration_time: \"Mon 01 Jan 2024 10:00:00\"\nimage_width: 640\n"
    "image_height: 480\nfisheye_model: 0\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n"
    "   dt: d\n   data: [ 5.3591573396163199e+02, 0., 3.4228315473308373e+02, 0.,\n"
    "       5.3591573396163199e+02, 2.3557082909788173e+02, 0., 0., 1. ]\n"
    "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
    "   data: [ -2.6637260909660682e-01, -3.8588898922304653e-02,\n"
    "       1.7831947042852964e-03, -2.8122100441115472e-04,\n       2.3839153080878486e-01 ]\n";

// As Kalibr writes the chain of one camera.
const std::string kKalibrFile =
    "cam0:\n  cam_overlaps: []\n  camera_model: pinhole\n"
    "  distortion_coeffs: [-0.2834, 0.0739, 0.00019, 0.000018]\n  distortion_model: radtan\n"
    "  intrinsics: [458.654, 457.296, 367.215, 248.375]\n  resolution: [752, 480]\n"
    "  rostopic: /cam0/image_raw\n";

CameraYaml read(const std::string& text) {
  CameraYaml camera;
  Messages messages;
  EXPECT_TRUE(read_camera_yaml(text, "c.yaml", camera, messages));
  EXPECT_EQ(messages, Messages());
  return camera;
}

TEST(CameraYaml, OfRosIsRead) {
  const CameraYaml camera = read(kRosFile);
  EXPECT_EQ(camera.name, "narrow_stereo");
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.fx_px, 438.78);
  EXPECT_EQ(camera.fy_px, 437.35);
  EXPECT_EQ(camera.cx_px, 305.59);
  EXPECT_EQ(camera.cy_px, 243.74);
  EXPECT_EQ(camera.distortion, (std::array{-0.3614, 0.1108, 0.0012, -0.0003, 0.0, 0.0, 0.0, 0.0}));
}

TEST(CameraYaml, OfOpencvIsReadWithItsFirstLineAndTags) {
  const CameraYaml camera = read(kOpencvFile);
  EXPECT_EQ(camera.fx_px, 535.91573396163199);
  EXPECT_EQ(camera.cy_px, 235.57082909788173);
  EXPECT_EQ(camera.distortion[1], -0.038588898922304653);
  EXPECT_EQ(camera.distortion[4], 0.23839153080878486);
}

TEST(CameraYaml, OfFlatListsIsRead) {
  const CameraYaml camera =
      read("width: 10\nheight: 20\nK: [1, 0, 2, 0, 3, 4, 0, 0, 1]\nD: [+1e-1, .2, 3, 4]\n");
  EXPECT_EQ(camera.fy_px, 3.0);
  EXPECT_EQ(camera.distortion, (std::array{0.1, 0.2, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0}));
}

TEST(CameraYaml, OfKalibrIsRead) {
  const CameraYaml camera = read(kKalibrFile);
  EXPECT_EQ(camera.width_px, 752);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.fx_px, 458.654);
  EXPECT_EQ(camera.fy_px, 457.296);
  EXPECT_EQ(camera.cx_px, 367.215);
  EXPECT_EQ(camera.cy_px, 248.375);
  EXPECT_EQ(camera.distortion,
            (std::array{-0.2834, 0.0739, 0.00019, 0.000018, 0.0, 0.0, 0.0, 0.0}));
}

TEST(CameraYaml, RefusesOfKalibrWhatItCannotServe) {
  const auto expect = [](const std::string& before, const std::string& after,
                         const std::string& said) {
    CameraYaml camera;
    Messages messages;
    EXPECT_FALSE(read_camera_yaml(support::replaced(kKalibrFile, before, after), "k.yaml", camera,
                                  messages));
    EXPECT_EQ(messages, Messages{said});
  };
  expect("radtan", "equidistant",
         "k.yaml:5: distortion_model: 'equidistant', a fisheye's, expected radtan");
  expect("radtan", "fov", "k.yaml:5: distortion_model: 'fov', a fisheye's, expected radtan");
  expect("pinhole", "omni", "k.yaml:3: camera_model: 'omni', a fisheye's, expected pinhole");
  expect("pinhole", "ds", "k.yaml:3: camera_model: 'ds', expected pinhole");
  expect("[752, 480]", "[752.5, 480]",
         "k.yaml:7: resolution: expected width and height, whole pixels from 1 to 16384");
  expect("458.654, ", "", "k.yaml:6: intrinsics: 3 numbers, expected 4");
  expect("458.654", "-1", "k.yaml:6: intrinsics: expected fu, fv, pu, pv with fu and fv above 0");
  expect("  rostopic", "cam1:\n  rostopic",
         "k.yaml:9: cam1: a second camera, expected one: leave the one that sees the tubesheet, as "
         "cam0");
}

TEST(CameraYaml, ReadsBackWhatItWroteInBothManners) {
  CameraYaml camera;
  camera.name = "a \"b\" \\ c";
  camera.width_px = 635;
  camera.height_px = 480;
  camera.fx_px = 508.51234567890123;
  camera.fy_px = 516.0;
  camera.cx_px = 1.0 / 3.0;
  camera.cy_px = 233.8;
  camera.distortion = {-0.1, 1e-300, 0.0, 0.0, -2.5e-7, 0.0, 0.0, 0.0};
  for (const YamlManner manner : {YamlManner::kRos, YamlManner::kOpencv}) {
    for (const double k6 : {0.0, 0.001}) {
      camera.distortion[7] = k6;
      const CameraYaml again = read(camera_yaml_text(camera, manner));
      EXPECT_EQ(again.name, camera.name);
      EXPECT_EQ(again.width_px, 635);
      EXPECT_EQ(again.fx_px, camera.fx_px);
      EXPECT_EQ(again.fy_px, camera.fy_px);
      EXPECT_EQ(again.cx_px, camera.cx_px);
      EXPECT_EQ(again.cy_px, camera.cy_px);
      EXPECT_EQ(again.distortion, camera.distortion);
    }
  }
}

TEST(CameraYaml, RefusesWithPlaceWhatItCannotServe) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& said) {
    CameraYaml camera;
    Messages messages;
    EXPECT_FALSE(
        read_camera_yaml(support::replaced(kRosFile, from, to), "c.yaml", camera, messages));
    ASSERT_EQ(messages.size(), 1U) << said;
    EXPECT_EQ(messages[0], said);
  };
  expect("plumb_bob", "equidistant",
         "c.yaml:8: distortion_model: 'equidistant', a fisheye's, expected plumb_bob or "
         "rational_polynomial");
  expect("plumb_bob", "thin_prism",
         "c.yaml:8: distortion_model: 'thin_prism', expected plumb_bob or rational_polynomial");
  expect("camera_name: narrow_stereo", "fisheye_model: 1",
         "c.yaml:3: fisheye_model: '1', a fisheye's, expected 0");
  expect("image_width: 640", "image_width: 640.5",
         "c.yaml:1: image_width: '640.5', expected whole pixels from 1 to 16384");
  expect("image_height: 480\n", "",
         "c.yaml: image_height: missing, expected whole pixels from 1 to 16384");
  expect("438.78, 0.0", "438.78, 0.1",
         "c.yaml:5: camera_matrix: expected fx, 0, cx, 0, fy, cy, 0, 0, 1 with fx and fy above 0 "
         "and no skew");
  expect("438.78", "-1",
         "c.yaml:5: camera_matrix: expected fx, 0, cx, 0, fy, cy, 0, 0, 1 with fx and fy above 0 "
         "and no skew");
  expect("438.78", ".nan", "c.yaml:7: camera_matrix: '.nan', expected a number");
  expect("camera_matrix", "matrix",
         "c.yaml: camera_matrix: missing, expected numbers, or a matrix with its data");
  expect(", 0.1108, 0.0012, -0.0003, 0.0]", ", 0.1]",
         "c.yaml:10: distortion_coefficients: 2 numbers, expected 4, 5 or 8");
  expect("-0.0003, 0.0]", "-0.0003, 0, 0, 0, 0, 0.01]",
         "c.yaml:12: distortion_coefficients: a term beyond k6 that is not 0, expected at most 8 "
         "numbers");
  expect("image_width: 640", "image_width: [640",
         "c.yaml:2: no YAML: did not find expected ',' or ']'");
}

TEST(CameraYaml, RefusesWhatIsNoCameraAtAll) {
  CameraYaml camera;
  Messages messages;
  EXPECT_FALSE(read_camera_yaml("", "c.yaml", camera, messages));
  EXPECT_FALSE(read_camera_yaml("- 1\n- 2\n", "c.yaml", camera, messages));
  EXPECT_FALSE(read_camera_yaml(std::string(2U << 20U, ' '), "c.yaml", camera, messages));
  EXPECT_EQ(messages,
            (Messages{"c.yaml: no keys with values, expected a camera as OpenCV or ROS write it",
                      "c.yaml: no keys with values, expected a camera as OpenCV or ROS write it",
                      "c.yaml: more than 1 MiB, expected a camera's file"}));
}

}  // namespace
}  // namespace tubesight::drivers
