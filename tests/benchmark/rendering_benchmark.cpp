// How many fields a second core/rendering draws on one core: docs/performance.md.

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/rendering/renderer.h"
#include "tests/support/drawn_sheet.h"

namespace tubesight::benchmarks {
namespace {

using core::rendering::Exposure;

/// Draws fields of a tool that moves by `step_mm` each, even and odd lines in turn.
void draw(::benchmark::State& state, double step_mm, bool window_only) {
  tests::DrawnSheet sheet;
  auto picture = sheet.picture();
  const core::rendering::GreyImageView view = sheet.view(picture);
  std::int64_t field = 0;
  for (auto _ : state) {
    Exposure exposure = sheet.exposure(static_cast<double>(field % 64) * step_mm, step_mm);
    exposure.parity = field % 2 == 0 ? core::Parity::kEven : core::Parity::kOdd;
    exposure.noise_seed = static_cast<std::uint64_t>(field);
    if (window_only) {
      exposure.window = {40, 36, 595, 330};
    }
    sheet.renderer().render(exposure, view);
    ::benchmark::DoNotOptimize(picture.data());
    ++field;
  }
  state.counters["fields/s"] =
      ::benchmark::Counter(static_cast<double>(field), ::benchmark::Counter::kIsRate);
}

void whole_at_rest(::benchmark::State& state) { draw(state, 0.0, false); }
void whole_moving(::benchmark::State& state) {
  draw(state, 1.5, false);  // 90 mm/s
}
void window_at_rest(::benchmark::State& state) { draw(state, 0.0, true); }
void window_moving(::benchmark::State& state) { draw(state, 1.5, true); }

BENCHMARK(whole_at_rest)->Unit(::benchmark::kMillisecond);
BENCHMARK(whole_moving)->Unit(::benchmark::kMillisecond);
BENCHMARK(window_at_rest)->Unit(::benchmark::kMillisecond);
BENCHMARK(window_moving)->Unit(::benchmark::kMillisecond);

}  // namespace
}  // namespace tubesight::benchmarks

BENCHMARK_MAIN();
