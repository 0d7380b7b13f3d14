#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace tubesight::drivers {

/// Slows down whoever guesses passwords: after each wrong one its address waits 1, 2, 4 ... 60 s,
/// and so does everybody, from many addresses, by a tenth of the number of all wrong ones. Asks no
/// clock; one thread; bounded.
class LoginThrottle {
 public:
  using Time = std::chrono::nanoseconds;
  static constexpr Time kLongestWait = std::chrono::seconds(60);
  /// After which an address that stopped guessing begins anew.
  static constexpr Time kForgotten = std::chrono::minutes(15);
  static constexpr std::size_t kMostAddresses = 256;
  static constexpr std::int32_t kFreeInAll = 20;

  /// How long this address has to wait before a password of it is looked at; 0: it may try.
  [[nodiscard]] Time wait(const std::string& address, Time now) const;
  /// A password was wrong.
  void note_wrong(const std::string& address, Time now);
  void note_right(const std::string& address) { tries_.erase(address); }

 private:
  struct Tries {
    std::int32_t wrong = 0;
    Time last{0};
    Time until{0};
  };

  std::map<std::string, Tries> tries_;
  Tries all_;
};

}  // namespace tubesight::drivers
