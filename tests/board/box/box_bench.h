#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "board/box/box_loop.h"
#include "core/base/settings.h"
#include "tests/support/events.h"
#include "tests/support/fake_clock.h"
#include "tests/support/fake_dimmer.h"
#include "tests/support/fake_frame_grabber.h"
#include "tests/support/fake_operator_station.h"
#include "tests/support/fake_robot_link.h"
#include "tests/support/simulated_bench.h"

namespace tubesight::board {

/// A loop on fakes. Its session waits for a start that never comes: the loop is what is looked at.
class BoxBench : public ::testing::Test {
 protected:
  using Loop = BoxLoop<core::FixedPoint>;

  static constexpr core::FieldTime kSpan = std::chrono::milliseconds(20);
  static constexpr std::chrono::milliseconds kTimeout{50};

  void SetUp() override {
    tests::make_ordinary_scenario(*scenario_);
    ASSERT_TRUE(session_->configure(scenario_->told));
    ASSERT_TRUE(grabber_.start());
    make_loop();
  }

  /// Again with other ports or services.
  void make_loop() { loop_ = std::make_unique<Loop>(*session_, ports_, services_); }

  /// The camera's next field, exposed now; grey all over.
  void expose(core::Parity parity = core::Parity::kProgressive,
              core::FieldStatus status = core::FieldStatus::kGood) {
    core::Field field;
    field.parity = parity;
    field.status = status;
    field.sequence = exposed_;
    field.number = parity == core::Parity::kProgressive ? 2 * exposed_ : exposed_;
    field.mid_exposure = clock_.now();
    field.lamp_permille = 123;
    grabber_.script_field(70, field);
    ++exposed_;
  }

  /// Lets a field come, after what was said, and a turn take it.
  void take_field() {
    clock_.advance(kSpan);
    expose();
    ASSERT_TRUE(loop_->turn(kTimeout));
  }

  static core::Event claim(std::int64_t id) {
    core::Event event = tests::event_of(core::Claim{{static_cast<std::int32_t>(id), 0}});
    event.id = id;
    return event;
  }
  static core::Event pick(std::int64_t id) {
    core::Event event = tests::event_of(core::Pick{{1.0, 2.0}, {}}, core::EventOrigin::kOperator);
    event.id = id;
    return event;
  }
  static core::Event at(core::Event event, core::FieldTime instant) {
    event.at = instant;
    return event;
  }

  /// Ids of the events that the last turn handed over.
  [[nodiscard]] std::vector<std::int64_t> handed() const {
    std::vector<std::int64_t> ids;
    for (const core::Event& event : loop_->input().events) {
      ids.push_back(event.id);
    }
    return ids;
  }

  std::unique_ptr<drivers::Scenario> scenario_ = std::make_unique<drivers::Scenario>();
  std::unique_ptr<core::session::Session<core::FixedPoint>> session_ =
      std::make_unique<core::session::Session<core::FixedPoint>>();
  support::FakeFrameGrabber grabber_{635, 480};
  support::FakeClock clock_;
  support::FakeDimmer dimmer_;
  support::FakeRobotLink link_;
  support::FakeOperatorStation station_;
  BoxPorts ports_{&grabber_, &clock_, &dimmer_, &link_, &station_};
  BoxServices services_;
  std::unique_ptr<Loop> loop_;
  std::int64_t exposed_ = 0;
};

}  // namespace tubesight::board
