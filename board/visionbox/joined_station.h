#pragma once

#include <optional>

#include "core/base/result.h"
#include "hal/operator_station.h"

namespace tubesight::board {

/// Two stations as one: what both do comes in turn, and an answer goes to the one whose ids its
/// number belongs to.
class JoinedStation final : public hal::OperatorStation {
 public:
  /// Both outlive this; ids of `second` begin at `first_of_second`.
  JoinedStation(hal::OperatorStation& first, hal::OperatorStation& second,
                std::int64_t first_of_second)
      : first_(&first), second_(&second), first_of_second_(first_of_second) {}

  [[nodiscard]] core::Result<void> start() override {
    TUBESIGHT_TRY(first_->start());
    const auto started = second_->start();
    if (!started) {
      first_->stop();
    }
    return started;
  }
  void stop() override {
    second_->stop();
    first_->stop();
  }
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override {
    const auto polled = first_->poll_event();
    return polled && !*polled ? second_->poll_event() : polled;
  }
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& reply) override {
    return (reply.id >= first_of_second_ ? second_ : first_)->send_reply(reply);
  }
  [[nodiscard]] core::Result<void> show(const core::RgbImageView& picture,
                                        const core::Sighting& sighting) override {
    TUBESIGHT_TRY(first_->show(picture, sighting));
    return second_->show(picture, sighting);
  }

 private:
  hal::OperatorStation* first_;
  hal::OperatorStation* second_;
  std::int64_t first_of_second_;
};

}  // namespace tubesight::board
