#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "drivers/scenario/scenario_file.h"
#include "tests/drivers/settings/settings_files.h"

namespace tubesight::drivers {

/// `text` beside camera, tool, sheet and window of an ordinary plant, read as "s.toml".
struct ScenarioReading {
  std::unique_ptr<ScenarioFile> file = std::make_unique<ScenarioFile>();
  drivers::Messages messages;
  bool good = false;

  explicit ScenarioReading(const std::string& text, const ScenarioOverrides& overrides = {},
                           const std::string& sheet = drivers::kTubesheetTable) {
    drivers::MemoryFiles files;
    files.texts["s.toml"] = "include = [\"plant.toml\"]\n" + text;
    files.texts["plant.toml"] = drivers::kCameraTable + drivers::kToolTable + sheet +
                                "[start]\nwindow_px = [40, 36, 595, 330]\n";
    good = load_scenario(files, "s.toml", overrides, *file, messages).has_value();
  }

  [[nodiscard]] const drivers::Scenario& scenario() const { return file->scenario; }
  /// All messages, one a line.
  [[nodiscard]] std::string told() const {
    std::string all;
    for (const std::string& message : messages) {
      all += message + "\n";
    }
    return all;
  }
};

/// The least that a path needs.
inline const std::string kRestPath = "[path]\ntube = [40, 60]\n[[step]]\nrest_s = 1.0\n";

}  // namespace tubesight::drivers
