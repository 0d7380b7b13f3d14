#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/settings.h"
#include "core/kinematics/tool_path.h"
#include "drivers/scenario/scenario_effects.h"
#include "drivers/settings/settings_document.h"
#include "drivers/settings/table_reader.h"
#include "drivers/simulated/scenario.h"

namespace tubesight::drivers {

/// Reads `[path]` and each `[[step]]`: where the tool starts, what it does, and what the robot
/// claims meanwhile.
class PathReader {
 public:
  /// `sheet` is what the robot believes; `seed` scatters where moves end.
  PathReader(const core::TubesheetSettings& sheet, std::uint64_t seed, drivers::Scenario& scenario);
  ~PathReader();

  /// Replaces from, path and (by claims) events of the scenario. Says whether all was well.
  bool read(drivers::SettingsDocument& document);

  /// Of the whole path.
  [[nodiscard]] const core::kinematics::ToolPath& path() const { return *path_; }

  /// Where the claims stand, one an event that was read.
  [[nodiscard]] const std::vector<EventPlace>& claims() const { return claims_; }

 private:
  /// How a step moves.
  struct Manner {
    core::kinematics::SpeedShape shape = core::kinematics::SpeedShape::kTrapezoid;
    core::kinematics::SpeedLimits move{150.0, 1000.0, 10000.0};  ///< mm
    core::kinematics::SpeedLimits turn{30.0, 120.0, 1200.0};     ///< degrees
  };

  void read_start(drivers::TableReader& table);
  void read_step(drivers::TableReader& table);
  void read_manner(drivers::TableReader& table, Manner& manner, bool turn);
  void read_rest(drivers::TableReader& table);
  void read_move(drivers::TableReader& table, core::kinematics::PathSegment& segment);
  void read_tour(drivers::TableReader& table);
  bool read_tube(drivers::TableReader& table, std::string_view key, core::TubeAddress& tube);
  bool append(drivers::TableReader& table, std::string_view key,
              const core::kinematics::PathSegment& segment);
  void visit(drivers::TableReader& table, core::TubeAddress tube, double rest_s, bool claim,
             core::kinematics::PathSegment move);
  void claim(const drivers::TableReader& table, std::string_view key, core::TubeAddress tube,
             double at_s);
  [[nodiscard]] std::array<double, 2> scattered();

  const core::TubesheetSettings* sheet_;
  drivers::Scenario* scenario_;
  std::unique_ptr<core::kinematics::ToolPath> path_;
  std::vector<EventPlace> claims_;
  Manner manner_;
  double scatter_mm_ = 0.0;
  std::uint64_t draws_ = 0;
  std::uint64_t seed_;
};

}  // namespace tubesight::drivers
