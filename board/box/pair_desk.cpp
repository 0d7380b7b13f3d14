#include "board/box/pair_desk.h"

#include <algorithm>

namespace tubesight::board {

void PairDesk::take(const core::EventList& events, const core::ReplyList& replies) {
  for (const core::Reply& reply : replies) {
    if (const auto* const asked = core::content_if<core::PoseRequestReply>(reply)) {
      if (asked->refusal != core::PoseReason::kNone) {
        continue;
      }
      // The session answers a request in the step that it came with.
      told_.reset();
      const auto* const event =
          std::find_if(events.begin(), events.end(), [&](const core::Event& one) {
            return one.id == reply.id && one.origin == reply.origin &&
                   core::content_if<core::PoseRequest>(one) != nullptr;
          });
      if (event == events.end()) {
        continue;
      }
      if (const auto& robot = core::content_if<core::PoseRequest>(*event)->robot) {
        told_ = Told{reply.id, reply.origin, *robot};
      }
    } else if (const auto* const pose = core::content_if<core::PoseReply>(reply)) {
      if (!told_ || told_->id != reply.id || told_->origin != reply.origin) {
        continue;
      }
      if (pose->verdict == core::PoseVerdict::kConfirmed &&
          !pairs_.try_push({told_->robot, pose->pose})) {
        ++lost_;
      }
      told_.reset();
    }
  }
}

std::optional<core::PosePair> PairDesk::take_pair() {
  core::PosePair pair;
  return pairs_.try_pop(pair) ? std::optional<core::PosePair>(pair) : std::nullopt;
}

}  // namespace tubesight::board
