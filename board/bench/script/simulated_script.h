#pragma once

#include <cstdint>

#include "board/bench/script/event_script.h"
#include "core/base/static_vector.h"
#include "drivers/simulated/simulated_frame_grabber.h"

namespace tubesight::board {

/// The events that a simulated world has with its fields: a scenario's clicks, claims, picks, and
/// the messages of its robot.
class SimulatedScript final : public EventScript {
 public:
  /// `grabber` outlives the script.
  explicit SimulatedScript(const drivers::SimulatedFrameGrabber& grabber) : grabber_(&grabber) {}

  [[nodiscard]] const core::Event* next() override;
  void take() override;
  [[nodiscard]] core::FieldTime field_time() const override {
    return grabber_->last().field.mid_exposure;
  }

 private:
  /// A field has at most one step's events, and of those before it is what the loop left when
  /// others had events, too.
  static constexpr std::int32_t kMostWaiting = 4 * core::kMaxEventsPerField;

  const drivers::SimulatedFrameGrabber* grabber_;
  std::int64_t collected_ = 0;  ///< deliveries of the grabber whose events were collected
  std::int32_t taken_ = 0;      ///< of the events waiting
  core::StaticVector<core::Event, kMostWaiting> waiting_;
};

}  // namespace tubesight::board
