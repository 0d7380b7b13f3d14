#include "board/bench/simulate/scenario_events.h"

#include <array>
#include <string>
#include <string_view>

#include "drivers/settings/read_table.h"
#include "drivers/settings/session_checks.h"

namespace tubesight::board {
namespace {

using drivers::TableReader;

// Those that reach the box from outside, by the words of an event file; in the enumerators' order.
constexpr std::array<std::string_view, 6> kWords = {"claim", "start", "lamp",
                                                    "pose",  "pick",  "acknowledge"};
enum Kind : std::size_t { kClaim, kStart, kLamp, kPose, kPick, kAcknowledge };

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
  switch (kind) {
    case kClaim: {
      // A robot may claim what is not there; that is what the box is asked for.
      core::Claim claim;
      table.address("tube", claim.tube);
      event.content = claim;
      break;
    }
    case kLamp: {
      core::LampCommand lamp;
      table.whole("lamp_permille", {0, 1000}, lamp.permille);
      event.content = lamp;
      break;
    }
    case kPick: {
      core::Pick pick;
      if (table.numbers("at_px", {0.0, 4096.0, " px"}, pick.at_px) &&
          !drivers::in_picture(told.camera, pick.at_px)) {
        table.complain("at_px",
                       drivers::point_text(pick.at_px) + ", expected a place in the picture");
      }
      event.origin = core::EventOrigin::kOperator;
      event.content = pick;
      break;
    }
    case kStart: {
      ClickWish wish;
      wish.at_s = told_event.at_s;
      wish.event = static_cast<std::ptrdiff_t>(to.events->size());
      read_click_wish(table, told.tubesheet, wish);
      to.wishes->push_back(wish);
      event.origin = core::EventOrigin::kOperator;
      event.content = core::Start{};
      break;
    }
    case kPose: event.content = core::PoseRequest{}; break;
    case kAcknowledge:
      event.origin = core::EventOrigin::kOperator;
      event.content = core::Acknowledge{};
      break;
    default: break;
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
