#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace tubesight::board::campaign {

/// Does numbered work by several threads and adds what came of it in the order of the numbers, so
/// that the sum does not depend on how many there are.
template <typename Done>
class OrderedJobs {
 public:
  /// Does the work of a number, on any thread; made once for each.
  using Work = std::function<Done(std::int64_t number)>;

  struct Plan {
    std::int64_t first = 0;
    /// The number behind one.
    std::function<std::int64_t(std::int64_t number)> next;
    /// Makes a thread's worker.
    std::function<Work()> worker;
    /// Takes what was done, one at a time and in order; false: no more, and what was done of
    /// numbers behind this one is thrown away.
    std::function<bool(std::int64_t number, const Done& done)> add;
  };

  explicit OrderedJobs(Plan plan)
      : plan_(std::move(plan)), next_to_do_(plan_.first), next_to_add_(plan_.first) {}

  void run(std::int32_t jobs) {
    std::vector<std::thread> threads;
    for (std::int32_t i = 1; i < jobs; ++i) {
      threads.emplace_back([this] { work(); });
    }
    work();
    for (std::thread& thread : threads) {
      thread.join();
    }
  }

 private:
  void work() {
    const Work worker = plan_.worker();
    for (std::int64_t number = take(); number >= 0; number = take()) {
      hand_in(number, worker(number));
    }
  }

  std::int64_t take() {
    const std::lock_guard lock(mutex_);
    if (over_) {
      return -1;
    }
    return std::exchange(next_to_do_, plan_.next(next_to_do_));
  }

  void hand_in(std::int64_t number, Done done) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(number, std::move(done));
    for (auto first = waiting_.begin();
         !over_ && first != waiting_.end() && first->first == next_to_add_;
         first = waiting_.erase(first)) {
      next_to_add_ = plan_.next(first->first);
      over_ = !plan_.add(first->first, first->second);
    }
  }

  Plan plan_;
  std::mutex mutex_;
  std::map<std::int64_t, Done> waiting_;
  std::int64_t next_to_do_;
  std::int64_t next_to_add_;
  bool over_ = false;
};

}  // namespace tubesight::board::campaign
