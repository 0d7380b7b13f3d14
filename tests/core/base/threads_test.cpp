// Snapshot and SpscQueue between threads. The program is compiled for the thread sanitizer where
// there is one, which ends it with an error at the first data race that it meets.

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/snapshot.h"
#include "core/base/spsc_queue.h"

namespace tubesight::core {
namespace {

/// About as large as what a step leaves; whole only if all its numbers are the same.
struct Block {
  std::array<std::uint32_t, 1024> numbers{};
};

Block block_of(std::uint32_t number) {
  Block block;
  block.numbers.fill(number);
  return block;
}

TEST(SnapshotBetweenThreads, IsNeverTornAndNeverRunsBackwards) {
  constexpr std::uint32_t kPublications = 3000;
  Snapshot<Block> snapshot;
  std::atomic<int> torn{0};
  std::atomic<int> backwards{0};
  std::atomic<std::uint32_t> read{0};

  const auto watch = [&] {
    Block block;
    std::uint32_t last = 0;
    while (last < kPublications) {
      if (!snapshot.try_read(block)) {
        std::this_thread::yield();
        continue;
      }
      for (const std::uint32_t number : block.numbers) {
        torn += number != block.numbers[0] ? 1 : 0;
      }
      backwards += block.numbers[0] < last ? 1 : 0;
      last = block.numbers[0];
      ++read;
    }
  };
  std::thread first(watch);
  std::thread second(watch);
  for (std::uint32_t i = 1; i <= kPublications; ++i) {
    snapshot.publish(block_of(i));
  }
  first.join();
  second.join();

  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
  EXPECT_GE(read, 2U);
}

TEST(SpscQueueBetweenThreads, LosesNothingAndKeepsTheOrder) {
  constexpr std::uint32_t kMessages = 200000;
  SpscQueue<std::array<std::uint32_t, 3>, 16> queue;
  std::thread producer([&queue] {
    for (std::uint32_t i = 0; i < kMessages;) {
      if (queue.try_push({i, ~i, 3 * i})) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });

  std::uint32_t wrong = 0;
  for (std::uint32_t i = 0; i < kMessages;) {
    std::array<std::uint32_t, 3> got{};
    if (queue.try_pop(got)) {
      wrong += got == std::array<std::uint32_t, 3>{i, ~i, 3 * i} ? 0U : 1U;
      ++i;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();

  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(queue.size(), 0U);
}

#ifdef __SANITIZE_THREAD__

/// A queue of one message as it must not be: announced without release and acquire.
void pass_a_message_without_order() {
  int message = 0;
  std::atomic<bool> sent{false};
  std::thread producer([&] {
    message = 1;
    sent.store(true, std::memory_order_relaxed);
  });
  while (!sent.load(std::memory_order_relaxed)) {
    std::this_thread::yield();
  }
  message += 1;
  producer.join();
}

TEST(ThreadSanitizerDeathTest, FindsAPlantedRace) {
  constexpr int kRaceFound = 66;  // the sanitizer's exit status
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT((pass_a_message_without_order(), std::exit(0)), testing::ExitedWithCode(kRaceFound),
              "data race");
}

#endif

}  // namespace
}  // namespace tubesight::core
