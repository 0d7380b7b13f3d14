#include "board/visionbox/replay_player.h"

#include <chrono>
#include <utility>

namespace tubesight::board {

using core::Result;
using core::Unexpected;

Result<void> ReplayPlayer::start(drivers::Messages& messages) {
  stop();
  grabber_ = std::make_unique<drivers::ReplayFrameGrabber>(session_->camera, recording_);
  const auto started = grabber_->start();
  messages.insert(messages.end(), grabber_->messages().begin(), grabber_->messages().end());
  TUBESIGHT_TRY(started);
  start_given_ = false;
  events_ = {};
  return script_ ? events_.load_beside(recording_, messages) : Result<void>();
}

void ReplayPlayer::stop() {
  lease_.reset();
  if (grabber_ != nullptr) {
    grabber_->stop();
  }
}

Result<void> ReplayPlayer::next(std::int32_t /*lamp_permille*/, PlayedField& out,
                                drivers::Messages& messages) {
  lease_.reset();
  auto lease = grabber_->grab_for(std::chrono::milliseconds(0));
  if (!lease) {
    messages.insert(messages.end(), grabber_->messages().begin(), grabber_->messages().end());
    return Unexpected(lease.error());
  }
  lease_ = *std::move(lease);
  out.field = lease_->field();
  out.events.clear();
  if (!script_) {
    return {};
  }
  if (!std::exchange(start_given_, true)) {
    core::Event start;
    start.origin = core::EventOrigin::kOperator;
    start.content = core::Start{session_->start.tubes, {}, false};
    static_cast<void>(out.events.try_push_back(start));  // it is empty
  }
  const core::Event* row = nullptr;
  while (!out.events.full() && (row = events_.next_before(out.field.number)) != nullptr) {
    // What became of a pose request is found out anew: the box is there to do so.
    if (core::content_if<core::PoseResult>(*row) == nullptr) {
      static_cast<void>(out.events.try_push_back(*row));  // there is room
    }
    events_.take_next();
  }
  return {};
}

core::FieldTime ReplayPlayer::span() const { return grabber_->shortest_span(); }

}  // namespace tubesight::board
