#include "board/bench/script/simulated_script.h"

#include "core/base/assert.h"

namespace tubesight::board {

const core::Event* SimulatedScript::next() {
  if (grabber_->delivered() != collected_) {
    collected_ = grabber_->delivered();
    if (taken_ == waiting_.size()) {
      waiting_.clear();
      taken_ = 0;
    }
    for (const core::Event& event : grabber_->last().events) {
      const bool room = waiting_.try_push_back(event);
      TUBESIGHT_ASSERT(room);
    }
  }
  return taken_ < waiting_.size() ? &waiting_[taken_] : nullptr;
}

void SimulatedScript::take() {
  TUBESIGHT_ASSERT(taken_ < waiting_.size());
  ++taken_;
}

}  // namespace tubesight::board
