#include "board/bench/output/pose_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "board/bench/output/csv_cells.h"
#include "core/math/rotation.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

template <typename To, typename From>
void append_transform(std::string& out, const core::Transform<To, From>& T) {
  for (int i = 0; i < 3; ++i) {
    append_cell(out, T.translation_mm()(i), 4);
  }
  for (const double angle : core::math::angles_of(T.rotation())) {
    append_cell(out, angle * kDegrees, 5);
  }
}

}  // namespace

Eigen::Vector3d angle_sigmas(const Eigen::Matrix3d& rotation,
                             const core::math::Matrix6d& covariance) {
  return core::math::angle_covariance(rotation, covariance.bottomRightCorner<3, 3>())
      .diagonal()
      .cwiseMax(0.0)
      .cwiseSqrt();
}

void append_pose_row(std::string& out, const PoseRow& row) {
  append_text(out, row.image);
  if (row.estimate == nullptr) {
    const auto cells = std::count(kPoseHeader.begin(), kPoseHeader.end(), ',');
    out.append(static_cast<std::size_t>(cells), ',');
    out += '\n';
    return;
  }
  const core::pose::PoseEstimate& pose = *row.estimate;
  if (row.has_tool) {
    append_transform(out, pose.T_sheet_tool);
  } else {
    out += ",,,,,,";
  }
  append_transform(out, pose.T_camera_sheet);
  for (int i = 0; i < 3; ++i) {
    if (row.has_tool) {
      append_cell(out, std::sqrt(std::max(0.0, row.covariance(i, i))), 4);
    } else {
      out += ',';
    }
  }
  append_cell(out, pose.rms_px, 3);
  out += ',';
  drivers::append_whole(out, pose.tubes);
  if (row.has_tool) {
    if (row.has_tube) {
      out += ',';
      drivers::append_whole(out, pose.nearest.row);
      out += ',';
      drivers::append_whole(out, pose.nearest.column);
      append_cell(out, pose.offset_mm, 4);
    } else {
      out += ",,,";
    }
    const Eigen::Vector3d sigmas = angle_sigmas(pose.T_sheet_tool.rotation(), row.covariance);
    for (int i = 0; i < 3; ++i) {
      append_cell(out, sigmas(i) * kDegrees, 5);
    }
  } else {
    out += ",,,,,,";
  }
  out += '\n';
}

void append_covariance_row(std::string& out, const PoseRow& row) {
  append_text(out, row.image);
  for (int i = 0; i < 6; ++i) {
    for (int k = i; k < 6; ++k) {
      out += ',';
      if (row.estimate != nullptr && row.has_tool) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.9e", row.covariance(i, k));
        out += text.data();
      }
    }
  }
  out += '\n';
}

}  // namespace tubesight::board
