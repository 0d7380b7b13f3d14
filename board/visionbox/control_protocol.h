#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/event.h"
#include "core/base/reply.h"
#include "core/base/settings.h"
#include "drivers/control/json_line.h"

namespace tubesight::board {

// The lines of the control socket; docs/control.md is the contract.

/// Its version: a request begins with it, and every answer names it.
inline constexpr std::int32_t kControlVersion = 1;

/// Where the box listens unless its settings say otherwise.
inline constexpr const char* kUsualControlSocket = "/run/tubesight/control";

/// Begins an answer with the members that all have.
[[nodiscard]] drivers::JsonLine begin_answer(std::string_view command, bool ok);

/// An answer that only says why not.
[[nodiscard]] std::string refusal_answer(std::string_view command, std::string_view error);

/// What a client asks for.
struct StatusRequest {};
struct SelfTestRequest {};
struct RecordRequest {};
struct EventRequest {
  core::Event event;  ///< without id and instant
};
struct WrongRequest {
  std::string error;
};
struct ControlRequest {
  std::string command;  ///< the word, for the answer
  std::variant<WrongRequest, StatusRequest, SelfTestRequest, RecordRequest, EventRequest> content;
};

/// Reads a line. `start` without tubes takes the clicks of the settings.
[[nodiscard]] ControlRequest parse_request(std::string_view line, const core::StartSettings& start);

/// The answer to `record` when the recording is in its place: `path`, without ending.
[[nodiscard]] std::string recorded_answer(std::string_view path);

/// What the box said to an event of a client.
[[nodiscard]] std::string reply_answer(std::string_view command, const core::Reply& reply);

}  // namespace tubesight::board
