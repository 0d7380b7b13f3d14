#pragma once

#include <functional>
#include <optional>
#include <string>

#include "board/visionbox/box_report.h"

namespace tubesight::board {

/// Looks at the box now and then: counts its fields by the second, and tells what has changed.
class BoxWatch {
 public:
  explicit BoxWatch(std::function<void(const std::string&)> tell) : tell_(std::move(tell)) {}

  /// Takes the present state; `report.fields_per_s` is not looked at.
  void look(const BoxReport& report);

  /// How the box is doing, in a line that changes when that does; empty before the first look.
  [[nodiscard]] const std::string& headline() const { return headline_; }

  /// Fields that came in a second, over the last second or more; 0 before.
  [[nodiscard]] double fields_per_s() const { return fields_per_s_; }

 private:
  std::function<void(const std::string&)> tell_;
  std::string headline_;
  double fields_per_s_ = 0.0;
  MonotonicTime counted_at_{0};
  std::int64_t counted_ = 0;
  std::int64_t late_ = 0;
  std::int64_t made_late_ = 0;
  std::optional<SourceState> source_;
  core::TrackState state_ = core::TrackState::kWaiting;
  core::Reason reason_ = core::Reason::kNoStart;
};

}  // namespace tubesight::board
