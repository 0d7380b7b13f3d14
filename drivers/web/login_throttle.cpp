#include "drivers/web/login_throttle.h"

#include <algorithm>

namespace tubesight::drivers {
namespace {

/// 1, 2, 4 ... of a second.
LoginThrottle::Time wait_after(std::int32_t wrong) {
  constexpr std::int32_t kMostDoublings = 6;
  const LoginThrottle::Time wait =
      std::chrono::seconds(std::int64_t{1} << std::clamp(wrong - 1, 0, kMostDoublings));
  return std::min(wait, LoginThrottle::kLongestWait);
}

}  // namespace

LoginThrottle::Time LoginThrottle::wait(const std::string& address, Time now) const {
  Time until = all_.until;
  if (const auto found = tries_.find(address); found != tries_.end()) {
    until = std::max(until, found->second.until);
  }
  return std::max(until - now, Time{0});
}

void LoginThrottle::note_wrong(const std::string& address, Time now) {
  if (now - all_.last > kForgotten) {
    all_ = {};
  }
  ++all_.wrong;
  all_.last = now;
  if (all_.wrong > kFreeInAll) {
    all_.until = now + wait_after((all_.wrong - kFreeInAll) / 10);
  }
  std::erase_if(tries_, [&](const auto& each) { return now - each.second.last > kForgotten; });
  if (tries_.size() >= kMostAddresses && !tries_.contains(address)) {
    tries_.erase(std::min_element(tries_.begin(), tries_.end(), [](const auto& a, const auto& b) {
      return a.second.last < b.second.last;
    }));
  }
  Tries& tries = tries_[address];
  ++tries.wrong;
  tries.last = now;
  tries.until = now + wait_after(tries.wrong);
}

}  // namespace tubesight::drivers
