#include <gtest/gtest.h>

#include "tests/drivers/aravis/gige_bench.h"
#include "tests/support/heap_guard.h"

namespace tubesight::tests {
namespace {

TEST(AravisHeap, FieldsAllocateNothing) {
  GigeBench bench(gige_settings(core::Scan::kEvenFirst));
  bench.camera().formats = {"Mono12p"};
  ASSERT_TRUE(bench.settle());
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

}  // namespace
}  // namespace tubesight::tests
