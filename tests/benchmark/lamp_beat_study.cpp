// What a lamp's pulses do that beat with the exposure: `lamp_beat_study [SECONDS]`, for
// docs/lamp.md.
//
// An LED without lag, 60 fields a second, the tool at rest. Each field is drawn in the light that
// the wave of the pulses has while its shutter is open; the box sets the level and looks for its
// pattern. Printed are the ripple of that light at the level in force, as the difference of the
// brightest and the dimmest field and as their deviation, both in % of the mean, and what the box
// makes of it. Exit status 1 when a field was vouched
// for wrongly.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "core/base/sighting.h"
#include "core/lighting/lamp_policy.h"
#include "core/rendering/exposure.h"
#include "tests/support/simulated_bench.h"

namespace tubesight::benchmark {
namespace {

struct Pulses {
  double hz;
  double exposure_s;
};

struct Ripple {
  double whole_percent = 0.0;
  double sigma_percent = 0.0;
};

constexpr double kFields_hz = 60.0;

/// Of the fields of a minute.
Ripple ripple_of(const Pulses& pulses, double duty) {
  double least = 1e9;
  double most = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kFields = 3600;
  for (int field = 0; field < kFields; ++field) {
    const double middle_s = 1.0 + field / kFields_hz;
    const double light =
        core::rendering::pulsed_light(duty, 1.0 / pulses.hz, middle_s - pulses.exposure_s / 2.0,
                                      middle_s + pulses.exposure_s / 2.0);
    least = std::min(least, light);
    most = std::max(most, light);
    sum += light;
    squares += light * light;
  }
  const double mean = sum / kFields;
  return {(most - least) / mean * 100.0,
          std::sqrt(std::max(squares / kFields - mean * mean, 0.0)) / mean * 100.0};
}

/// Whether anything wrong was vouched for.
bool study(const Pulses& pulses, double seconds) {
  const auto bench = std::make_unique<tests::SimulatedBench>();
  bench->scenario.video.window_margin_px = 4;
  bench->scenario.video.length_s = seconds + 1.0;
  bench->scenario.video.exposure_s = pulses.exposure_s;
  bench->scenario.light.pwm_hz = pulses.hz;
  bench->lamp = {true, true, 11};
  bench->start();
  const auto fields = static_cast<int>(seconds * kFields_hz);
  int proved = 0;
  int failed = 0;
  int faulty = 0;
  std::int32_t least = 1000;
  std::int32_t most = 0;
  for (int field = 0; field < fields; ++field) {
    bench->run(1.0 / kFields_hz);
    proved += bench->sighting().liveness == core::Liveness::kProved ? 1 : 0;
    failed += bench->sighting().liveness == core::Liveness::kFailed ? 1 : 0;
    faulty += core::lighting::is_fault(bench->output().lamp) ? 1 : 0;
    if (field >= fields / 2) {
      least = std::min(least, bench->input().field.lamp_permille);
      most = std::max(most, bench->input().field.lamp_permille);
    }
  }
  const Ripple ripple = ripple_of(pulses, (least + most) / 2000.0);
  std::printf("| %.1f | %.1f | %.2f | %.2f | %.3f | %.3f | %.3f | %d to %d |\n", pulses.hz,
              pulses.exposure_s * 1e3, ripple.whole_percent, ripple.sigma_percent,
              static_cast<double>(proved) / fields, static_cast<double>(failed) / fields,
              static_cast<double>(faulty) / fields, static_cast<int>(least),
              static_cast<int>(most));
  std::fflush(stdout);
  return bench->wrong() > 0;
}

// Multiples of the fields' rate and others, near them and not; shutters of whole pulses and not.
constexpr std::array<Pulses, 18> kCases = {{{100.0, 0.001},
                                            {100.0, 0.004},
                                            {100.0, 0.0165},
                                            {120.0, 0.0165},
                                            {119.7, 0.004},
                                            {119.7, 0.0165},
                                            {1000.0, 0.001},
                                            {1003.0, 0.00125},
                                            {1003.0, 0.0042},
                                            {1003.0, 0.0165},
                                            {1019.7, 0.0165},
                                            {2000.0, 0.001},
                                            {2003.0, 0.00125},
                                            {2003.0, 0.0042},
                                            {2003.0, 0.0165},
                                            {10003.0, 0.00125},
                                            {16003.0, 0.00125},
                                            {16003.0, 0.0042}}};

}  // namespace

int run(double seconds) {
  std::printf(
      "| pulses Hz | exposure ms | ripple %% | sigma %% | proved | failed | faults | level "
      "permille "
      "|\n|---|---|---|---|---|---|---|---|\n");
  bool wrong = false;
  for (const Pulses& pulses : kCases) {
    wrong = study(pulses, seconds) || wrong;
  }
  return wrong ? EXIT_FAILURE : EXIT_SUCCESS;
}

}  // namespace tubesight::benchmark

int main(int argc, char** argv) {
  return tubesight::benchmark::run(argc > 1 ? std::atof(argv[1]) : 20.0);
}
