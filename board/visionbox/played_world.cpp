#include "board/visionbox/played_world.h"

#include <utility>

#include "board/visionbox/replay_player.h"
#include "board/visionbox/simulated_player.h"

namespace tubesight::board {
namespace {

std::unique_ptr<FieldPlayer> make_player(const BoxSettings& settings) {
  if (settings.source.kind == SourceKind::kSimulated) {
    return std::make_unique<SimulatedPlayer>(settings.scenario.scenario, settings.source.script);
  }
  return std::make_unique<ReplayPlayer>(settings.told(), settings.source.recording,
                                        settings.source.script);
}

PlayedSourceSettings source_settings(const BoxSettings& settings) {
  const core::CameraSettings& camera = settings.told().camera;
  PlayedSourceSettings source;
  source.loop = settings.source.loop;
  source.in_real_time = settings.source.in_real_time;
  source.width_px = camera.width_px;
  source.height_px = camera.height_px;
  return source;
}

}  // namespace

PlayedWorld::PlayedWorld(const BoxSettings& settings, hal::OperatorStation& station,
                         bool scripted_robot, PlayedSource::Tell tell)
    : player_(make_player(settings)),
      source_(*player_, source_settings(settings), std::move(tell)),
      station_(source_, station, scripted_robot) {}

}  // namespace tubesight::board
