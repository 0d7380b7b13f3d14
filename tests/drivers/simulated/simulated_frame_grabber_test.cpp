#include "drivers/simulated/simulated_frame_grabber.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/drivers/simulated/small_scenario.h"
#include "tests/hal/frame_grabber_contract.h"

namespace tubesight::drivers {
namespace {

class SimulatedMaker {
 public:
  SimulatedMaker() { scenario_->video.length_s = 0.1; }
  SimulatedFrameGrabber& grabber() { return grabber_; }

 private:
  std::unique_ptr<Scenario> scenario_ = small_scenario();
  std::unique_ptr<SimulatedWorld> world_ = std::make_unique<SimulatedWorld>();
  SimulatedFrameGrabber grabber_{*world_, *scenario_};
};

}  // namespace
}  // namespace tubesight::drivers

namespace tubesight::support {

INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, FrameGrabberContract, drivers::SimulatedMaker);

}  // namespace tubesight::support

namespace tubesight::drivers {
namespace {

TEST(SimulatedFrameGrabber, EndsAfterTheLastField) {
  SimulatedMaker maker;
  SimulatedFrameGrabber& grabber = maker.grabber();
  ASSERT_TRUE(grabber.start());

  for (int i = 0; i < 6; ++i) {
    const auto lease = grabber.grab_for(std::chrono::milliseconds(0));
    ASSERT_TRUE(lease) << i;
    EXPECT_EQ(lease->field().sequence, i);
    EXPECT_EQ(grabber.last().slot, i);
  }

  const auto end = grabber.grab_for(std::chrono::milliseconds(0));
  ASSERT_FALSE(end);
  EXPECT_EQ(end.error(), core::Error::kEndOfData);
}

TEST(SimulatedFrameGrabber, TellsWhyAScenarioCannotStart) {
  const auto scenario = small_scenario();
  scenario->video.exposure_s = -1.0;
  const auto world = std::make_unique<SimulatedWorld>();
  SimulatedFrameGrabber grabber(*world, *scenario);

  const auto started = grabber.start();

  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), core::Error::kInvalidArgument);
}

}  // namespace
}  // namespace tubesight::drivers
