#include "drivers/web/page_sessions.h"

#include <algorithm>
#include <array>
#include <vector>

#include <sys/random.h>

#include "core/base/assert.h"

namespace tubesight::drivers {
namespace {

constexpr std::array<std::string_view, 4> kRoles = {"none", "viewer", "operator", "engineer"};
constexpr std::size_t kSecretBytes = 32;
constexpr std::size_t kLongestName = 60;

}  // namespace

std::string_view name_of(PageRole role) { return kRoles[static_cast<std::size_t>(role)]; }

std::optional<PageRole> role_of(std::string_view word) {
  const auto found = std::find(kRoles.begin() + 1, kRoles.end(), word);
  if (found == kRoles.end()) {
    return {};
  }
  return static_cast<PageRole>(found - kRoles.begin());
}

std::string random_hex(std::size_t bytes) {
  std::vector<unsigned char> drawn(bytes);
  TUBESIGHT_ASSERT(getrandom(drawn.data(), bytes, 0) == static_cast<ssize_t>(bytes));
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : drawn) {
    text += kDigits[byte / 16U];
    text += kDigits[byte % 16U];
  }
  return text;
}

PageSessions::Session* PageSessions::find(const std::string& cookie, Time now) {
  const auto found = sessions_.find(cookie);
  if (found == sessions_.end()) {
    return nullptr;
  }
  Session& session = found->second;
  if (now - session.seen > kIdle || now - session.began > kLongest) {
    close(cookie);
    return nullptr;
  }
  session.seen = now;
  return &session;
}

void PageSessions::drop_ended(Time now) {
  std::erase_if(sessions_, [&](const auto& each) {
    const Session& session = each.second;
    const bool ended = now - session.seen > kIdle || now - session.began > kLongest;
    if (ended && operator_.session == each.first) {
      operator_ = {};
    }
    return ended;
  });
}

bool PageSessions::make_room(Time now) {
  drop_ended(now);
  if (sessions_.size() < kMost) {
    return true;
  }
  const auto next =
      std::min_element(sessions_.begin(), sessions_.end(), [](const auto& one, const auto& other) {
        const bool one_in = one.second.role != PageRole::kNone;
        const bool other_in = other.second.role != PageRole::kNone;
        return one_in != other_in ? other_in : one.second.seen < other.second.seen;
      });
  if (next->second.role != PageRole::kNone && now - next->second.seen < kMayMakeRoom) {
    return false;
  }
  close(std::string(next->first));
  return true;
}

std::string PageSessions::open(PageRole role, Time now) {
  if (!make_room(now)) {
    return {};
  }
  std::string cookie = random_hex(kSecretBytes);
  sessions_[cookie] = {role, random_hex(kSecretBytes), now, now};
  return cookie;
}

void PageSessions::close(const std::string& cookie) {
  hand_back(cookie);
  sessions_.erase(cookie);
}

std::string PageSessions::renew(const std::string& cookie, PageRole role, Time now) {
  if (find(cookie, now) == nullptr) {
    return {};
  }
  close(cookie);
  return open(role, now);
}

bool PageSessions::take_over(const std::string& cookie, std::string_view name, bool confirmed,
                             Time now) {
  const Operator& holder = who_operates(now);
  if (!holder.session.empty() && holder.session != cookie && !confirmed) {
    return false;
  }
  const Time since = holder.session == cookie ? holder.since : now;
  operator_ = {cookie, std::string(name.substr(0, kLongestName)), since};
  return true;
}

void PageSessions::hand_back(const std::string& cookie) {
  if (operates(cookie)) {
    operator_ = {};
  }
}

const PageSessions::Operator& PageSessions::who_operates(Time now) {
  const auto holder = sessions_.find(operator_.session);
  if (holder == sessions_.end() || now - holder->second.seen > kAway) {
    operator_ = {};
  }
  return operator_;
}

}  // namespace tubesight::drivers
