#include "hal/frame_grabber.h"

#include "tests/hal/frame_grabber_contract.h"
#include "tests/support/fake_frame_grabber.h"

namespace tubesight::support {
namespace {

class FakeMaker {
 public:
  FakeMaker() {
    for (int i = 0; i < 4; ++i) {
      core::Field field;
      field.sequence = i;
      field.mid_exposure = core::FieldTime(1000 * i);
      fake_.script_field(static_cast<std::uint8_t>(10 * i), field);
    }
  }
  hal::FrameGrabber& grabber() { return fake_; }

 private:
  FakeFrameGrabber fake_{8, 4};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Fake, FrameGrabberContract, FakeMaker);

TEST(FakeFrameGrabber, GoesOnAfterATimeoutAndEndsAfterTheScript) {
  FakeFrameGrabber fake(2, 2);
  fake.script_error(core::Error::kTimeout);
  fake.script_field(7, {});
  ASSERT_TRUE(fake.start());

  const auto timeout = fake.grab_for(std::chrono::milliseconds(1));
  ASSERT_FALSE(timeout);
  EXPECT_EQ(timeout.error(), core::Error::kTimeout);
  {
    const auto lease = fake.grab_for(std::chrono::milliseconds(1));
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease->field().pixels.pixels[3], 7);
  }
  const auto end = fake.grab_for(std::chrono::milliseconds(1));
  ASSERT_FALSE(end);
  EXPECT_EQ(end.error(), core::Error::kEndOfData);
}

TEST(FakeFrameGrabber, StartsAfterAFailedStart) {
  FakeFrameGrabber fake(2, 2);
  fake.fail_start(core::Error::kIo);

  EXPECT_FALSE(fake.start());
  EXPECT_TRUE(fake.start());
}

TEST(FieldLease, AnEmptyOneLendsNothing) {
  hal::FieldLease empty;
  const hal::FieldLease moved = std::move(empty);

  EXPECT_EQ(moved.field().pixels.pixels, nullptr);
}

}  // namespace
}  // namespace tubesight::support
