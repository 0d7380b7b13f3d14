#pragma once

#include <functional>
#include <string>

#include "board/visionbox/box_report.h"
#include "drivers/modbus/link_state.h"

namespace tubesight::board {

/// Looks now and then at everything that the box can find wrong with itself.
///
/// At the start it gives each part its time: it has finished as soon as nothing is bad and the
/// picture follows the lamp where it is to, or after kLongest; then it tells, once. From there on
/// what is bad is what is bad at present. It decides nothing: a box that passes is believed no more
/// than before.
class SelfTestWatch {
 public:
  /// A camera takes seconds to open, a lamp's pattern some to be found.
  static constexpr MonotonicTime kLongest = std::chrono::seconds(10);

  explicit SelfTestWatch(std::function<void(const std::string&)> tell) : tell_(std::move(tell)) {}

  /// Takes the present state; does something once a second.
  void look(const BoxReport& report);

  [[nodiscard]] bool finished() const { return finished_; }
  /// What the robot is to read of it.
  [[nodiscard]] const drivers::LinkSelfTest& told() const { return told_; }

 private:
  void tell_end(const std::vector<SelfTestRow>& rows);

  std::function<void(const std::string&)> tell_;
  MonotonicTime next_{0};
  bool finished_ = false;
  drivers::LinkSelfTest told_;
};

}  // namespace tubesight::board
