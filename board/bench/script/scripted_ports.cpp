#include "board/bench/script/scripted_ports.h"

namespace tubesight::board {

using core::Error;
using core::Result;
using core::Unexpected;

Result<void> ScriptReader::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  started_ = true;
  return {};
}

Result<std::optional<core::Event>> ScriptReader::poll() {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  const core::Event* const next = script_->next();
  if (next == nullptr || (origin_ && next->origin != *origin_)) {
    return std::optional<core::Event>();
  }
  core::Event event = *next;
  if (!event.at) {
    event.at = script_->field_time();
  }
  script_->take();
  return std::optional<core::Event>(event);
}

Result<void> ScriptReader::usable() const {
  return started_ ? Result<void>() : Unexpected(Error::kNotReady);
}

}  // namespace tubesight::board
