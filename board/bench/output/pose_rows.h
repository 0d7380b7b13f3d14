#pragma once

#include <string>
#include <string_view>

#include "core/pose/pose_estimate.h"

namespace tubesight::board {

/// First line of a `pose --csv` file, without the line feed.
inline constexpr std::string_view kPoseHeader =
    "image,tool_x_mm,tool_y_mm,tool_z_mm,tool_alpha_deg,tool_beta_deg,tool_gamma_deg,"
    "camera_x_mm,camera_y_mm,camera_z_mm,camera_alpha_deg,camera_beta_deg,camera_gamma_deg,"
    "sigma_x_mm,sigma_y_mm,sigma_z_mm,rms_px,tubes,row,column,offset_mm,"
    "sigma_alpha_deg,sigma_beta_deg,sigma_gamma_deg";

/// First line of a `pose --covariance` file: the upper triangle of the covariance of T_sheet_tool,
/// x, y, z and the rotation vector rx, ry, rz in the sheet frame.
inline constexpr std::string_view kCovarianceHeader =
    "image,x_x_mm2,x_y_mm2,x_z_mm2,x_rx_mm_rad,x_ry_mm_rad,x_rz_mm_rad,y_y_mm2,y_z_mm2,"
    "y_rx_mm_rad,y_ry_mm_rad,y_rz_mm_rad,z_z_mm2,z_rx_mm_rad,z_ry_mm_rad,z_rz_mm_rad,"
    "rx_rx_rad2,rx_ry_rad2,rx_rz_rad2,ry_ry_rad2,ry_rz_rad2,rz_rz_rad2";

/// What a row is written from.
struct PoseRow {
  std::string image;
  const core::pose::PoseEstimate* estimate = nullptr;  ///< null: refused, all cells stay empty
  core::math::Matrix6d covariance;                     ///< of the sigmas
  bool has_tool = true;                                ///< else the tool's cells stay empty
  bool has_tube = true;  ///< a tube stands at the nearest address; else its cells stay empty
};

/// Appends a row with its line feed: mm 4, deg 5, px 3 decimals, sigmas 4 (angles 5).
void append_pose_row(std::string& out, const PoseRow& row);
void append_covariance_row(std::string& out, const PoseRow& row);

/// Standard deviations of alpha, beta, gamma in rad, from the covariance of the rotation vector in
/// the sheet frame.
[[nodiscard]] Eigen::Vector3d angle_sigmas(const Eigen::Matrix3d& rotation,
                                           const core::math::Matrix6d& covariance);

}  // namespace tubesight::board
