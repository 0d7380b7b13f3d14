#include "drivers/simulated/fault_schedule.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "core/base/trigonometry.h"

namespace tubesight::drivers {
namespace {

/// Rotation by an angle about an axis of any length [Rodrigues].
Eigen::Matrix3d rotation_about(const std::array<double, 3>& axis, double angle_rad) {
  const Eigen::Vector3d direction = Eigen::Vector3d(axis[0], axis[1], axis[2]).normalized();
  Eigen::Matrix3d cross;
  cross << 0.0, -direction.z(), direction.y(),  //
      direction.z(), 0.0, -direction.x(),       //
      -direction.y(), direction.x(), 0.0;
  return Eigen::Matrix3d::Identity() + std::sin(angle_rad) * cross +
         (1.0 - std::cos(angle_rad)) * cross * cross;
}

bool at_work(const Fault& fault, const FieldSlot& slot) {
  // Times that should be equal differ in their last bits: a nanosecond is nothing here.
  constexpr double kNothing_s = 1e-9;
  const bool frames = by_frames(fault.kind);
  const double time_s = (frames ? slot.frame_time_s : slot.time_s) + kNothing_s;
  if (time_s < fault.at_s) {
    return false;
  }
  if (fault.kind == FaultKind::kLampDrift || fault.kind == FaultKind::kSkip) {
    return true;  // it stays where it drifted to, and what was left out does not come
  }
  if (fault.for_s > 0.0) {
    return time_s < fault.at_s + fault.for_s;
  }
  // The first one at or after at_s is the one whose forerunner was before: a window of a period's
  // length would miss it, or hit two, by the nanosecond to which the instants are rounded.
  const double before_s = (frames ? slot.frame_time_before_s : slot.time_before_s) + kNothing_s;
  return lasts_to_the_end(fault.kind) || before_s < fault.at_s;
}

void apply_to_light(const Fault& fault, double time_s, FieldFaults& to) {
  if (fault.kind == FaultKind::kLampOut) {
    to.lamp *= fault.level;
  } else if (fault.kind == FaultKind::kLampsDead) {
    to.dead_lamps = static_cast<std::uint16_t>(to.dead_lamps | fault.lamps);
  } else if (fault.kind == FaultKind::kLampDrift) {
    const double done =
        fault.for_s > 0.0 ? std::clamp((time_s - fault.at_s) / fault.for_s, 0.0, 1.0) : 1.0;
    to.lamp *= 1.0 + done * (fault.level - 1.0);
  }
}

void apply_to_view(const Fault& fault, FieldFaults& to) {
  switch (fault.kind) {
    case FaultKind::kBlots: to.blots_share = std::max(to.blots_share, fault.share); break;
    case FaultKind::kReflections:
      to.reflections_share = std::max(to.reflections_share, fault.share);
      break;
    case FaultKind::kGhost: to.ghost_share = std::max(to.ghost_share, fault.share); break;
    case FaultKind::kBlackLevel: to.black_level = std::array{fault.level, fault.share}; break;
    case FaultKind::kCovered:
      to.covered = std::array{fault.level, fault.share};
      to.covered_left = fault.told;
      break;
    default: break;
  }
}

void apply_to_picture(const Fault& fault, FieldFaults& to) {
  switch (fault.kind) {
    case FaultKind::kRepeated: to.repeated = true; break;
    case FaultKind::kTorn: to.torn_after = fault.share; break;
    case FaultKind::kSwapped: to.swapped = true; break;
    case FaultKind::kBlack: to.filled = static_cast<std::uint8_t>(fault.level); break;
    case FaultKind::kSaturated: to.filled = std::uint8_t{255}; break;
    case FaultKind::kSignalLoss:
      to.snow = true;
      to.damaged = to.damaged || fault.told;
      break;
    case FaultKind::kFrozen: to.frozen = true; break;
    case FaultKind::kOtherCamera:
      to.other_camera = true;
      to.elsewhere = {fault.rows, fault.columns};
      break;
    case FaultKind::kEmi:
      to.emi_share = std::max(to.emi_share, fault.share);
      to.emi_amplitude = std::max(to.emi_amplitude, fault.amplitude);
      break;
    case FaultKind::kSaltPepper:
      to.salt_pepper_share = std::max(to.salt_pepper_share, fault.share);
      break;
    case FaultKind::kHeld:
      to.held_share = fault.share;
      to.held_noise = fault.amplitude;
      break;
    case FaultKind::kCompressed: to.coarseness = fault.amplitude; break;
    default: apply_to_view(fault, to); break;
  }
}

void apply(const Fault& fault, const FieldSlot& slot, FieldFaults& to) {
  to.kinds |= std::uint32_t{1} << static_cast<unsigned>(fault.kind);
  switch (fault.kind) {
    case FaultKind::kDropped: to.lost = true; break;
    case FaultKind::kCut:
      to.lost = true;
      to.unnumbered = to.unnumbered || !fault.told;
      break;
    case FaultKind::kKnock:
      to.knocked = true;
      to.knock = core::Transform<core::frames::Camera, core::frames::Camera>(
                     rotation_about(fault.axis, fault.angle_deg * core::kPi / 180.0),
                     Eigen::Vector3d::Zero()) *
                 to.knock;
      break;
    case FaultKind::kJump:
      to.jump[0] += fault.rows;
      to.jump[1] += fault.columns;
      break;
    case FaultKind::kSkip: to.skipped_s += fault.for_s; break;
    case FaultKind::kPoseStep:
      to.off =
          to.off * core::Transform<core::frames::Tool, core::frames::Tool>(
                       core::rotation_from_degrees(
                           {fault.shake_deg[2], fault.shake_deg[1], fault.shake_deg[0]}),
                       Eigen::Vector3d(fault.shake_mm[0], fault.shake_mm[1], fault.shake_mm[2]));
      break;
    case FaultKind::kJitter: to.waver_s = std::max(to.waver_s, fault.waver_ms / 1000.0); break;
    default:
      apply_to_light(fault, slot.time_s, to);
      apply_to_picture(fault, to);
      break;
  }
}

}  // namespace

FieldFaults faults_of(std::span<const Fault> faults, const FieldSlot& slot) {
  FieldFaults all;
  for (const Fault& fault : faults) {
    if (at_work(fault, slot)) {
      apply(fault, slot, all);
    }
  }
  return all;
}

core::Transform<core::frames::Tool, core::frames::Tool> shake_at(std::span<const Fault> faults,
                                                                 double time_s) {
  core::Transform<core::frames::Tool, core::frames::Tool> shaken;
  for (const Fault& fault : faults) {
    if (fault.kind != FaultKind::kVibration || time_s < fault.at_s ||
        time_s >= fault.at_s + fault.for_s) {
      continue;
    }
    // Each axis swings at a frequency and phase of its own, so that the tip draws no line; all
    // begin and end gently, in a twentieth of a second, as a struck arm does.
    constexpr double kRise_s = 0.05;
    const double since_s = time_s - fault.at_s;
    const double left_s = fault.at_s + fault.for_s - time_s;
    const double envelope = std::min({1.0, since_s / kRise_s, left_s / kRise_s});
    std::array<double, 3> by{};
    std::array<double, 3> turn{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double number = static_cast<double>(i);
      const double angle_rad = 2.0 * core::kPi * fault.frequency_hz * since_s;
      by[i] = envelope * fault.shake_mm[i] * std::sin(angle_rad * (1.0 + 0.13 * number) + number);
      turn[i] =
          envelope * fault.shake_deg[i] * std::cos(angle_rad * (1.07 - 0.11 * number) + number);
    }
    shaken = shaken * core::Transform<core::frames::Tool, core::frames::Tool>(
                          core::rotation_from_degrees({turn[2], turn[1], turn[0]}),
                          Eigen::Vector3d(by[0], by[1], by[2]));
  }
  return shaken;
}

}  // namespace tubesight::drivers
