#include "drivers/simulated/simulated_robot.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include "core/base/trigonometry.h"
#include "core/rendering/scene.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Event;
using core::Reply;
using core::Result;
using core::Transform;
using core::TubeAddress;
using core::Unexpected;
using core::kinematics::InverseOptions;
using core::kinematics::JointVector;
using core::kinematics::PathSegment;
using core::kinematics::ToolPlace;

using SheetTool = Transform<core::frames::Sheet, core::frames::Tool>;

/// Before the first instant that a world can ask for.
constexpr double kBeforeAll_s = -1e6;

/// Following a path, the arm must not change its configuration.
constexpr InverseOptions follow() {
  InverseOptions options;
  options.restarts = 0;
  return options;
}

ToolPlace place_of(const SheetTool& pose) {
  const auto& R = pose.rotation();
  const double degrees = 180.0 / core::kPi;
  return {pose.translation_mm().x(),     pose.translation_mm().y(),
          -pose.translation_mm().z(),    degrees * std::atan2(R(1, 0), R(0, 0)),
          degrees * std::asin(-R(2, 0)), degrees * std::atan2(R(2, 1), R(2, 2))};
}

}  // namespace

Result<void> SimulatedRobot::configure(const SimulatedRobotSettings& settings,
                                       const core::TubesheetSettings& sheet) {
  const auto scene = std::make_unique<core::rendering::Scene>();
  scene->sheet = sheet;
  TUBESIGHT_TRY(tubes_.configure(*scene));
  const auto truth = core::kinematics::true_arm(settings.believed, settings.errors);
  if (!truth) {
    return Unexpected(truth.error());
  }
  TUBESIGHT_TRY(path_.begin(settings.home));
  const auto home =
      core::kinematics::reach(settings.believed, transform_of(settings.home), settings.near_rad);
  if (!home) {
    return Unexpected(home.error());
  }
  settings_ = settings;
  believed_ = settings.believed;
  true_ = *truth;
  shafts_rad_ = home->angles_rad;
  end_rad_ = home->angles_rad;
  drive_.reset(settings.errors.drive, home->angles_rad);
  path_zero_s_ = 0.0;
  now_s_ = kBeforeAll_s;
  next_claim_s_ = settings.claim_period_s;
  stuck_ = false;
  messages_.clear();
  last_id_ = 0;
  heard_ = {};
  return {};
}

Result<void> SimulatedRobot::move_to(TubeAddress tube) {
  PathSegment segment;
  segment.kind = core::kinematics::SegmentKind::kMove;
  segment.to_mm = tubes_.lattice_point(tube);
  segment.shape = settings_.shape;
  segment.limits = settings_.limits;
  return add(segment);
}

Result<void> SimulatedRobot::add(const PathSegment& segment) {
  if (at_rest()) {
    // The path begins anew, so that it never runs full and hours at rest are no part of it.
    TUBESIGHT_TRY(path_.begin(ToolPlace(path_.end())));
    path_zero_s_ = now_s_ > 0.0 ? now_s_ : 0.0;
  }
  if (segment.kind == core::kinematics::SegmentKind::kJump) {
    return Unexpected(Error::kInvalidArgument);
  }
  const auto end = walk(path_.end(), end_of(segment, path_.end()));
  if (!end) {
    return Unexpected(end.error());
  }
  TUBESIGHT_TRY(path_.add(segment));
  end_rad_ = *end;
  return {};
}

/// The joints' angles at the end of a straight way from where the commands so far end, by small
/// steps: all of it must be within reach, and the elbow stays on its side.
Result<JointVector> SimulatedRobot::walk(const ToolPlace& from, const ToolPlace& to) const {
  constexpr double kStep_mm = 50.0;
  constexpr double kStep_deg = 10.0;
  constexpr double kFarthest_mm = 1e5;  // beyond any arm; keeps the steps a small number
  const double way_mm = std::hypot(to.x_mm - from.x_mm, to.y_mm - from.y_mm) +
                        std::abs(to.height_mm - from.height_mm) +
                        kStep_mm / kStep_deg * std::abs(to.alpha_deg - from.alpha_deg);
  if (!(way_mm <= kFarthest_mm)) {
    return Unexpected(Error::kOutOfRange);
  }
  const auto steps = static_cast<int>(way_mm / kStep_mm) + 1;
  JointVector angles = end_rad_;
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const auto between = [share](double a, double b) { return a + share * (b - a); };
    const ToolPlace place{
        between(from.x_mm, to.x_mm),           between(from.y_mm, to.y_mm),
        between(from.height_mm, to.height_mm), between(from.alpha_deg, to.alpha_deg),
        between(from.beta_deg, to.beta_deg),   between(from.gamma_deg, to.gamma_deg)};
    const auto next = core::kinematics::reach(believed_, transform_of(place), angles, follow());
    if (!next) {
      return Unexpected(next.error());
    }
    angles = next->angles_rad;
  }
  return angles;
}

JointVector SimulatedRobot::shafts_at(double time_s) {
  const SheetTool wanted = path_.state_at(time_s - path_zero_s_).T_sheet_tool;
  auto solution = core::kinematics::reach(believed_, wanted, shafts_rad_, follow());
  if (!solution) {
    // A long time has passed since the last instant: too far to follow in one step.
    solution = core::kinematics::reach(believed_, wanted, settings_.near_rad);
  }
  stuck_ = stuck_ || !solution;
  return solution ? solution->angles_rad : shafts_rad_;
}

SheetTool SimulatedRobot::pose_at(double time_s) {
  const JointVector shafts = shafts_at(time_s);
  if (time_s < now_s_) {
    core::kinematics::JointDrive past = drive_;
    past.turn_to(shafts);
    return core::kinematics::tool_pose(true_, past.links_rad());
  }
  now_s_ = time_s;
  shafts_rad_ = shafts;
  drive_.turn_to(shafts);
  claim_when_due();
  return core::kinematics::tool_pose(true_, drive_.links_rad());
}

void SimulatedRobot::claim_when_due() {
  if (settings_.claim_period_s <= 0.0 || now_s_ < next_claim_s_) {
    return;
  }
  while (next_claim_s_ <= now_s_) {
    next_claim_s_ += settings_.claim_period_s;
  }
  if (const auto tube = believed_tube()) {
    Event event;
    event.content = core::Claim{*tube};
    say(event);  // a controller whose line is stopped up says no more
  }
}

SheetTool SimulatedRobot::believed_pose() const {
  return core::kinematics::tool_pose(believed_, drive_.readings_rad());
}

core::RobotPose SimulatedRobot::told_pose() const {
  constexpr double kNanodegrees = 180.0e9 / core::kPi;
  const auto pose = believed_.T_sheet_base.inverse() * believed_pose();
  const auto& R = pose.rotation();
  const std::array<double, 3> angles_rad = {std::atan2(R(1, 0), R(0, 0)),
                                            std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0))),
                                            std::atan2(R(2, 1), R(2, 2))};
  core::RobotPose told;
  told.turned = true;
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    told.position_nm[i] = std::llround(1e6 * pose.translation_mm()[static_cast<Eigen::Index>(i)]);
    told.angles_ndeg[i] = std::llround(kNanodegrees * angles_rad[i]);
  }
  told.joints = believed_.arm.joints();
  for (std::size_t i = 0; i < static_cast<std::size_t>(told.joints); ++i) {
    told.joints_ndeg[i] = std::llround(kNanodegrees * drive_.readings_rad()[i]);
  }
  return told;
}

std::optional<TubeAddress> SimulatedRobot::believed_tube() const {
  // Where the guidetube's axis meets the sheet, as the box sees it too.
  const SheetTool pose = believed_pose();
  const auto& tip = pose.translation_mm();
  const auto axis = pose.rotation().col(2);
  if (!(axis.z() > 0.1)) {
    return std::nullopt;
  }
  const double way_mm = -tip.z() / axis.z();
  const auto nearest = tubes_.nearest({tip.x() + way_mm * axis.x(), tip.y() + way_mm * axis.y()});
  if (nearest.kind == core::rendering::TubeEndKind::kVoid) {
    return std::nullopt;
  }
  return nearest.address;
}

Result<void> SimulatedRobot::correct_base(const SheetTool& seen) {
  if (!at_rest()) {
    return Unexpected(Error::kNotReady);
  }
  const auto T_base_tool = believed_.T_sheet_base.inverse() * believed_pose();
  believed_.T_sheet_base = seen * T_base_tool.inverse();
  // The shafts stay; where they put the tool in the believed sheet is another place now.
  const SheetTool here = core::kinematics::tool_pose(believed_, shafts_rad_);
  TUBESIGHT_TRY(path_.begin(place_of(here)));
  path_zero_s_ = now_s_;
  end_rad_ = shafts_rad_;
  return {};
}

std::optional<Event> SimulatedRobot::take_message() {
  if (messages_.empty()) {
    return std::nullopt;
  }
  const Event first = messages_[0];
  for (std::int32_t i = 1; i < messages_.size(); ++i) {
    messages_[i - 1] = messages_[i];
  }
  messages_.truncate(messages_.size() - 1);
  return first;
}

bool SimulatedRobot::say(const Event& event) {
  Event message = event;
  if (message.id == 0) {
    message.id = last_id_ + 1;
  }
  if (!message.at && now_s_ >= 0.0) {  // before time 0 there is no clock to tell an instant by
    message.at = instant_of(now_s_);
  }
  if (auto* const request = core::content_if<core::PoseRequest>(message);
      request != nullptr && !request->robot) {
    request->robot = told_pose();
  }
  if (!messages_.try_push_back(message)) {
    return false;
  }
  last_id_ = message.id;
  return true;
}

void SimulatedRobot::hear(const Reply& reply) {
  ++heard_.replies;
  if (const auto* const request = core::content_if<core::PoseRequestReply>(reply)) {
    heard_.last_request = *request;
  } else if (const auto* const pose = core::content_if<core::PoseReply>(reply)) {
    heard_.last_pose = *pose;
  } else if (const auto* const claim = core::content_if<core::ClaimReply>(reply)) {
    heard_.last_claim = *claim;
    heard_.confirmed += claim->verdict == core::ClaimVerdict::kConfirmed ? 1 : 0;
    heard_.contradicted += claim->verdict == core::ClaimVerdict::kContradicted ? 1 : 0;
    heard_.unknown += claim->verdict == core::ClaimVerdict::kUnknown ? 1 : 0;
  }
}

void SimulatedRobot::hear(const core::Sighting& /*sighting*/) { ++heard_.sightings; }

}  // namespace tubesight::drivers
