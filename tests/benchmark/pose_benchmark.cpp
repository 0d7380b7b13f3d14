// Time of a pose from a still of tests/data/stills, whole and in parts: edges of nine tube-ends to
// pose, the measuring of these edges, everything from a picture with all tube-ends.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/picture/rest_average.h"
#include "core/picture/rim_measurement.h"
#include "core/picture/sheet_view.h"
#include "core/pose/picture_pose.h"
#include "drivers/files/picture_reader.h"
#include "drivers/settings/session_settings.h"

namespace {

using namespace tubesight;
using namespace tubesight::core::pose;

/// The still of tests/data/stills/square_flush, read once.
struct Still {
  drivers::SessionFile file;
  core::tubesheet::SheetMap map;
  PoseModel model;
  drivers::GreyPicture grey;
  std::vector<std::uint16_t> sums;
  core::picture::AveragedPicture picture;
  PictureWorkspace workspace;
  PictureOutcome outcome;
  std::vector<PictureStart> nine;

  Still() {
    const std::string folder = TUBESIGHT_TEST_DATA_DIR "/stills/square_flush/";
    drivers::Messages messages;
    std::string message;
    if (!drivers::load_session_settings(folder + "session.toml", drivers::kPoseNeeds, file,
                                        messages) ||
        !drivers::read_grey_picture(folder + "still-0-0.png", grey, message) ||
        !map.assign(file.settings.tubesheet)) {
      fail();
    }
    const auto made =
        make_pose_model(file.settings.camera, file.settings.tool, file.settings.tubesheet);
    if (!made) {
      fail();
    }
    model = *made;
    sums.resize(grey.pixels.size());
    average();
    // What start9.txt of that folder says.
    nine = {{{7, 41}, 309, 234}, {{6, 42}, 309, 124}, {{7, 42}, 390, 197},
            {{6, 41}, 227, 193}, {{8, 41}, 368, 277}, {{7, 40}, 260, 286},
            {{8, 40}, 313, 318}, {{8, 42}, 433, 247}, {{6, 40}, 183, 239}};
    estimate(true);
  }

  [[noreturn]] static void fail() {
    std::fputs("the still of tests/data/stills/square_flush cannot be used\n", stderr);
    std::exit(1);
  }
  void average() {
    core::picture::RestAverage frames(sums, grey.width_px, grey.height_px);
    if (!frames.add(core::field_of(grey.view(), core::Parity::kEven)) ||
        !frames.add(core::field_of(grey.view(), core::Parity::kOdd))) {
      fail();
    }
    picture = frames.finish().picture;
  }
  void estimate(bool only_nine) {
    PictureOptions options;
    options.only_start = only_nine;
    outcome = estimate_from_picture(picture, model, map, nine, options, workspace);
    if (!outcome.has_value()) {
      fail();
    }
  }
};

Still& still() {
  static const std::unique_ptr<Still> only = std::make_unique<Still>();
  return *only;
}

/// From the edge points of nine tube-ends to the pose.
void edges_to_pose(benchmark::State& state) {
  Still& s = still();
  s.estimate(true);
  for (auto _ : state) {
    benchmark::DoNotOptimize(estimate_pose(s.model, s.workspace.rims, {}, s.workspace.pose));
  }
}
BENCHMARK(edges_to_pose)->Unit(benchmark::kMicrosecond);

/// Measures the edges of nine tube-ends across their rims as `view` predicts them.
void measure_nine(Still& s, const core::picture::SheetView& view) {
  static core::picture::RimOutline outline;
  static core::picture::Rim rim;
  core::picture::RimMeasureOptions options;
  options.edge.search_px = 2.0;
  s.workspace.rims.clear();
  for (const PictureStart& tube : s.nine) {
    rim.address = tube.address;
    if (core::picture::project_rim(view, s.model.center_mm(tube.address), s.model.bore_mm / 2.0,
                                   options.arc_px, outline) &&
        core::picture::measure_rim(s.picture, outline, options, rim) <=
            core::picture::RimFinding::kPartly) {
      static_cast<void>(s.workspace.rims.try_push_back(rim));
    }
  }
}

/// The edges of nine tube-ends across their predicted rims.
void measure_edges(benchmark::State& state) {
  Still& s = still();
  s.estimate(true);
  const core::picture::SheetView view(s.model.camera, s.outcome.pose.estimate.T_camera_sheet);
  for (auto _ : state) {
    measure_nine(s, view);
  }
}
BENCHMARK(measure_edges)->Unit(benchmark::kMicrosecond);

/// Both: the edges of nine tube-ends measured in the picture, and the pose from them.
void measure_and_fit(benchmark::State& state) {
  Still& s = still();
  s.estimate(true);
  const core::picture::SheetView view(s.model.camera, s.outcome.pose.estimate.T_camera_sheet);
  for (auto _ : state) {
    measure_nine(s, view);
    const PoseOutcome pose = estimate_pose(s.model, s.workspace.rims, {}, s.workspace.pose);
    if (!pose.has_value() || pose.estimate.tubes != 9) {
      state.SkipWithError("not the pose of nine tube-ends");
    }
  }
}
BENCHMARK(measure_and_fit)->Unit(benchmark::kMicrosecond);

/// All from the averaged picture: the scan at nine places, five passes, with no other tube-ends.
void picture_to_pose_nine(benchmark::State& state) {
  for (auto _ : state) {
    still().estimate(true);
  }
}
BENCHMARK(picture_to_pose_nine)->Unit(benchmark::kMillisecond);

/// The same with all tube-ends of the picture.
void picture_to_pose_all(benchmark::State& state) {
  for (auto _ : state) {
    still().estimate(false);
  }
}
BENCHMARK(picture_to_pose_all)->Unit(benchmark::kMillisecond);

/// Summing one frame and the check that its fields agree.
void average_a_frame(benchmark::State& state) {
  for (auto _ : state) {
    still().average();
  }
}
BENCHMARK(average_a_frame)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
