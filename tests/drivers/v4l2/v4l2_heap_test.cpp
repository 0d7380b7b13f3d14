#include <gtest/gtest.h>

#include "tests/drivers/v4l2/camera_bench.h"
#include "tests/support/heap_guard.h"

namespace tubesight::tests {
namespace {

void expect_no_allocation(std::uint32_t planes) {
  CameraBench bench(settings_of(core::Scan::kEvenFirst));
  if (planes > 0) {
    bench.camera().caps = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
    bench.camera().planes = planes;
  }
  bench.camera().fields = {V4L2_FIELD_INTERLACED};
  bench.camera().formats = {V4L2_PIX_FMT_YUYV};
  ASSERT_TRUE(bench.grabber().start());
  ASSERT_TRUE(bench.good_within(2));  // the fake kernel has met every request by then
  ASSERT_TRUE(bench.good_within(2));
  ASSERT_TRUE(bench.good_within(2));
  int good = 0;
  HeapCalls calls;
  {
    const HeapGuard guard;
    for (int i = 0; i < 40; ++i) {
      good += bench.next_status() == core::FieldStatus::kGood ? 1 : 0;
    }
    calls = guard.calls();
  }

  EXPECT_EQ(good, 40);
  EXPECT_EQ(calls.allocations, 0);
}

TEST(V4l2Heap, FieldsAllocateNothing) { expect_no_allocation(0); }

TEST(V4l2Heap, FieldsInPlanesAllocateNothing) { expect_no_allocation(1); }

}  // namespace
}  // namespace tubesight::tests
