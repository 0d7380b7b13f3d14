// Lines of the control socket: whatever the bytes, either an event that keeps the promises of
// hal::OperatorStation, or an answer in one line.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <variant>

#include "board/visionbox/control_protocol.h"

namespace {

using namespace tubesight;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

bool finite(const std::array<double, 2>& at_px) {
  return std::isfinite(at_px[0]) && std::isfinite(at_px[1]);
}

void check(const core::Event& event) {
  require(event.origin == core::EventOrigin::kOperator);
  if (const auto* const lamp = core::content_if<core::LampCommand>(event)) {
    require(lamp->permille >= 0 && lamp->permille <= 1000);
  } else if (const auto* const pick = core::content_if<core::Pick>(event)) {
    require(finite(pick->at_px));
  } else if (const auto* const start = core::content_if<core::Start>(event)) {
    require(!start->tubes.empty());
    for (const core::StartPoint& point : start->tubes) {
      require(finite(point.at_px));
    }
  } else {
    require(false);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  const board::ControlRequest request = board::parse_request(line, {});
  if (const auto* const event = std::get_if<board::EventRequest>(&request.content)) {
    check(event->event);
  } else if (const auto* const wrong = std::get_if<board::WrongRequest>(&request.content)) {
    const std::string answer = board::refusal_answer(request.command, wrong->error);
    require(answer.find('\n') == std::string::npos && answer.starts_with("{\"protocol\":1,"));
    require(drivers::find_json_string(answer, "text").size() <= answer.size());
  }
  require(drivers::find_json_string(line, "text").size() <= size);
  static_cast<void>(drivers::find_json_number(line, "n", 0));
  return 0;
}
