#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "drivers/files/messages.h"

namespace tubesight::drivers {

/// A camera's file as OpenCV's and ROS's calibrations write it.
struct CameraYaml {
  std::string name;  ///< camera_name; may be empty
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  std::array<double, 8> distortion{};  ///< k1, k2, p1, p2, k3, k4, k5, k6
};

/// How it is written; both are read.
enum class YamlManner : std::uint8_t {
  kRos,     ///< plain, as camera_info_manager and camera_calibration_parsers read it
  kOpencv,  ///< of cv::FileStorage: its first line and its tags, which strict readers refuse
};

/// Reads such a file, `text` of the file `name`: image_width, image_height, camera_matrix (or K)
/// and distortion_coefficients (or D) of 4, 5 or 8 numbers, or more where the others are 0;
/// distortion_model plumb_bob, rational_polynomial or none. A fisheye's model is refused by its
/// name, a skew as well.
///
/// Also a camera chain of Kalibr with one camera, cam0: camera_model pinhole, distortion_model
/// radtan (whose four numbers are OpenCV's first four) or none, resolution, intrinsics,
/// distortion_coeffs.
///
/// Errors: kInvalidArgument, and `messages` say where and why. At most 1 MiB.
[[nodiscard]] core::Result<void> read_camera_yaml(std::string_view text, const std::string& name,
                                                  CameraYaml& camera, Messages& messages);

/// The text of such a file.
[[nodiscard]] std::string camera_yaml_text(const CameraYaml& camera, YamlManner manner);

}  // namespace tubesight::drivers
