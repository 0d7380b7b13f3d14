#include "drivers/scenario/scenario_clicks.h"

#include <algorithm>
#include <cmath>

#include "core/base/trigonometry.h"
#include "drivers/scenario/scenario_keys.h"
#include "drivers/scenario/tubes_in_view.h"
#include "drivers/settings/session_checks.h"
#include "drivers/simulated/dice.h"
#include "drivers/simulated/tool_motion.h"

namespace tubesight::drivers {

using core::TubeAddress;
using drivers::TableReader;

void read_click_wish(TableReader& table, const core::TubesheetSettings& sheet, ClickWish& wish) {
  constexpr const char* kExpected = "3 to 8 times [row, column]";
  wish.place = table.place();
  wish.name = table.name();
  // The conventions let an operator be 60 % off.
  table.optional_number(kOffCenterKey, {0.0, 0.6, ""}, wish.off_center);
  const toml::array* const list = table.list(kClickOnKey, false, kExpected);
  if (list == nullptr) {
    return;
  }
  if (list->size() < 3 || list->size() > core::kMaxStartPoints) {
    table.complain(kClickOnKey, drivers::describe(*list) + ", expected " + kExpected);
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    TubeAddress tube;
    const std::string wrong = drivers::read_address((*list)[i], tube)
                                  ? drivers::why_no_tube(sheet, tube)
                                  : drivers::why_no_address((*list)[i]);
    if (!wrong.empty()) {
      table.complain_entry(kClickOnKey, i, (*list)[i], wrong);
    }
    wish.tubes.push_back(tube);
  }
}

std::string make_clicks(const ClickWish& wish, const drivers::Scenario& scenario,
                        drivers::SimulatedWorld& world,
                        decltype(core::StartSettings::tubes)& clicks) {
  const auto wanted = drivers::instant_of(wish.at_s);
  std::int64_t slot = 0;
  while (slot < world.slots() && (world.slot_time(slot) < wanted || world.faults_at(slot).lost)) {
    ++slot;
  }
  if (slot == world.slots()) {
    return "no field is delivered from then on, expected one to click in";
  }
  std::vector<TubeInView> in_view;
  list_tubes_in_view(world.truth(), scenario.scene, world.truth_of(slot), world.faults_at(slot),
                     in_view);
  std::vector<TubeInView> chosen;
  if (wish.tubes.empty()) {
    chosen = choose_start_tubes(in_view, scenario.told.start);
    if (chosen.size() < 3) {
      return "fewer than three open tube-ends stand wholly in window_px then, expected another "
             "window, height or tool";
    }
  }
  for (const TubeAddress tube : wish.tubes) {
    const auto found = std::find_if(in_view.begin(), in_view.end(),
                                    [&](const TubeInView& each) { return each.address == tube; });
    if (found == in_view.end() || found->image.rim_in_frame < 1.0 || found->image.occluded >= 1.0 ||
        found->end.kind == core::rendering::TubeEndKind::kVoid) {
      return drivers::address_text(tube) +
             " is not in the picture then, expected tubes to click on that are";
    }
    chosen.push_back(*found);
  }
  clicks.clear();
  drivers::Dice dice(
      drivers::derived_seed(scenario.seed, 0xC11C0000U + static_cast<std::uint64_t>(slot)));
  constexpr double kTurn = 2.0 * core::kPi;
  for (const TubeInView& tube : chosen) {
    const double direction = kTurn * dice.share();
    const auto& [u, v] = tube.image.ellipse_px;
    const auto& [half_u, half_v] = tube.image.half_px;
    // A mouse points at whole pixels.
    static_cast<void>(
        clicks.try_push_back({tube.address,
                              {std::round(u + wish.off_center * half_u * std::cos(direction)),
                               std::round(v + wish.off_center * half_v * std::sin(direction))}}));
  }
  core::StartSettings start;
  start.tubes = clicks;
  return drivers::why_clicks_contradict(start, &scenario.told.tubesheet);
}

}  // namespace tubesight::drivers
