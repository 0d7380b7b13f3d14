#pragma once

#include <chrono>

#include "board/bench/script/scripted_ports.h"
#include "board/bench/script/simulated_script.h"
#include "board/box/box_loop.h"
#include "core/base/result.h"
#include "core/base/scalar.h"
#include "core/lighting/lamp_policy.h"
#include "core/session/session.h"
#include "core/tracking/margin_policy.h"
#include "drivers/simulated/scenario.h"
#include "drivers/simulated/simulated_clock.h"
#include "drivers/simulated/simulated_dimmer.h"
#include "drivers/simulated/simulated_frame_grabber.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::board {

/// A box that watches a scenario in memory, in fixed point: its robot and operator do what the
/// scenario says, and the world's own lamp obeys its commands. Some 400 KB: heap. `Margin` is the
/// session's policy; that of the self-proof needs board/bench/self_proof.
template <typename Margin = core::tracking::MarginChecked>
class SimulatedBox {
 public:
  using Session = core::session::Session<core::FixedPoint, Margin>;

  /// World and scenario outlive the box. With a `lamp` that lets it rule the world's lamp it does.
  SimulatedBox(drivers::SimulatedWorld& world, const drivers::Scenario& scenario,
               const core::lighting::LampPolicy& lamp = {})
      : scenario_(&scenario),
        grabber_(world, scenario),
        dimmer_(world),
        loop_(
            session_,
            BoxPorts{&grabber_, &clock_, lamp.pattern || lamp.follows_picture ? &dimmer_ : nullptr,
                     &link_, &station_},
            services_of(lamp)) {}
  SimulatedBox(const SimulatedBox&) = delete;
  SimulatedBox& operator=(const SimulatedBox&) = delete;

  /// Goes to the start of the scenario. Errors: those of SimulatedWorld::configure() and
  /// Session::configure(). Call once.
  [[nodiscard]] core::Result<void> start() {
    TUBESIGHT_TRY(grabber_.start());
    TUBESIGHT_TRY(session_.configure(scenario_->told));
    return loop_.start();
  }

  /// Takes the next field. kEndOfData: there was none.
  [[nodiscard]] core::Result<void> turn() { return loop_.turn(std::chrono::milliseconds(0)); }

  /// The last field with its truth, and what the box made of it.
  [[nodiscard]] const drivers::SimulatedField& field() const { return grabber_.last(); }
  [[nodiscard]] const core::session::Output& output() const { return loop_.output(); }

 private:
  static BoxServices services_of(const core::lighting::LampPolicy& lamp) {
    BoxServices services;
    services.lamp = lamp;
    return services;
  }

  const drivers::Scenario* scenario_;
  drivers::SimulatedFrameGrabber grabber_;
  drivers::SimulatedDimmer dimmer_;
  drivers::SimulatedClock clock_{grabber_};
  SimulatedScript script_{grabber_};
  ScriptedRobotLink link_{script_};
  ScriptedOperatorStation station_{script_};
  Session session_;
  BoxLoop<core::FixedPoint, Margin> loop_;
};

}  // namespace tubesight::board
