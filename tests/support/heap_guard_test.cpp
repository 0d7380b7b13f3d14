#include "tests/support/heap_guard.h"

#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::tests {
namespace {

// Through this the compiler cannot see that memory is never used, and leave the call out.
const volatile void* volatile g_seen = nullptr;

struct alignas(128) Wide {
  std::array<std::byte, 128> bytes{};
};

TEST(HeapGuard, SeesNothingWhereNothingIsAllocated) {
  const HeapGuard guard;
  std::array<int, 100> numbers{};
  g_seen = numbers.data();

  const HeapCalls calls = guard.calls();

  EXPECT_EQ(calls.allocations, 0);
  EXPECT_EQ(calls.releases, 0);
}

TEST(HeapGuard, CatchesOperatorNewInEachForm) {
  HeapCalls calls;
  {
    const HeapGuard guard;
    const std::unique_ptr<int> one(new int(1));
    g_seen = one.get();
    const std::unique_ptr<int[]> several(new int[10]);
    g_seen = several.get();
    const std::unique_ptr<Wide> aligned(new Wide);
    g_seen = aligned.get();
    const std::unique_ptr<int> quiet(new (std::nothrow) int(1));
    g_seen = quiet.get();
    const std::unique_ptr<Wide[]> aligned_several(new Wide[2]);
    g_seen = aligned_several.get();
    calls = guard.calls();
  }

  EXPECT_EQ(calls.allocations, 5);
  EXPECT_EQ(calls.releases, 0);
}

TEST(HeapGuard, CatchesOperatorDelete) {
  int* one = new int(1);
  Wide* aligned = new Wide;
  g_seen = one;
  g_seen = aligned;
  HeapCalls calls;
  {
    const HeapGuard guard;
    delete one;
    delete aligned;
    calls = guard.calls();
  }

  EXPECT_EQ(calls.allocations, 0);
  EXPECT_EQ(calls.releases, 2);
}

TEST(HeapGuard, CatchesTheMallocFamily) {
  HeapCalls calls;
  {
    const HeapGuard guard;
    void* plain = std::malloc(10);
    g_seen = plain;
    void* grown = std::realloc(plain, 1000);
    g_seen = grown;
    void* zeroed = std::calloc(2, 5);
    g_seen = zeroed;
    void* aligned = std::aligned_alloc(64, 64);
    g_seen = aligned;
    void* posix = nullptr;
    const int status = posix_memalign(&posix, 64, 10);
    g_seen = posix;
    std::free(grown);
    std::free(zeroed);
    std::free(aligned);
    std::free(status == 0 ? posix : nullptr);
    std::free(nullptr);
    calls = guard.calls();
  }

  EXPECT_EQ(calls.allocations, 5);
  EXPECT_EQ(calls.releases, 4);
}

TEST(HeapGuard, CatchesWhatTheLibraryAllocates) {
  const HeapGuard guard;
  std::vector<int> numbers(100);
  g_seen = numbers.data();
  std::string text(100, 'x');
  g_seen = text.data();

  const HeapCalls calls = guard.calls();

  EXPECT_EQ(calls.allocations, 2);
}

TEST(HeapGuard, CountsTheCallsOfAllThreads) {
  std::thread worker;
  const HeapGuard guard;
  const HeapCalls before = guard.calls();
  worker = std::thread([] {
    void* memory = std::malloc(10);
    g_seen = memory;
    std::free(memory);
  });
  worker.join();

  const HeapCalls after = guard.calls();

  EXPECT_EQ(before.allocations, 0);
  EXPECT_GE(after.allocations, 1);
}

TEST(HeapGuard, LeavesOtherThreadsOutWhereAsked) {
  std::thread worker;
  const HeapGuard guard(HeapScope::kThisThread);
  worker = std::thread([] {
    void* memory = std::malloc(10);
    g_seen = memory;
    std::free(memory);
  });
  worker.join();
  const HeapCalls before = guard.calls();
  void* memory = std::malloc(10);
  g_seen = memory;
  std::free(memory);

  const HeapCalls after = guard.calls();

  EXPECT_EQ(after.allocations - before.allocations, 1);
  EXPECT_LE(before.allocations, 2) << "the thread's own making is the caller's call";
}

TEST(HeapGuard, CountsOnlyWhileArmed) {
  const std::unique_ptr<int> before(new int(1));
  g_seen = before.get();
  const HeapGuard guard;

  const HeapCalls calls = guard.calls();

  EXPECT_EQ(calls.allocations, 0);
}

TEST(HeapGuardDeathTest, RefusesToBeArmedTwice) {
  EXPECT_DEATH(
      {
        const HeapGuard first;
        const HeapGuard second;
      },
      "");
}

}  // namespace
}  // namespace tubesight::tests
