// Field, robot, lamp and line of a simulated world allocate nothing once they have started.

#include <memory>

#include <gtest/gtest.h>

#include "drivers/simulated/simulated_dimmer.h"
#include "drivers/simulated/simulated_robot.h"
#include "drivers/simulated/simulated_robot_link.h"
#include "drivers/simulated/simulated_world.h"
#include "tests/support/heap_guard.h"
#include "tests/support/simulated_bench.h"

namespace tubesight::tests {
namespace {

TEST(SimulatedHeap, IsNotTouchedByAFieldNorByTheRobot) {
  const auto scenario = std::make_unique<drivers::Scenario>();
  make_ordinary_scenario(*scenario);
  const auto world = std::make_unique<drivers::SimulatedWorld>();
  const auto robot = std::make_unique<drivers::SimulatedRobot>();
  const auto field = std::make_unique<drivers::SimulatedField>();
  ASSERT_TRUE(robot->configure(make_ordinary_robot(), scenario->told.tubesheet));
  ASSERT_TRUE(world->configure(*scenario));
  world->steer(robot.get());
  drivers::SimulatedDimmer dimmer(*world);
  drivers::SimulatedRobotLink link(*robot);
  ASSERT_TRUE(dimmer.start());
  ASSERT_TRUE(link.start());

  int messages = 0;
  bool good = true;
  HeapCalls calls;
  {
    const HeapGuard guard;
    for (int i = 0; i < 60 && good; ++i) {
      good = (i != 5 || robot->move_to({42, 62}).has_value()) && dimmer.set_level(1000 - i) &&
             world->next(*field);
      while (const auto message = link.poll_event()) {
        if (!message->has_value()) {
          break;
        }
        good = good && link.send_reply({}).has_value();
        ++messages;
      }
      good = good && link.send_sighting({}).has_value();
    }
    calls = guard.calls();
  }

  EXPECT_TRUE(good);
  EXPECT_GE(messages, 3);
  EXPECT_EQ(calls.allocations, 0);
  EXPECT_EQ(calls.releases, 0);
}

}  // namespace
}  // namespace tubesight::tests
