#include "board/bench/simulate/event_rows.h"

#include <array>
#include <cmath>

#include "core/base/names.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

void append_address(std::string& out, core::TubeAddress address) {
  drivers::append_whole(out, address.row);
  out += ',';
  drivers::append_whole(out, address.column);
}

void append_scaled(std::string& out, double value, std::int32_t digits) {
  const double scale = std::pow(10.0, digits);
  drivers::append_decimal(out, std::llround(value * scale), std::llround(scale), digits);
}

void append_pose_result(std::string& out, const core::PoseResult& pose) {
  if (pose.reason != core::PoseReason::kNone) {
    out += core::name_of(pose.reason);
    return;
  }
  drivers::append_whole(out, pose.tubes);
  out += ',';
  append_address(out, pose.nearest);
  const auto append = [&out](std::int64_t value, std::int32_t digits, std::int64_t scale) {
    out += ',';
    drivers::append_decimal(out, value, scale, digits);
  };
  constexpr std::int64_t kMillimetre_nm = 1'000'000;
  constexpr std::int64_t kDegree_ndeg = 1'000'000'000;
  const auto append_six = [&append](const std::array<std::int64_t, 3>& lengths_nm,
                                    const std::array<std::int64_t, 3>& angles_ndeg) {
    for (const std::int64_t value : lengths_nm) {
      append(value, 6, kMillimetre_nm);
    }
    for (const std::int64_t value : angles_ndeg) {
      append(value, 9, kDegree_ndeg);
    }
  };
  append_six(pose.position_nm, pose.angles_ndeg);
  append_six(pose.position_sigma_nm, pose.angle_sigma_ndeg);
  append(pose.offset_nm, 6, kMillimetre_nm);
}

/// The columns `kind,values`.
void append_kind_and_values(std::string& out, const core::Event& event) {
  switch (event.kind) {
    case core::EventKind::kClaim:
      out += "claim,\"";
      append_address(out, event.claim);
      out += '"';
      break;
    case core::EventKind::kStart:
      out += "start,\"";
      for (std::int32_t i = 0; i < event.start.size(); ++i) {
        out += i > 0 ? ";" : "";
        append_address(out, event.start[i].address);
        for (const double place : event.start[i].at_px) {
          out += ',';
          append_scaled(out, place, 3);
        }
      }
      out += '"';
      break;
    case core::EventKind::kLampCommand:
      out += "lamp,";
      drivers::append_whole(out, event.lamp_permille);
      break;
    case core::EventKind::kPoseRequest: out += "pose,"; break;
    case core::EventKind::kPick:
      out += "pick,\"";
      append_scaled(out, event.pick_px[0], 3);
      out += ',';
      append_scaled(out, event.pick_px[1], 3);
      out += '"';
      break;
    case core::EventKind::kAcknowledge: out += "acknowledge,"; break;
    case core::EventKind::kPoseResult:
      out += "pose-result,\"";
      append_pose_result(out, event.pose);
      out += '"';
      break;
  }
}

}  // namespace

void append_event_row(std::string& out, std::int64_t field, core::FieldTime time,
                      const core::Event& event) {
  drivers::append_whole(out, field);
  out += ',';
  drivers::append_decimal(out, time.count(), kSecond_ns, 6);
  out += ',';
  append_kind_and_values(out, event);
  out += '\n';
}

void append_meta_row(std::string& out, std::int64_t number, const core::Field& field,
                     std::int32_t lamp_permille) {
  drivers::append_whole(out, number);
  out += ',';
  drivers::append_whole(out, field.sequence);
  out += ',';
  drivers::append_decimal(out, field.mid_exposure.count(), kSecond_ns, 9);
  out += field.status == core::FieldStatus::kGood ? ",good," : ",damaged,";
  drivers::append_whole(out, lamp_permille);
  out += '\n';
}

}  // namespace tubesight::board
