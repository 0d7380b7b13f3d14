#include "board/bench/campaign/ordered_jobs.h"

#include <chrono>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board::campaign {
namespace {

using Added = std::vector<std::pair<std::int64_t, std::int64_t>>;

/// Squares of the odd numbers from `first` on, until one is over `most`; later numbers are done
/// sooner.
Added squares(std::int64_t first, std::int64_t most, std::int32_t jobs) {
  Added added;
  OrderedJobs<std::int64_t>::Plan plan;
  plan.first = first;
  plan.next = [](std::int64_t number) { return number + 2; };
  plan.worker = [] {
    return [](std::int64_t number) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20 / number));
      return number * number;
    };
  };
  plan.add = [&](std::int64_t number, const std::int64_t& square) {
    added.emplace_back(number, square);
    return square <= most;
  };
  OrderedJobs<std::int64_t>(std::move(plan)).run(jobs);
  return added;
}

TEST(OrderedJobs, AddsInOrderWhateverTheirNumber) {
  const Added expected = {{1, 1}, {3, 9}, {5, 25}, {7, 49}};
  EXPECT_EQ(squares(1, 40, 1), expected);
  EXPECT_EQ(squares(1, 40, 4), expected);
}

TEST(OrderedJobs, ThrowsAwayWhatIsBehindTheEnd) { EXPECT_EQ(squares(9, 0, 3), (Added{{9, 81}})); }

}  // namespace
}  // namespace tubesight::board::campaign
