#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/field.h"
#include "drivers/modbus/dialogue.h"
#include "drivers/modbus/request_handler.h"
#include "drivers/modbus/timer.h"

namespace tubesight::drivers {

/// An answer that is ready to be sent.
struct ReadyAnswer {
  Pdu pdu;
  bool refused = false;  ///< an exception
  bool judged = false;   ///< the verdict of a claim was waited for
  core::FieldTime arrival{0};
};

/// One master's requests and the answers to them, at most one at a time. One thread; no heap.
class Conversation {
 public:
  Conversation(WordOrder order, LinkState& state, Outbox& outbox)
      : dialogue_(order, state, outbox) {}

  /// Another master begins.
  void reset() {
    dialogue_.reset();
    waits_ = false;
    deadline_.cancel();
  }

  /// Takes a request; empty: its answer waits for a verdict. Needs: none waits.
  [[nodiscard]] std::optional<ReadyAnswer> take(std::span<const std::uint8_t> request,
                                                core::FieldTime arrival);

  /// As take(), of a request that came while an answer waited, nobody knows when: a claim is
  /// refused, as it would be judged at the wrong instant.
  [[nodiscard]] std::optional<ReadyAnswer> take_late(std::span<const std::uint8_t> request,
                                                     core::FieldTime now) {
    dialogue_.refuse_claims(true);
    auto answer = take(request, now);
    dialogue_.refuse_claims(false);
    return answer;
  }

  void hear(const core::Reply& reply, core::FieldTime now) { dialogue_.hear(reply, now); }

  /// Whether an answer waits for a verdict.
  [[nodiscard]] bool waits() const { return waits_; }
  /// The answer that waited, when its verdict is there or its time is over.
  [[nodiscard]] std::optional<ReadyAnswer> finish(core::FieldTime now);
  /// Nobody wants the answer that waits any more.
  void abandon() {
    waits_ = false;
    deadline_.cancel();
  }
  /// Runs while an answer waits.
  [[nodiscard]] const Timer& deadline() const { return deadline_; }

 private:
  Dialogue dialogue_;
  RequestHandler handler_{dialogue_};
  Timer deadline_;
  bool waits_ = false;
  core::FieldTime arrival_{0};
};

}  // namespace tubesight::drivers
