#pragma once

#include "core/kinematics/serial_arm.h"

namespace tubesight::core::kinematics {

/// An arm like the source's Cobra: three joints and a wrist, hanging tools below a tubesheet.
///
/// The source says of it [Fallon sec. 1.1.2]: 50 kg, lifts over 68 kg, full extension 1.94 m. The
/// split of the lengths and the limits are ours:
///
/// | joint | turns | a mm | d mm | twist | offset | limits |
/// |---|---|---|---|---|---|---|
/// | 1 | base about the vertical | 0 | 250 | 90° | 0° | ±175° |
/// | 2 | shoulder, up | 1000 | 0 | 0° | 0° | -30° .. 150° |
/// | 3 | elbow, up | 940 | 0 | 0° | 0° | -155° .. 155° |
/// | 4 | wrist, up | 0 | 0 | 90° | 0° | -200° .. 200° |
/// | 5 | wrist, sideways | 0 | 0 | 90° | 90° | ±60° |
/// | 6 | tool about its axis | 0 | 150 | 0° | 90° | ±270° |
///
/// The tool's tip is 180 mm beyond the last joint's frame. The base's z points up to the sheet. The
/// tool stands square to it when joints 2, 3 and 4 add up to 90° and joint 5 is 0, far from the
/// wrist's singular places at ±90° of joint 5; its heading is then the sum of joints 1 and 6.
[[nodiscard]] SerialArm cobra_arm();

/// A place in the middle of the arm's work, elbow up, tool square: from here inverse() keeps the
/// elbow up.
[[nodiscard]] JointVector cobra_ready();

}  // namespace tubesight::core::kinematics
