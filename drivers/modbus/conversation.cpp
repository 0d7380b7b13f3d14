#include "drivers/modbus/conversation.h"

#include "core/base/assert.h"

namespace tubesight::drivers {

using core::FieldTime;

std::optional<ReadyAnswer> Conversation::take(std::span<const std::uint8_t> request,
                                              FieldTime arrival) {
  TUBESIGHT_ASSERT(!waits_);
  ReadyAnswer answer;
  answer.arrival = arrival;
  switch (handler_.take(request, arrival, answer.pdu)) {
    case RequestHandler::Outcome::kAnswered: return answer;
    case RequestHandler::Outcome::kRefused: answer.refused = true; return answer;
    case RequestHandler::Outcome::kWaits: break;
  }
  waits_ = true;
  arrival_ = arrival;
  deadline_.set(kClaimWaits);
  return std::nullopt;
}

std::optional<ReadyAnswer> Conversation::finish(FieldTime now) {
  if (!waits_) {
    return std::nullopt;
  }
  if (dialogue_.claim_waits()) {
    if (!deadline_.went_off()) {
      return std::nullopt;
    }
    dialogue_.give_up_claim(now);
  }
  ReadyAnswer answer;
  answer.judged = true;
  answer.arrival = arrival_;
  handler_.finish(now, answer.pdu);
  abandon();
  return answer;
}

}  // namespace tubesight::drivers
