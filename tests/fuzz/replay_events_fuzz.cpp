// Event files: whatever the text, either rows that keep the promises of ReplayEvents, or messages.
#include "drivers/replay/replay_events.h"

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

void check(const core::Event& event) {
  require(event.lamp_permille >= 0 && event.lamp_permille <= 1000);
  require(std::isfinite(event.pick_px[0]) && std::isfinite(event.pick_px[1]));
  require(event.kind != core::EventKind::kStart || event.start.size() >= 3);
  for (const core::StartPoint& point : event.start) {
    require(std::isfinite(point.at_px[0]) && std::isfinite(point.at_px[1]));
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
