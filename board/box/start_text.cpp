#include "board/box/start_text.h"

#include "core/base/words.h"

namespace tubesight::board {

std::string refusal_text(const core::StartReply& reply) {
  std::string text(core::explain(reply.refusal));
  if (reply.click >= 0) {
    text += " (click " + std::to_string(reply.click + 1) + ")";
  }
  return text;
}

}  // namespace tubesight::board
