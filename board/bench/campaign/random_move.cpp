#include "board/bench/campaign/random_move.h"

#include "board/bench/campaign/random_parts.h"
#include "board/bench/campaign/random_source.h"
#include "board/bench/campaign/random_stream.h"

namespace tubesight::board::campaign {
namespace {

// What has random numbers of its own.
enum class Topic : std::uint8_t { kPlant, kCamera, kLight, kPath, kClicks, kFaults, kNoise };
constexpr std::uint64_t kTopics = 16;  // room for more

}  // namespace

void MoveMaker::make(std::uint64_t seed, std::int64_t move, drivers::Scenario& scenario) {
  const Stratum stratum = stratum_at(stratum_of_move(move));
  // A view without three tube-ends to click at is none that an operator starts in: draw another.
  for (std::uint64_t attempt = 0;; ++attempt) {
    const auto source = [&](Topic topic) {
      return RandomSource(seed, move, attempt * kTopics + static_cast<std::uint64_t>(topic));
    };
    RandomSource plant = source(Topic::kPlant);
    RandomSource camera = source(Topic::kCamera);
    RandomSource light = source(Topic::kLight);
    RandomSource path = source(Topic::kPath);
    RandomSource clicks = source(Topic::kClicks);
    RandomSource faults = source(Topic::kFaults);
    RandomSource noise = source(Topic::kNoise);
    draw_plant(stratum, plant, scenario);
    draw_camera(stratum, camera, scenario);
    draw_light(light, scenario);
    if (options_.sizes) {
      RandomSource size = random_stream(seed, move, "picture size", attempt);
      draw_size(size, scenario);
    }
    scenario.events.clear();
    scenario.seed = static_cast<std::uint64_t>(noise.whole(1, 2'000'000'000));
    if (!truth_->configure(scenario.scene)) {
      continue;
    }
    draw_path(stratum, path, truth_->tube_ends(), scenario);
    draw_faults(stratum, faults, scenario);
    draw_deceptions(stratum, seed, move, truth_->tube_ends(), scenario);
    if (!truth_->configure(scenario.scene)) {
      continue;
    }
    draw_source_faults(seed, move, stratum, scenario);
    draw_spoilt_picture(seed, move, stratum, scenario);
    leave_out_faults_of_fields(scenario);
    if (draw_clicks(clicks, *truth_, core::kinematics::transform_of(scenario.from), scenario,
                    scenario.told.start.tubes)) {
      draw_wrong_starts(stratum, seed, move, *truth_, scenario);
      return;
    }
  }
}

}  // namespace tubesight::board::campaign
