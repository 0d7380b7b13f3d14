// Event files: whatever the text, either rows that keep the promises of ReplayEvents, or messages.
#include "drivers/replay/replay_events.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

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
  if (const auto* const lamp = core::content_if<core::LampCommand>(event)) {
    require(lamp->permille >= 0 && lamp->permille <= 1000);
  } else if (const auto* const pick = core::content_if<core::Pick>(event)) {
    require(finite(pick->at_px));
  } else if (const auto* const start = core::content_if<core::Start>(event)) {
    require(start->tubes.size() >= 3);
    for (const core::StartPoint& point : start->tubes) {
      require(finite(point.at_px));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  drivers::ReplayEvents events;
  drivers::Messages messages;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const bool good = events.parse(text, "fuzz.events.csv", messages).has_value();
  require(good == messages.empty());
  for (const std::string& message : messages) {
    require(message.find('\n') == std::string::npos && message.starts_with("fuzz.events.csv:"));
  }
  core::EventList list;
  std::size_t taken = 0;
  for (std::int64_t field = 0; field < 8; ++field) {
    events.take_before(field, list);
    for (const core::Event& event : list) {
      check(event);
      ++taken;
    }
  }
  require(taken + events.left() == events.size());
  return 0;
}
