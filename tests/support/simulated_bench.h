#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "board/bench/script/scripted_ports.h"
#include "board/bench/script/simulated_script.h"
#include "board/box/box_loop.h"
#include "board/box/pair_desk.h"
#include "board/box/pose_service.h"
#include "core/lighting/lamp_policy.h"
#include "core/session/session.h"
#include "drivers/simulated/scenario.h"
#include "drivers/simulated/simulated_clock.h"
#include "drivers/simulated/simulated_dimmer.h"
#include "drivers/simulated/simulated_frame_grabber.h"
#include "drivers/simulated/simulated_robot.h"
#include "drivers/simulated/simulated_robot_link.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::tests {

/// A scenario with an ordinary camera below an ordinary sheet of 25.4 mm pitch; tube (40, 60) is at
/// (1524, 1016) mm. The box is told the truth. No path, no clicks, 60 fields a second, 60 s.
void make_ordinary_scenario(drivers::Scenario& scenario);

/// A Cobra-like robot whose base stands 923 mm from tube (40, 60) and 1000 mm below the sheet, at
/// home 40 mm under that tube. Its controller compensates the deflection; it has no errors.
[[nodiscard]] drivers::SimulatedRobotSettings make_ordinary_robot();

/// The whole loop: a robot moves the tool of a simulated world, the box looks through the camera,
/// sets the lamp and answers the robot.
///
/// Change `scenario` and `robot_settings`, then start(). Some 10 MB: heap.
class SimulatedBench {
 public:
  SimulatedBench();

  drivers::Scenario scenario;
  drivers::SimulatedRobotSettings robot_settings;
  core::lighting::LampPolicy lamp;  ///< what the box may do with the lamp

  /// Puts all together; the operator clicks on three tubes that are truly there. Fails the test
  /// when a part does not start.
  void start(const drivers::LineNoise& noise = {});

  /// Lets so many seconds of fields pass.
  void run(double seconds);
  /// Lets fields pass until the robot rests, and half a second more.
  void run_to_rest();

  [[nodiscard]] drivers::SimulatedWorld& world() { return *world_; }
  [[nodiscard]] drivers::SimulatedRobot& robot() { return *robot_; }
  [[nodiscard]] drivers::SimulatedDimmer& dimmer() { return *dimmer_; }
  [[nodiscard]] drivers::SimulatedRobotLink& link() { return *link_; }

  /// Poses by the robot and by the box.
  [[nodiscard]] board::PairDesk& pairs() { return pairs_; }

  /// Of the last field.
  [[nodiscard]] const core::session::Output& output() const { return loop_->output(); }
  [[nodiscard]] const core::Sighting& sighting() const { return loop_->output().sighting; }
  [[nodiscard]] const core::session::Input& input() const { return loop_->input(); }
  [[nodiscard]] const core::session::Session<core::FixedPoint>& session() const {
    return *session_;
  }
  [[nodiscard]] const drivers::FieldTruth& truth() const { return grabber_->last().truth; }

  /// Mean grey value over the box's window in the last frame.
  [[nodiscard]] double grey() const;

  /// Messages that came garbled, and fields in which the robot was gone.
  [[nodiscard]] std::int64_t garbled() const { return loop_->counters().link.garbled; }
  [[nodiscard]] std::int64_t disconnected() const { return loop_->counters().link.gone; }
  /// Fields whose answer vouched for a tube that is not the true one.
  [[nodiscard]] std::int64_t wrong() const { return wrong_; }

 private:
  void step();

  std::unique_ptr<drivers::SimulatedWorld> world_;
  std::unique_ptr<drivers::SimulatedRobot> robot_;
  std::unique_ptr<drivers::SimulatedFrameGrabber> grabber_;
  std::unique_ptr<drivers::SimulatedDimmer> dimmer_;
  std::unique_ptr<drivers::SimulatedRobotLink> link_;
  std::unique_ptr<core::session::Session<core::FixedPoint>> session_;
  board::PoseService poses_;
  board::PairDesk pairs_;
  std::unique_ptr<drivers::SimulatedClock> clock_;
  std::unique_ptr<board::SimulatedScript> script_;
  std::unique_ptr<board::ScriptedOperatorStation> station_;
  std::unique_ptr<board::BoxLoop<core::FixedPoint>> loop_;
  std::int64_t wrong_ = 0;
};

}  // namespace tubesight::tests
