#include "board/bench/simulate/truth_rows.h"

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::rendering::TubeEndKind;

std::string_view word_of(TubeEndKind kind) {
  switch (kind) {
    case TubeEndKind::kOpen: return "open";
    case TubeEndKind::kPlugRolled: return "plug_rolled";
    case TubeEndKind::kPlugFlush: return "plug_flush";
    case TubeEndKind::kVoid: return "void";
  }
  return "";
}

/// A cell with its comma.
void append_number(std::string& out, double value, std::int32_t digits) {
  std::int64_t scale = 1;
  for (std::int32_t i = 0; i < digits; ++i) {
    scale *= 10;
  }
  drivers::append_decimal(out, std::llround(value * static_cast<double>(scale)), scale, digits);
  out += ',';
}

void append_number(std::string& out, std::int64_t value) {
  drivers::append_whole(out, value);
  out += ',';
}

void append_seconds(std::string& out, core::FieldTime time) {
  drivers::append_decimal(out, time.count(), 1'000'000'000, 6);
}

/// alpha, beta, gamma of R = Rz(alpha) Ry(beta) Rx(gamma), radians. Not core/math's on purpose: a
/// mistake there would hide if the truth that tests the pose were written with it.
std::array<double, 3> angles_of(const Eigen::Matrix3d& rotation) {
  return {std::atan2(rotation(1, 0), rotation(0, 0)),
          std::atan2(-rotation(2, 0), std::hypot(rotation(2, 1), rotation(2, 2))),
          std::atan2(rotation(2, 1), rotation(2, 2))};
}

void append_pose(std::string& out, const Eigen::Vector3d& place, const Eigen::Matrix3d& rotation) {
  for (int i = 0; i < 3; ++i) {
    append_number(out, place[i], 5);
  }
  for (const double angle : angles_of(rotation)) {
    append_number(out, angle, 8);
  }
}

}  // namespace

std::string fault_words(const drivers::FieldFaults& faults) {
  std::string words;
  for (std::int32_t kind = 0; kind < drivers::kFaultKinds; ++kind) {
    if (faults.has(static_cast<drivers::FaultKind>(kind))) {
      words += words.empty() ? "" : "+";
      words += drivers::name_of(static_cast<drivers::FaultKind>(kind));
    }
  }
  return words;
}

void append_truth_row(std::string& out, const FieldPlace& place,
                      const drivers::SimulatedField& field, const core::CameraSettings& camera,
                      double aligned_within_mm) {
  const drivers::FieldTruth& truth = field.truth;
  append_seconds(out, field.field.mid_exposure);
  out += ',';
  append_number(out, place.frame);
  append_number(out, place.field);
  append_pose(out, truth.T_sheet_tool.translation_mm(), truth.T_sheet_tool.rotation());
  append_number(out, truth.speed_mm_s, 2);
  // The truth's origin is on the sensor, a focal length behind the projection point.
  const Eigen::Matrix3d& rotation = truth.T_camera_sheet.rotation();
  const Eigen::Vector3d origin =
      truth.T_camera_sheet.translation_mm() + Eigen::Vector3d(0.0, 0.0, camera.focal_length_mm);
  append_pose(out, origin, rotation);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      append_number(out, rotation(row, column), 8);
    }
    append_number(out, origin[row], 8);
  }
  const auto& axis = truth.axis;
  const auto& nearest = axis.nearest;
  append_number(out, axis.axis_mm[0], 5);
  append_number(out, axis.axis_mm[1], 5);
  append_number(out, std::int64_t{nearest.address.row});
  append_number(out, std::int64_t{nearest.address.column});
  out += word_of(nearest.kind);
  out += ',';
  append_number(out, nearest.offset_mm, 4);
  append_number(out, nearest.off_mm[0], 4);
  append_number(out, nearest.off_mm[1], 4);
  const bool aligned = truth.axis_known && nearest.kind != TubeEndKind::kVoid &&
                       nearest.offset_mm <= aligned_within_mm;
  append_number(out, std::int64_t{aligned});
  append_number(out, std::int64_t{field.field.lamp_permille});
  out += fault_words(field.faults);
  out += truth.slip != std::array<std::int32_t, 2>{} ? ",1\n" : ",0\n";
}

void append_true_center_rows(std::string& out, const FieldPlace& place,
                             const drivers::SimulatedField& field,
                             const core::CameraSettings& camera,
                             const std::vector<drivers::TubeInView>& tubes) {
  for (const drivers::TubeInView& tube : tubes) {
    const auto& [u, v] = tube.image.center_px;
    if (u < 0.0 || v < 0.0 || u > camera.width_px - 1 || v > camera.height_px - 1) {
      continue;
    }
    append_number(out, place.frame);
    append_number(out, place.field);
    append_seconds(out, field.field.mid_exposure);
    out += ',';
    append_number(out, std::int64_t{tube.address.row});
    append_number(out, std::int64_t{tube.address.column});
    out += word_of(tube.end.kind);
    out += ',';
    append_number(out, u, 3);
    append_number(out, v, 3);
    append_number(out, tube.image.ellipse_px[0], 3);
    append_number(out, tube.image.ellipse_px[1], 3);
    append_number(out, tube.image.half_px[0], 2);
    append_number(out, tube.image.half_px[1], 2);
    append_number(out, tube.image.rim_in_frame, 2);
    append_number(out, tube.image.occluded, 2);
    append_number(out, 2.0 * tube.end.radius_mm, 4);
    append_number(out, tube.end.center_mm[0], 4);
    append_number(out, tube.end.center_mm[1], 4);
    out.back() = '\n';
  }
}

}  // namespace tubesight::board
