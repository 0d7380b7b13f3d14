#include "board/bench/simulate/scenario_events.h"

#include <array>
#include <string>
#include <string_view>

#include "drivers/settings/read_table.h"
#include "drivers/settings/session_checks.h"

namespace tubesight::board {
namespace {

using core::EventKind;
using drivers::TableReader;

// Those that reach the box from outside, by the words of an event file; in the enumerators' order.
constexpr std::array<std::string_view, 6> kWords = {"claim", "start", "lamp",
                                                    "pose",  "pick",  "acknowledge"};
constexpr std::array<EventKind, 6> kKinds = {EventKind::kClaim,       EventKind::kStart,
                                             EventKind::kLampCommand, EventKind::kPoseRequest,
                                             EventKind::kPick,        EventKind::kAcknowledge};

void read_event(TableReader& table, const core::SessionSettings& told, double length_s,
                ScenarioEvents& to) {
  drivers::ScenarioEvent told_event;
  std::size_t kind = 0;
  if (table.number("at_s", {0.0, 86400.0, " s"}, told_event.at_s) && length_s > 0.0 &&
      told_event.at_s >= length_s) {
    table.complain("at_s", "after the recording's end, expected within it");
  }
  if (!table.word("kind", kWords, kind)) {
    for (const char* const key : {"tube", "lamp_permille", "at_px", "click_on", "off_center"}) {
      table.ignore(key);
    }
    return;
  }
  core::Event& event = told_event.event;
  event.kind = kKinds[kind];
  if (event.kind == EventKind::kClaim) {
    // A robot may claim what is not there; that is what the box is asked for.
    table.address("tube", event.claim);
  } else if (event.kind == EventKind::kLampCommand) {
    table.whole("lamp_permille", {0, 1000}, event.lamp_permille);
  } else if (event.kind == EventKind::kPick) {
    if (table.numbers("at_px", {0.0, 4096.0, " px"}, event.pick_px) &&
        !drivers::in_picture(told.camera, event.pick_px)) {
      table.complain("at_px",
                     drivers::point_text(event.pick_px) + ", expected a place in the picture");
    }
  } else if (event.kind == EventKind::kStart) {
    ClickWish wish;
    wish.at_s = told_event.at_s;
    wish.event = static_cast<std::ptrdiff_t>(to.events->size());
    read_click_wish(table, told.tubesheet, wish);
    to.wishes->push_back(wish);
  }
  to.events->push_back(told_event);
  to.places->push_back({table.name() + ".at_s", table.place_of("at_s")});
}

}  // namespace

void read_events(drivers::SettingsDocument& document, const core::SessionSettings& told,
                 double length_s, ScenarioEvents to) {
  drivers::read_each_table(document, "event", [&](TableReader& table, std::size_t) {
    read_event(table, told, length_s, to);
  });
}

}  // namespace tubesight::board
