// Scenarios: the text is cut at lines "#---" into scenario.toml, 1.toml, 2.toml ..., so that
// includes are reached too. Whatever it holds: a scenario that can be played, or messages.
#include "drivers/scenario/scenario_file.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "tests/fuzz/cut_files.h"

namespace {

using namespace tubesight;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

void check(const drivers::Scenario& scenario) {
  require(scenario.told.start.tubes.size() >= 3);
  require(scenario.video.rate_numerator > 0 && scenario.video.rate_denominator > 0);
  require(std::isfinite(scenario.from.x_mm) && scenario.from.height_mm >= 0.0);
  require(scenario.path.size() <= core::kinematics::kMaxPathSegments);
  for (std::size_t i = 1; i < scenario.events.size(); ++i) {
    require(scenario.events[i - 1].at_s <= scenario.events[i].at_s);
  }
  for (const drivers::Fault& fault : scenario.faults) {
    require(fault.at_s >= 0.0 && fault.for_s >= 0.0);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto file = std::make_unique<drivers::ScenarioFile>();
  drivers::Messages messages;
  fuzz::CutFiles files({reinterpret_cast<const char*>(data), size}, "scenario.toml");
  const bool good = drivers::load_scenario(files, "scenario.toml", {}, *file, messages).has_value();
  require(good == messages.empty());
  for (const std::string& message : messages) {
    require(message.find('\n') == std::string::npos);
  }
  if (good) {
    check(file->scenario);
  }
  return 0;
}
