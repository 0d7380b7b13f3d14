#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "core/base/event.h"
#include "core/base/frames.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/base/transform.h"
#include "core/base/tube_address.h"
#include "core/kinematics/installed_arm.h"
#include "core/kinematics/joint_drive.h"
#include "core/kinematics/tool_path.h"
#include "core/rendering/tube_ends.h"
#include "drivers/simulated/robot_settings.h"
#include "drivers/simulated/tool_motion.h"

namespace tubesight::drivers {

/// A robot that moves the tool of a simulated world and talks like a controller.
///
/// It plans where its tool goes in the sheet as it believes it to lie, turns its joints to where
/// the believed arm says, and what stands there is the tool on the true arm: all errors and
/// deflections of arm_errors.h lie between. Its claims come from the joints' readings through the
/// believed arm, as the source describes a robot without a camera [Fallon sec. 1.1.2].
///
/// Time is the world's: the last instant that pose_at() was asked for. One thread. Some 1.2 MB:
/// heap or static.
class SimulatedRobot final : public ToolMotion {
 public:
  SimulatedRobot() = default;
  SimulatedRobot(const SimulatedRobot&) = delete;
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

  /// Stands still at home, before time 0. `sheet` is the plant's drawing: addresses and lattice.
  ///
  /// Errors: kOutOfRange home is out of the arm's reach, kInvalidArgument a number is not finite or
  /// the sheet is none, kIllConditioned as core::kinematics::reach().
  [[nodiscard]] core::Result<void> configure(const SimulatedRobotSettings& settings,
                                             const core::TubesheetSettings& sheet);

  /// Moves the tool straight to where the robot believes a tube, after what it was told before.
  ///
  /// Errors: kOutOfRange the way leaves the arm's reach, kBufferTooSmall too many commands are
  /// waiting, kInvalidArgument as ToolPath::add(), or a jump, which no robot can.
  [[nodiscard]] core::Result<void> move_to(core::TubeAddress tube);

  /// The same with any segment of a path, in the sheet as believed.
  [[nodiscard]] core::Result<void> add(const core::kinematics::PathSegment& segment);

  /// Sends a message to the box; false when kMaxMessages are waiting, and it is not sent.
  /// Messages without an id or an instant of their own get the next number and the robot's time,
  /// and a pose request without a pose the robot's own, as told_pose() has it.
  bool say(const core::Event& event);

  /// The tool's true place; turns the joints to that instant. An earlier instant than the last is
  /// answered without turning back. Where the arm can't follow, it stays: see stuck().
  [[nodiscard]] core::Transform<core::frames::Sheet, core::frames::Tool> pose_at(
      double time_s) override;

  [[nodiscard]] double now_s() const { return now_s_; }
  /// All commands are carried out.
  [[nodiscard]] bool at_rest() const {
    return path_.size() == 0 || now_s_ - path_zero_s_ >= path_.duration_s();
  }
  /// The way led out of the arm's reach at some instant.
  [[nodiscard]] bool stuck() const { return stuck_; }

  /// Where the robot believes its tool: the joints' readings through the believed arm.
  [[nodiscard]] core::Transform<core::frames::Sheet, core::frames::Tool> believed_pose() const;
  /// The same in the robot's own base, with the joints' readings: what a controller tells.
  [[nodiscard]] core::RobotPose told_pose() const;
  /// The tube that the robot believes nearest to its tool's axis; empty where none stands.
  [[nodiscard]] std::optional<core::TubeAddress> believed_tube() const;
  [[nodiscard]] const core::kinematics::InstalledArm& true_arm() const { return true_; }

  /// Takes a pose that the box has measured for truth: from now on the base is believed where that
  /// makes it [Fallon sec. 5.3, local calibration points]. kNotReady: the tool moves.
  [[nodiscard]] core::Result<void> correct_base(
      const core::Transform<core::frames::Sheet, core::frames::Tool>& seen);

  /// Messages that wait to be sent.
  static constexpr std::int32_t kMaxMessages = 32;
  /// The robot's end of the line: the next message, or what the box sends.
  [[nodiscard]] std::optional<core::Event> take_message();
  void hear(const core::Reply& reply);
  void hear(const core::Sighting& sighting);

  /// What the robot has heard.
  struct Heard {
    std::int64_t replies = 0;
    std::int64_t sightings = 0;
    std::int64_t confirmed = 0;     ///< claims
    std::int64_t contradicted = 0;  ///< claims
    std::int64_t unknown = 0;       ///< claims
    std::optional<core::ClaimReply> last_claim;
    std::optional<core::PoseRequestReply> last_request;  ///< answer to a pose request
    std::optional<core::PoseReply> last_pose;            ///< and the pose itself
  };
  [[nodiscard]] const Heard& heard() const { return heard_; }

 private:
  [[nodiscard]] core::kinematics::JointVector shafts_at(double time_s);
  [[nodiscard]] core::Result<core::kinematics::JointVector> walk(
      const core::kinematics::ToolPlace& from, const core::kinematics::ToolPlace& to) const;
  void claim_when_due();

  SimulatedRobotSettings settings_;
  core::kinematics::InstalledArm believed_;
  core::kinematics::InstalledArm true_;
  core::rendering::TubeEnds tubes_;
  core::kinematics::ToolPath path_;
  core::kinematics::JointDrive drive_;
  core::kinematics::JointVector shafts_rad_{};
  core::kinematics::JointVector end_rad_{};  ///< where the commands so far end
  double path_zero_s_ = 0.0;                 ///< when the path begins
  double now_s_ = 0.0;
  double next_claim_s_ = 0.0;
  bool stuck_ = false;
  core::StaticVector<core::Event, kMaxMessages> messages_;
  std::int64_t last_id_ = 0;
  Heard heard_;
};

}  // namespace tubesight::drivers
