// How surely the lamp's pattern is found in the picture: `lamp_study [--sound HOURS] [--faults N]
// [--light N] [--again HOURS]`, for docs/lamp.md. --light looks at one of the lamps alone, from 0:
// an eighth.
//
// A simulated lamp and camera through the loop of the box, faster than it happens. --sound runs
// sound lamps of several lags, moving and at rest, with other light and without, and says how far
// the score that decides stays from a false alarm; --faults lets N of each kind of fault happen and
// says when each is named, and in brackets when the track was lost. --again takes what the sound
// runs' tube-ends did of themselves and lets the watch alone look at so many hours of lamps with
// it, and at 400 faults of each kind that come at rest. Exit status 1 when a sound lamp was
// reported, a fault was neither named nor ended the track, or anything wrong was vouched for.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "core/lighting/brightness_trail.h"
#include "core/lighting/tube_light.h"
#include "drivers/simulated/dice.h"
#include "tests/benchmark/watch_again.h"
#include "tests/support/simulated_bench.h"

namespace tubesight::benchmark {
namespace {

using core::Liveness;
using core::lighting::LampCondition;
using drivers::Dice;
using drivers::Fault;
using drivers::FaultKind;
using tests::SimulatedBench;

struct Light {
  double lag_s;
  double ring;
  bool moves;
  double speed_mm_s;
};

std::unique_ptr<SimulatedBench> make_bench(const Light& light, double length_s,
                                           std::uint64_t seed) {
  auto bench = std::make_unique<SimulatedBench>();
  bench->scenario.video.window_margin_px = 4;
  bench->scenario.video.length_s = length_s + 1.0;
  bench->scenario.light.lag_s = light.lag_s;
  bench->scenario.light.ring = light.ring;
  bench->scenario.seed = seed;
  bench->scenario.scene.seed = seed;
  bench->robot_settings.limits = {light.speed_mm_s, 600.0, 6000.0};
  bench->robot_settings.claim_period_s = 0.0;
  bench->lamp = {true, true, static_cast<std::uint32_t>(seed * 7919 + 5)};
  return bench;
}

/// Where the tool goes next: without an end, from tube to tube in the arm's reach.
void keep_moving(SimulatedBench& bench, const Light& light, Dice& dice) {
  if (light.moves && bench.robot().at_rest()) {
    const auto row = static_cast<std::int32_t>(dice.between(34.0, 47.0));
    const auto column = static_cast<std::int32_t>(dice.between(52.0, 68.0));
    static_cast<void>(bench.robot().move_to({row, column}));
  }
}

/// What a run without a fault came to.
struct Sound {
  std::int64_t fields = 0;
  std::int64_t proved = 0;
  std::int64_t failed = 0;
  std::int64_t faults = 0;  ///< fields in which the lamp was called faulty
  std::int64_t aligned_wrong = 0;
  double first_proof_s = -1.0;
  std::vector<double> scores;  ///< one a block
  std::vector<OtherChange> changes;
};

Sound run_sound(const Light& light, double seconds, std::uint64_t seed) {
  const auto bench = make_bench(light, seconds, seed);
  bench->start();
  Dice dice(seed);
  Sound sound;
  std::uint32_t looks = 0;
  core::lighting::BrightnessTrail trail;
  ChangeRecorder recorder({light.lag_s, light.ring});
  for (std::int64_t field = 0; field < static_cast<std::int64_t>(seconds * 60.0); ++field) {
    keep_moving(*bench, light, dice);
    bench->run(1.0 / 60.0);
    const core::Sighting& sighting = bench->sighting();
    ++sound.fields;
    sound.proved += sighting.liveness == Liveness::kProved ? 1 : 0;
    sound.failed += sighting.liveness == Liveness::kFailed ? 1 : 0;
    if (sighting.liveness == Liveness::kProved && sound.first_proof_s < 0.0) {
      sound.first_proof_s = static_cast<double>(field) / 60.0;
    }
    const auto& watch = bench->session().lighting().watch();
    if (watch.looks() != looks) {
      looks = watch.looks();
      sound.scores.push_back(watch.last_score_q4() / 16.0);
    }
    core::lighting::TubeLightList lights;
    core::lighting::list_tube_light(bench->output().tubes, lights);
    recorder.take(bench->input().field, trail.follow(bench->input().field, lights));
    const LampCondition condition = bench->output().lamp;
    sound.faults += core::lighting::is_fault(condition) ? 1 : 0;
  }
  sound.aligned_wrong = bench->wrong();
  sound.changes = recorder.changes();
  return sound;
}

constexpr std::array<Light, 8> kLights = {{{0.0, 0.0, false, 100.0},
                                           {0.07, 0.0, false, 100.0},
                                           {0.2, 0.3, false, 100.0},
                                           {0.0, 0.0, true, 100.0},
                                           {0.07, 0.0, true, 150.0},
                                           {0.1, 0.3, true, 100.0},
                                           {0.2, 0.0, true, 100.0},
                                           {0.03, 0.0, true, 300.0}}};

/// Alarms in 100 h, as the lowest hundredth of the scores goes on to the alarm's: its excesses over
/// the limit of that hundredth are taken to fall off as an exponential does (`power` 1, more than a
/// Gaussian's do), or as those of a Gaussian (`power` 2, squares of the distance from the mean).
double alarms_in_100_hours(std::vector<double> scores, double mean, double power) {
  constexpr double kAlarm = 6.0;
  constexpr double kLooks = 100.0 * 3600.0 * 4.0;
  const auto far = [&](double score) { return std::pow(std::max(mean - score, 0.0), power); };
  std::sort(scores.begin(), scores.end());
  const std::size_t count = scores.size() / 100;
  if (count < 10) {
    return -1.0;
  }
  double excess = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    excess += far(scores[i]) - far(scores[count]);
  }
  excess /= static_cast<double>(count);
  return kLooks * 0.01 * std::exp(-(far(-kAlarm) - far(scores[count])) / excess);
}

/// One of the lamps, or all.
bool is_chosen(const Light& light, int chosen) {
  return chosen < 0 || &light == &kLights.at(static_cast<std::size_t>(chosen));
}

/// Hours of a lamp with what the tube-ends did in runs that were drawn; at rest faults, too.
int study_again(const Light& light, const std::vector<OtherChange>& changes, double hours) {
  const LampModel lamp{light.lag_s, light.ring};
  const SoundHours sound = watch_sound(changes, lamp, hours, 1);
  std::printf(
      "again: %.0f h, first proof %.2f s, proved %.3f, doubted %.6f, alarms %ld, least %.1f\n",
      hours, sound.first_proof_s,
      static_cast<double>(sound.proved) / static_cast<double>(sound.fields),
      static_cast<double>(sound.doubted) / static_cast<double>(sound.fields),
      static_cast<long>(sound.alarms), sound.least_score_q4 / 16.0);
  for (const bool frozen : {false, true}) {
    if (light.moves) {
      break;  // what is put in the place of the picture rests
    }
    const FaultRuns faults = watch_faults(changes, lamp, frozen, 400, 1000);
    const auto share = [&](std::int64_t part) {
      return static_cast<double>(part) / static_cast<double>(faults.runs);
    };
    std::printf("again: %-12s mean %.2f s, most %.2f s, within 2 s %.3f, 10 s %.3f, 20 s %.3f\n",
                frozen ? "frozen" : "other camera",
                faults.sum_s / static_cast<double>(std::max<std::int64_t>(faults.told, 1)),
                faults.most_s, share(faults.within_2s), share(faults.within_10s),
                share(faults.told));
  }
  std::fflush(stdout);
  return sound.alarms > 0 ? 1 : 0;
}

int study_sound(double hours, int chosen, double again_hours) {
  std::printf(
      "| lag s | ring | speed mm/s | h | first proof s | proved | failed | score mean | "
      "sigma | least | alarms in 100 h: exponential | as a Gaussian |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  int wrong = 0;
  for (const Light& light : kLights) {
    if (!is_chosen(light, chosen)) {
      continue;
    }
    Sound all;
    double slowest_s = 0.0;
    const double seconds = hours * 3600.0 / static_cast<double>(kLights.size());
    const int runs = std::max(1, static_cast<int>(seconds / 120.0));
    for (int run = 0; run < runs; ++run) {
      Sound sound = run_sound(light, seconds / runs, static_cast<std::uint64_t>(run) + 1);
      all.fields += sound.fields;
      all.proved += sound.proved;
      all.failed += sound.failed;
      all.faults += sound.faults;
      wrong += sound.aligned_wrong > 0 ? 1 : 0;
      slowest_s = std::max(slowest_s, sound.first_proof_s < 0.0 ? 1e3 : sound.first_proof_s);
      all.scores.insert(all.scores.end(), sound.scores.begin(), sound.scores.end());
      all.changes.insert(all.changes.end(), sound.changes.begin(), sound.changes.end());
    }
    double mean = 0.0;
    double square = 0.0;
    double least = 1e9;
    for (const double score : all.scores) {
      mean += score;
      square += score * score;
      least = std::min(least, score);
    }
    const double n = std::max<double>(1.0, static_cast<double>(all.scores.size()));
    mean /= n;
    std::printf(
        "| %.2f | %.1f | %.0f | %.2f | %.2f | %.3f | %ld | %.1f | %.2f | %.1f | %.1g | %.1g |\n",
        light.lag_s, light.ring, light.moves ? light.speed_mm_s : 0.0,
        static_cast<double>(all.fields) / 216000.0, slowest_s,
        static_cast<double>(all.proved) / static_cast<double>(all.fields),
        static_cast<long>(all.failed + all.faults), mean,
        std::sqrt(std::max(0.0, square / n - mean * mean)), least,
        alarms_in_100_hours(all.scores, mean, 1.0), alarms_in_100_hours(all.scores, mean, 2.0));
    std::fflush(stdout);
    wrong += all.failed > 0 || all.faults > 0 ? 1 : 0;
    if (again_hours > 0.0) {
      wrong += study_again(light, all.changes, again_hours);
    }
  }
  return wrong;
}

struct Case {
  const char* name;
  FaultKind kind;
  double level;
  double for_s;
};

constexpr std::array<Case, 5> kCases = {{{"dead, other light", FaultKind::kLampOut, 0.0, 0.0},
                                         {"dead, dark", FaultKind::kLampOut, 0.0, 0.0},
                                         {"fades", FaultKind::kLampDrift, 0.05, 20.0},
                                         {"frozen", FaultKind::kFrozen, 0.0, 0.0},
                                         {"other camera", FaultKind::kOtherCamera, 0.0, 0.0}}};

int study_faults(int count, int chosen) {
  int wrong = 0;
  constexpr double kAt_s = 14.0;
  for (const Case& one : kCases) {
    for (const Light& light : kLights) {
      if (!is_chosen(light, chosen)) {
        continue;
      }
      std::printf("%-18s lag %.2f ring %.1f %s:", one.name, light.lag_s, light.ring,
                  light.moves ? "moving" : "rest  ");
      for (int run = 0; run < count; ++run) {
        Light lit = light;
        lit.ring = std::strcmp(one.name, "dead, other light") == 0 ? std::max(lit.ring, 0.5)
                   : std::strcmp(one.name, "dead, dark") == 0      ? 0.0
                                                                   : lit.ring;
        const auto bench = make_bench(lit, kAt_s + 40.0, static_cast<std::uint64_t>(run) + 100);
        Fault fault;
        fault.kind = one.kind;
        fault.at_s = kAt_s + 0.13 * run;
        fault.level = one.level;
        fault.for_s = one.for_s;
        fault.columns = one.kind == FaultKind::kOtherCamera ? 1 : 0;
        bench->scenario.faults = {fault};
        bench->start();
        Dice dice(static_cast<std::uint64_t>(run));
        double found_s = -1.0;
        std::string what = "-";
        double lost_s = -1.0;
        for (int field = 0; field < (kAt_s + 36.0) * 60.0 && found_s < 0.0; ++field) {
          keep_moving(*bench, light, dice);
          bench->run(1.0 / 60.0);
          const double since_s = field / 60.0 - fault.at_s;
          const auto& output = bench->output();
          if (since_s >= 0.0 && lost_s < 0.0 && output.sighting.state == core::TrackState::kLost) {
            lost_s = since_s;
          }
          if (since_s >= 0.0 &&
              (output.lamp == LampCondition::kUnseen || output.lamp == LampCondition::kWeak ||
               output.lamp == LampCondition::kDark)) {
            found_s = since_s;
            what = output.lamp == LampCondition::kUnseen ? "unseen"
                   : output.lamp == LampCondition::kWeak ? "weak"
                                                         : "dark";
          }
        }
        std::printf(" %s %.2f (%.2f)", what.c_str(), found_s, lost_s);
        wrong += (found_s < 0.0 && lost_s < 0.0) || bench->wrong() > 0 ? 1 : 0;
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
  return wrong;
}

}  // namespace

int run(int argc, char** argv) {
  double hours = 0.02;
  int faults = 1;
  int chosen = -1;
  double again = 0.0;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--sound") == 0) {
      hours = std::atof(argv[i + 1]);
    } else if (std::strcmp(argv[i], "--faults") == 0) {
      faults = std::atoi(argv[i + 1]);
    } else if (std::strcmp(argv[i], "--light") == 0) {
      chosen = std::clamp(std::atoi(argv[i + 1]), 0, static_cast<int>(kLights.size()) - 1);
    } else if (std::strcmp(argv[i], "--again") == 0) {
      again = std::atof(argv[i + 1]);
    }
  }
  int wrong = hours > 0.0 ? study_sound(hours, chosen, again) : 0;
  wrong += faults > 0 ? study_faults(faults, chosen) : 0;
  return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace tubesight::benchmark

int main(int argc, char** argv) { return tubesight::benchmark::run(argc, argv); }
