#include "drivers/simulated/simulated_clock.h"

#include <chrono>
#include <memory>

#include "tests/drivers/simulated/small_scenario.h"
#include "tests/hal/clock_contract.h"

namespace tubesight::drivers {
namespace {

/// The clock of a simulated world that is filmed for some seconds.
class FilmedClock {
 public:
  FilmedClock() {
    scenario_->video.length_s = 3.0;
    EXPECT_TRUE(grabber_.start());
  }

  [[nodiscard]] const hal::Clock& clock() const { return clock_; }
  void pass() { static_cast<void>(grabber_.grab_for(std::chrono::milliseconds(0))); }

 private:
  std::unique_ptr<Scenario> scenario_ = small_scenario();
  std::unique_ptr<SimulatedWorld> world_ = std::make_unique<SimulatedWorld>();
  SimulatedFrameGrabber grabber_{*world_, *scenario_};
  SimulatedClock clock_{grabber_};
};

}  // namespace
}  // namespace tubesight::drivers

namespace tubesight::support {

INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, ClockContract, drivers::FilmedClock);

}  // namespace tubesight::support
