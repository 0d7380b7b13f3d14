#include "drivers/scenario/scenario_events.h"

#include <array>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/assert.h"
#include "drivers/scenario/scenario_keys.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/session_keys.h"
#include "drivers/settings/session_tables.h"
#include "drivers/settings/session_text.h"

namespace tubesight::drivers {
namespace {

using drivers::TableReader;

// With clicks, or a wish for some.
core::Start read_clicked_start(TableReader& table, const core::SessionSettings& told, double at_s,
                               ScenarioEvents& to) {
  if (table.has(drivers::kClicksKey)) {
    core::StartSettings start;
    drivers::read_clicks(table, {&told.camera, &told.tubesheet}, 3, start);
    return {start.tubes, {}, false};
  }
  ClickWish wish;
  wish.at_s = at_s;
  wish.event = static_cast<std::ptrdiff_t>(to.events->size());
  read_click_wish(table, told.tubesheet, wish);
  to.wishes->push_back(wish);
  return {};
}

void read_event(TableReader& table, const core::SessionSettings& told, double length_s,
                ScenarioEvents& to) {
  drivers::ScenarioEvent told_event;
  std::size_t kind = 0;
  drivers::read_key(table, kEventTime, told_event);
  if (table.sound(kEventTime.key) && length_s > 0.0 && told_event.at_s >= length_s) {
    table.complain(kEventTime.key, "after the recording's end, expected within it");
  }
  if (!table.word(kEventKindKey, kEventWords, kind)) {
    for (const std::string_view key : {kClaimedTubeKey, kLampCommandKey.key, kPickPlaceKey.key,
                                       drivers::kClicksKey, kClickOnKey, kOffCenterKey}) {
      table.ignore(key);
    }
    return;
  }
  core::Event& event = told_event.event;
  switch (static_cast<ToldKind>(kind)) {
    case ToldKind::kClaim: {
      // A robot may claim what is not there; that is what the box is asked for.
      core::Claim claim;
      table.address(kClaimedTubeKey, claim.tube);
      event.content = claim;
      break;
    }
    case ToldKind::kLamp: {
      core::LampCommand lamp;
      drivers::read_key(table, kLampCommandKey, lamp);
      event.content = lamp;
      break;
    }
    case ToldKind::kPick: {
      core::Pick pick;
      drivers::read_key(table, kPickPlaceKey, pick);
      if (table.sound(kPickPlaceKey.key) && !drivers::in_picture(told.camera, pick.at_px)) {
        table.complain(kPickPlaceKey.key,
                       drivers::point_text(pick.at_px) + ", expected a place in the picture");
      }
      event.origin = core::EventOrigin::kOperator;
      event.content = pick;
      break;
    }
    case ToldKind::kStart:
      event.origin = core::EventOrigin::kOperator;
      event.content = read_clicked_start(table, told, told_event.at_s, to);
      break;
    case ToldKind::kPose: event.content = core::PoseRequest{}; break;
    case ToldKind::kAcknowledge:
      event.origin = core::EventOrigin::kOperator;
      event.content = core::Acknowledge{};
      break;
  }
  to.events->push_back(told_event);
  to.places->push_back({table.name() + ".at_s", table.place_of(kEventTime.key)});
}

}  // namespace

void read_events(drivers::SettingsDocument& document, const core::SessionSettings& told,
                 double length_s, ScenarioEvents to) {
  drivers::read_each_table(document, "event", [&](TableReader& table, std::size_t) {
    read_event(table, told, length_s, to);
  });
}

void write_event(drivers::TomlWriter& toml, const drivers::ScenarioEvent& told) {
  const auto begin = [&](ToldKind kind) {
    toml.entry("event");
    drivers::write_key(toml, kEventTime, told);
    toml.text(kEventKindKey, kEventWords[static_cast<std::size_t>(kind)]);
  };
  const auto never = [](const auto& /*content*/) { TUBESIGHT_ASSERT(false); };
  std::visit(core::Overloaded{
                 [&](const core::Claim& claim) {
                   begin(ToldKind::kClaim);
                   toml.wholes(kClaimedTubeKey, std::array{claim.tube.row, claim.tube.column});
                 },
                 [&](const core::LampCommand& lamp) {
                   begin(ToldKind::kLamp);
                   drivers::write_key(toml, kLampCommandKey, lamp);
                 },
                 [&](const core::Pick& pick) {
                   begin(ToldKind::kPick);
                   drivers::write_key(toml, kPickPlaceKey, pick);
                 },
                 [&](const core::PoseRequest& /*request*/) { begin(ToldKind::kPose); },
                 [&](const core::Acknowledge& /*seen*/) { begin(ToldKind::kAcknowledge); },
                 [&](const core::Start& start) {
                   begin(ToldKind::kStart);
                   drivers::write_clicks(toml, start.tubes);
                 },
                 [&](const core::PoseResult& result) { never(result); },
             },
             told.event.content);
}

}  // namespace tubesight::drivers
