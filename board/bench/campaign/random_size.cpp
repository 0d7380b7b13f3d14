#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "board/bench/campaign/random_parts.h"

namespace tubesight::board::campaign {
namespace {

using core::CameraSettings;
using core::Scan;
using drivers::FaultKind;
using drivers::Scenario;

struct Size {
  std::int32_t width_px;
  std::int32_t height_px;
  bool interlaced;  ///< there are cameras of this size that are
};

constexpr std::array<Size, 10> kSizes = {{{320, 240, true},
                                          {640, 480, true},
                                          {720, 576, true},
                                          {768, 576, true},
                                          {1024, 768, false},
                                          {1280, 720, false},
                                          {1280, 1024, false},
                                          {1440, 1080, false},
                                          {1920, 1080, true},
                                          {1920, 1200, false}}};
constexpr std::array<std::int32_t, 3> kInterlacedRates_hz = {25, 30, 60};
constexpr std::array<std::int32_t, 4> kProgressiveRates_hz = {50, 60, 90, 120};

template <typename T, std::size_t N>
T one_of(RandomSource& random, const std::array<T, N>& of) {
  return of.at(static_cast<std::size_t>(random.whole(0, static_cast<std::int32_t>(N) - 1)));
}

/// From a picture's columns or lines to another number of them: pixels are places of their middles.
struct Axis {
  double from;
  double to;

  [[nodiscard]] double place(double px) const { return (px + 0.5) * to / from - 0.5; }
  [[nodiscard]] std::int32_t whole_place(std::int32_t px) const {
    const auto there = static_cast<std::int32_t>(std::lround(place(px)));
    return std::clamp(there, 0, static_cast<std::int32_t>(to) - 1);
  }
};

/// The same lens before the same sensor, read out in other columns and lines.
void read_out(CameraSettings& camera, const Axis& columns, const Axis& lines, Scan scan) {
  camera.width_px = static_cast<std::int32_t>(columns.to);
  camera.height_px = static_cast<std::int32_t>(lines.to);
  camera.cell_width_mm *= columns.from / columns.to;
  camera.cell_height_mm *= lines.from / lines.to;
  camera.center_px = {columns.place(camera.center_px[0]), lines.place(camera.center_px[1])};
  camera.scan = scan;
}

}  // namespace

void draw_size(RandomSource& random, Scenario& scenario) {
  const Size size = one_of(random, kSizes);
  Scan scan = random.chance(0.5) ? Scan::kEvenFirst : Scan::kOddFirst;
  const bool whole = !size.interlaced || random.chance(0.5);
  const std::int32_t interlaced_hz = one_of(random, kInterlacedRates_hz);
  const std::int32_t progressive_hz = one_of(random, kProgressiveRates_hz);
  if (whole) {
    scan = Scan::kProgressive;
  }
  scenario.video.rate_numerator = whole ? progressive_hz : interlaced_hz;
  const CameraSettings& before = scenario.scene.camera;
  const Axis columns{static_cast<double>(before.width_px), static_cast<double>(size.width_px)};
  const Axis lines{static_cast<double>(before.height_px), static_cast<double>(size.height_px)};
  core::StartSettings& start = scenario.told.start;
  auto& [left, top, right, bottom] = start.window_px;
  left = columns.whole_place(left);
  right = columns.whole_place(right);
  top = lines.whole_place(top);
  bottom = lines.whole_place(bottom);
  start.optimum_px = {columns.place(start.optimum_px[0]), lines.place(start.optimum_px[1])};
  read_out(scenario.scene.camera, columns, lines, scan);
  read_out(scenario.told.camera, columns, lines, scan);
}

void leave_out_faults_of_fields(Scenario& scenario) {
  if (scenario.scene.camera.scan == Scan::kProgressive) {
    std::erase_if(scenario.faults,
                  [](const drivers::Fault& fault) { return fault.kind == FaultKind::kSwapped; });
  }
}

double field_s(const Scenario& scenario) {
  const double fields_a_frame = scenario.scene.camera.scan == Scan::kProgressive ? 1.0 : 2.0;
  return static_cast<double>(scenario.video.rate_denominator) /
         (fields_a_frame * static_cast<double>(scenario.video.rate_numerator));
}

}  // namespace tubesight::board::campaign
