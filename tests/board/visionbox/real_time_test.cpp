#include "board/visionbox/real_time.h"

#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tubesight::board {
namespace {

struct Schedule {
  std::string refused;
  int policy = 0;
  int nice = 0;
};

Schedule now(const std::string& refused) {
  return {refused, sched_getscheduler(0), getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()))};
}

TEST(RealTime, AThreadBeforeOthersStaysOrdinaryAndLeavesItsProcessAlone) {
  const Schedule before = now("");
  Schedule inside;
  std::thread([&] { inside = now(schedule_before_others()); }).join();

  EXPECT_EQ(inside.policy, before.policy);
  EXPECT_EQ(now("").nice, before.nice);
  EXPECT_EQ(inside.nice, inside.refused.empty() ? -15 : before.nice);
}

}  // namespace
}  // namespace tubesight::board
