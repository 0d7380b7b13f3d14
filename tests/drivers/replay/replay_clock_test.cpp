#include "drivers/replay/replay_clock.h"

#include <chrono>
#include <string>

#include "tests/hal/clock_contract.h"
#include "tests/support/recording_text.h"

namespace tubesight::drivers {
namespace {

core::CameraSettings small_camera() {
  core::CameraSettings camera;
  camera.width_px = 4;
  camera.height_px = 3;
  camera.scan = core::Scan::kEvenFirst;
  return camera;
}

/// The clock of a recording of so many frames, 25 a second.
class RecordedClock {
 public:
  explicit RecordedClock(int frames = 200)
      : text_(support::recording_text("YUV4MPEG2 W4 H3 F25:1 It Cmono", frames, 12)),
        grabber_(small_camera(), support::source_of(text_), "r", {}) {
    EXPECT_TRUE(grabber_.start());
  }

  [[nodiscard]] const hal::Clock& clock() const { return clock_; }
  void pass() { static_cast<void>(grabber_.grab_for(std::chrono::milliseconds(0))); }

 private:
  std::string text_;
  ReplayFrameGrabber grabber_;
  ReplayClock clock_{grabber_};
};

TEST(ReplayClock, TellsTheTimeOfTheLastField) {
  RecordedClock recorded(1);
  recorded.pass();
  EXPECT_EQ(recorded.clock().now(), core::FieldTime(0));

  recorded.pass();

  EXPECT_EQ(recorded.clock().now(), core::FieldTime(std::chrono::milliseconds(20)));
}

}  // namespace
}  // namespace tubesight::drivers

namespace tubesight::support {

INSTANTIATE_TYPED_TEST_SUITE_P(Replay, ClockContract, drivers::RecordedClock);

}  // namespace tubesight::support
