// step_benchmark [FOLDER] [--benchmark_...]: time a field and a tube-end, by kind of arithmetic,
// and to save the state.
//
// The recording lies in memory; the start's field is not timed. Without FOLDER the recording that
// ships with the repository is used.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "tests/benchmark/recorded_session.h"

namespace tubesight::tests {
namespace {

template <core::Scalar S>
void track_recording(benchmark::State& state, const RecordedSession& recording) {
  std::int64_t fields = 0;
  std::int64_t tubes = 0;
  for (auto iteration : state) {
    state.PauseTiming();
    SessionRun<S> run;
    if (!run.configure(recording.settings())) {
      state.SkipWithError("the settings are refused");
      break;
    }
    run.give(recording.fields().front());
    run.step();
    state.ResumeTiming();
    for (std::size_t i = 1; i < recording.fields().size(); ++i) {
      run.give(recording.fields()[i]);
      run.step();
      ++fields;
      tubes += run.output().sighting.tracked;
    }
    state.PauseTiming();
    if (run.output().sighting.state != core::TrackState::kTracking) {
      state.SkipWithError("the track was lost");
      break;
    }
    state.ResumeTiming();
  }
  const auto time_each = benchmark::Counter::kIsRate | benchmark::Counter::kInvert;
  state.counters["time_per_field"] = {static_cast<double>(fields), time_each};
  state.counters["time_per_tube"] = {static_cast<double>(tubes), time_each};
}

/// What a box's recorder costs the tracking thread now and then: the session's state in bytes.
void save_state(benchmark::State& state, const RecordedSession& recording) {
  SessionRun<core::FixedPoint> run;
  if (!run.configure(recording.settings())) {
    state.SkipWithError("the settings are refused");
    return;
  }
  for (const core::Field& field : recording.fields()) {
    run.give(field);
    run.step();
  }
  // Until all that it remembers of fields is filled.
  core::Field missing = recording.fields().back();
  missing.status = core::FieldStatus::kMissing;
  for (int i = 0; i < 300; ++i) {
    missing.mid_exposure += std::chrono::milliseconds(16);
    ++missing.number;
    run.give(missing);
    run.step();
  }
  std::vector<std::byte> bytes(core::session::Session<core::FixedPoint>::state_bytes());
  std::size_t used = 0;
  for (auto iteration : state) {
    used = run.session().save(bytes).value_or(0);
    benchmark::DoNotOptimize(bytes.data());
  }
  state.counters["bytes"] = static_cast<double>(used);
}

template <core::Scalar S>
void add(const char* name, const RecordedSession& recording) {
  benchmark::RegisterBenchmark(name, [&recording](benchmark::State& state) {
    track_recording<S>(state, recording);
  })->Unit(benchmark::kMillisecond);
}

int run(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  const std::string folder =
      count > 1 ? arguments[1] : TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush";
  static RecordedSession recording;
  drivers::Messages messages;
  if (count > 2 || !recording.load(folder, messages)) {
    for (const std::string& message : messages) {
      std::fprintf(stderr, "%s\n", message.c_str());
    }
    std::fprintf(stderr, "usage: step_benchmark [FOLDER] [--benchmark_...]\n");
    return 2;
  }
  add<core::FixedPoint>("recording/fixed", recording);
  add<float>("recording/float", recording);
  add<double>("recording/double", recording);
  benchmark::RegisterBenchmark("save/fixed", [](benchmark::State& state) {
    save_state(state, recording);
  })->Unit(benchmark::kMicrosecond);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace tubesight::tests

int main(int count, char** arguments) { return tubesight::tests::run(count, arguments); }
