#include "board/bench/script/replay_script.h"

namespace tubesight::board {

ReplayScript::ReplayScript(const core::StartSettings& start, drivers::ReplayEvents& recorded,
                           const drivers::ReplayFrameGrabber& grabber)
    : recorded_(&recorded), grabber_(&grabber) {
  start_.origin = core::EventOrigin::kOperator;
  start_.content = core::Start{start.tubes, {}, false};
}

const core::Event* ReplayScript::next() {
  if (skips_) {
    skips_ = false;
    while (recorded_->next_before(grabber_->field_number() - 1) != nullptr) {
      recorded_->take_next();
    }
  }
  return started_ ? recorded_->next_before(grabber_->field_number()) : &start_;
}

void ReplayScript::take() {
  if (started_) {
    recorded_->take_next();
  }
  started_ = true;
}

}  // namespace tubesight::board
