#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace tubesight::drivers {

/// What somebody at the page may do; each may do what those before it may.
enum class PageRole : std::uint8_t {
  kNone,      ///< log in
  kViewer,    ///< look, and have tubes named
  kOperator,  ///< start, light, acknowledge, record
  kEngineer,  ///< change settings
};

/// "none", "viewer", "operator", "engineer".
[[nodiscard]] std::string_view name_of(PageRole role);
/// The role of a word; empty: none of those that have a password.
[[nodiscard]] std::optional<PageRole> role_of(std::string_view word);

/// `bytes` random ones from the system, as hexadecimal digits.
[[nodiscard]] std::string random_hex(std::size_t bytes);

/// Who is at the page, and who of them operates the box: one at a time.
///
/// A session is what a cookie names: it ends after kIdle without a request and in any case after
/// kLongest. Bounded: when no place is left, those who have not logged in make room, then whoever
/// was idle for longest, if for a minute. Asks no clock; one thread.
class PageSessions {
 public:
  using Time = std::chrono::nanoseconds;
  static constexpr Time kIdle = std::chrono::minutes(30);
  static constexpr Time kLongest = std::chrono::hours(12);
  static constexpr Time kMayMakeRoom = std::chrono::minutes(1);
  /// Who has not asked for anything for so long operates no more.
  static constexpr Time kAway = std::chrono::seconds(60);
  static constexpr std::size_t kMost = 48;

  struct Session {
    PageRole role = PageRole::kNone;
    std::string token;  ///< that must come with whatever changes something
    Time began{0};
    Time seen{0};
  };

  /// Who operates.
  struct Operator {
    std::string session;  ///< empty: nobody
    std::string name;
    Time since{0};
  };

  /// The session of a cookie, seen now; null: there is none, or it has ended.
  [[nodiscard]] Session* find(const std::string& cookie, Time now);

  /// Whether there is one, without seeing it.
  [[nodiscard]] bool is_there(const std::string& cookie) const {
    return sessions_.contains(cookie);
  }

  /// A new session's cookie; empty: there is no room.
  [[nodiscard]] std::string open(PageRole role, Time now);

  /// Ends one, and its operating.
  void close(const std::string& cookie);

  /// Gives a session another role under a new cookie and token, so that what somebody saw of the
  /// old one is worth nothing. Empty: there is no such session.
  [[nodiscard]] std::string renew(const std::string& cookie, PageRole role, Time now);

  /// Lets a session operate. False: another one does, and it was not confirmed.
  [[nodiscard]] bool take_over(const std::string& cookie, std::string_view name, bool confirmed,
                               Time now);
  void hand_back(const std::string& cookie);
  [[nodiscard]] bool operates(const std::string& cookie) const {
    return !cookie.empty() && operator_.session == cookie;
  }
  /// Who operates now; one who is away does not.
  [[nodiscard]] const Operator& who_operates(Time now);

  [[nodiscard]] std::size_t count() const { return sessions_.size(); }

 private:
  void drop_ended(Time now);
  [[nodiscard]] bool make_room(Time now);

  std::map<std::string, Session> sessions_;
  Operator operator_;
};

}  // namespace tubesight::drivers
