#include "board/bench/campaign/move_reducer.h"

#include <algorithm>
#include <memory>

namespace tubesight::board::campaign {
namespace {

using core::kinematics::SegmentKind;
using drivers::Scenario;

// Scenario files hold no fault that ends after the recording.
void cut_faults(Scenario& scenario) {
  const double length_s = scenario.video.length_s;
  if (length_s <= 0.0) {
    return;
  }
  auto& faults = scenario.faults;
  faults.erase(std::remove_if(faults.begin(), faults.end(),
                              [length_s](const auto& fault) { return fault.at_s >= length_s; }),
               faults.end());
  for (drivers::Fault& fault : faults) {
    fault.for_s = fault.for_s > 0.0 ? std::min(fault.for_s, length_s - fault.at_s) : 0.0;
  }
}

/// Tries changes on a copy and keeps those that leave the scenario showing it.
class Reducer {
 public:
  Reducer(Scenario& scenario, const ShowsIt& shows_it)
      : scenario_(scenario), shows_it_(shows_it), trial_(std::make_unique<Scenario>(scenario)) {}

  void run() {
    bool changed = true;
    while (changed) {
      changed = drop_faults();
      changed = drop_segments() || changed;
      changed = shorten() || changed;
    }
    drop_things();
  }

 private:
  template <typename Change>
  bool try_change(Change change) {
    *trial_ = scenario_;
    change(*trial_);
    cut_faults(*trial_);
    if (!shows_it_(*trial_)) {
      return false;
    }
    scenario_ = *trial_;
    return true;
  }

  template <typename Items>
  bool drop_each(Items Scenario::*items) {
    bool changed = false;
    for (std::size_t i = (scenario_.*items).size(); i-- > 0;) {
      changed = try_change([&](Scenario& trial) {
                  auto& list = trial.*items;
                  list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
                }) ||
                changed;
    }
    return changed;
  }

  bool drop_faults() { return drop_each(&Scenario::faults); }
  bool drop_segments() { return drop_each(&Scenario::path); }

  // Halves what takes time, as long as a field remains of it.
  bool shorten() {
    constexpr double kLeast_s = 0.03;
    bool changed = false;
    for (std::size_t i = 0; i < scenario_.path.size(); ++i) {
      const auto& segment = scenario_.path[i];
      if (segment.kind == SegmentKind::kRest && segment.rest_s > kLeast_s) {
        changed = try_change([i](Scenario& trial) { trial.path[i].rest_s /= 2.0; }) || changed;
      }
    }
    for (std::size_t i = 0; i < scenario_.faults.size(); ++i) {
      if (scenario_.faults[i].for_s > kLeast_s) {
        changed = try_change([i](Scenario& trial) { trial.faults[i].for_s /= 2.0; }) || changed;
      }
    }
    if (scenario_.video.length_s > 4.0 * kLeast_s) {
      changed = try_change([](Scenario& trial) { trial.video.length_s *= 0.8; }) || changed;
    }
    return changed;
  }

  // What makes a picture, a plant or a calibration less than perfect, one thing at a time.
  void drop_things() {
    try_change([](Scenario& trial) { trial.scene.plugs.clear(); });
    try_change([](Scenario& trial) { trial.told.tubesheet.plugged.clear(); });
    try_change([](Scenario& trial) {
      trial.scene.sheet.missing.clear();
      trial.told.tubesheet.missing.clear();
    });
    try_change([](Scenario& trial) { trial.told.camera = trial.scene.camera; });
    try_change([](Scenario& trial) { trial.told.tool = trial.scene.tool; });
    try_change([](Scenario& trial) { trial.told.tubesheet.bore_mm = trial.scene.sheet.bore_mm; });
    try_change([](Scenario& trial) { trial.scene.look.boron = 0.0; });
    try_change([](Scenario& trial) { trial.scene.look.nicked = 0.0; });
    try_change([](Scenario& trial) { trial.scene.sensor.salt_and_pepper = 0.0; });
    try_change([](Scenario& trial) { trial.scene.sensor.emi_share = 0.0; });
    try_change([](Scenario& trial) { trial.from.beta_deg = trial.from.gamma_deg = 0.0; });
  }

  Scenario& scenario_;
  const ShowsIt& shows_it_;
  std::unique_ptr<Scenario> trial_;
};

}  // namespace

void reduce(Scenario& scenario, const ShowsIt& shows_it) { Reducer(scenario, shows_it).run(); }

}  // namespace tubesight::board::campaign
