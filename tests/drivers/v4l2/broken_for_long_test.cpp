// Cameras that deliver, and nothing whole.

#include <chrono>

#include <gtest/gtest.h>

#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using core::Error;
using core::FieldStatus;
using drivers::CameraTrouble;

using Memory = std::span<std::byte>;

class BrokenForLong : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(bench_.grabber().start()) << bench_.message(); }
  CameraBench bench_;
};

// Grabbers lose their step, and find it with a new beginning.
TEST_F(BrokenForLong, ACameraWithNothingButDamagedBuffersIsOpenedAnewAfterFiveSeconds) {
  ASSERT_TRUE(bench_.good_within(1));
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    buffer.flags |= V4L2_BUF_FLAG_ERROR;
  };
  const core::FieldTime begin = bench_.kernel().now();
  int damaged = 0;
  while (bench_.next_status() == FieldStatus::kDamaged) {
    ASSERT_LT(++damaged, 200);
  }
  EXPECT_NEAR(std::chrono::duration<double>(bench_.kernel().now() - begin).count(), 5.0, 0.2);
  EXPECT_EQ(bench_.grab().error(), Error::kIo) << "until the camera is started anew";
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kDamaged);
  EXPECT_EQ(bench_.counters().flagged, damaged);

  bench_.camera().tamper = nullptr;
  ASSERT_TRUE(bench_.start_anew()) << bench_.message();
  EXPECT_TRUE(bench_.good_within(1));
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNone);
}

TEST_F(BrokenForLong, OneGoodBufferAmongDamagedOnesIsEnoughToGoOn) {
  bench_.camera().tamper = [](std::int64_t number, v4l2_buffer& buffer, Memory) {
    buffer.flags |= number % 60 == 0 ? 0 : V4L2_BUF_FLAG_ERROR;
  };
  for (int i = 0; i < 600; ++i) {
    ASSERT_NE(bench_.next_status(), FieldStatus::kMissing) << i;
  }
}

// Without a signal a new beginning brings none.
TEST_F(BrokenForLong, NoSignalForLongIsNoReasonToOpenAnew) {
  bench_.camera().inputs[0].status = V4L2_IN_ST_NO_SIGNAL;
  bench_.grabber().look_after();
  for (int i = 0; i < 600; ++i) {
    ASSERT_EQ(bench_.next_status(), FieldStatus::kDamaged) << i;
  }
}

}  // namespace
}  // namespace tubesight::tests
