#include "board/visionbox/golden_recording.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/fnv1a.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/base/trigonometry.h"
#include "core/session/session.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

constexpr std::int32_t kWidth_px = 317;
constexpr std::int32_t kHeight_px = 240;
constexpr double kPitch_mm = 25.4;
constexpr double kBore_mm = 18.6;
/// From the camera to the tubes, and between camera and tool.
constexpr double kTipBelow_mm = 60.0;
constexpr std::array<double, 3> kTip_mm{-3.0, 31.5, 112.5};
constexpr double kTurn_deg = 48.0;

constexpr std::int64_t kFields = 32;
constexpr std::int64_t kFirstMove = 4;
constexpr std::int64_t kLastMove = 29;
constexpr double kMove_mm = 0.98125;  // a field: 59 mm/s; 25.5125 mm in all
constexpr core::TubeAddress kFrom{20, 10};
constexpr core::TubeAddress kTo{20, 11};
constexpr std::array<double, 2> kOff_mm{0.4, -0.3};  // of the place under kFrom
constexpr std::chrono::nanoseconds kSpan{16'683'333};

void make_settings(core::SessionSettings& settings) {
  auto& camera = settings.camera;
  camera.width_px = kWidth_px;
  camera.height_px = kHeight_px;
  camera.scan = core::Scan::kEvenFirst;
  camera.focal_length_mm = 5.06;
  camera.cell_width_mm = 0.0168;
  camera.cell_height_mm = 0.0196;
  camera.sensor_columns = 768;
  camera.frame_columns = 635;
  camera.horizontal_scale = 1.021;
  camera.center_px = {162.15, 116.9};
  camera.distortion_per_mm2 = 0.0092;
  settings.tool.position_mm = kTip_mm;
  settings.tool.rotation_deg = {kTurn_deg, 0.0, 0.0};
  auto& sheet = settings.tubesheet;
  sheet.row_step_mm = {0.0, kPitch_mm};
  sheet.column_step_mm = {kPitch_mm, 0.0};
  sheet.bore_mm = kBore_mm;
  sheet.rows = {0, 60};
  sheet.columns = {0, 60};
  settings.start.window_px = {20, 18, 297, 222};
  settings.start.optimum_px = {159.0, 110.0};
}

/// The camera above the guidetube's tip, looking straight at the sheet.
class View {
 public:
  View(const core::CameraSettings& camera, double x_mm, double y_mm)
      : camera_(&camera),
        cell_mm_(camera.cell_width_mm / camera.horizontal_scale * camera.sensor_columns /
                 camera.frame_columns),
        turn_(core::sine_cosine(core::radians(-kTurn_deg))),
        reach_mm_(kTipBelow_mm + kTip_mm[2]),
        eye_mm_{x_mm - turned_x(kTip_mm[0], kTip_mm[1]), y_mm - turned_y(kTip_mm[0], kTip_mm[1])} {}

  /// The point of the sheet that a pixel shows.
  [[nodiscard]] std::array<double, 2> point(double u, double v) const {
    const double x = cell_mm_ * (u - camera_->center_px[0]);
    const double y = camera_->cell_height_mm * (v - camera_->center_px[1]);
    const double factor = 1.0 + (x * x + y * y) * camera_->distortion_per_mm2;
    const double scale = factor * reach_mm_ / camera_->focal_length_mm;
    return {eye_mm_[0] + turned_x(x, y) * scale, eye_mm_[1] + turned_y(x, y) * scale};
  }

  /// The pixel that shows a point: by steps to where point() gives it.
  [[nodiscard]] std::array<double, 2> pixel(const std::array<double, 2>& wanted) const {
    std::array<double, 2> at = camera_->center_px;
    const double mm_per_px = cell_mm_ * reach_mm_ / camera_->focal_length_mm;
    for (int i = 0; i < 60; ++i) {
      const auto seen = point(at[0], at[1]);
      const double x = wanted[0] - seen[0];
      const double y = wanted[1] - seen[1];
      at[0] += (x * turn_.cosine + y * turn_.sine) / mm_per_px / 2.0;
      at[1] += (y * turn_.cosine - x * turn_.sine) / mm_per_px / 2.0;
    }
    return at;
  }

 private:
  [[nodiscard]] double turned_x(double x, double y) const {
    return turn_.cosine * x - turn_.sine * y;
  }
  [[nodiscard]] double turned_y(double x, double y) const {
    return turn_.sine * x + turn_.cosine * y;
  }

  const core::CameraSettings* camera_;
  double cell_mm_;
  core::SineCosine turn_;
  double reach_mm_;
  std::array<double, 2> eye_mm_;
};

/// Dark bores in bright plate; an edge rises over 2.4 mm of the sheet.
std::uint8_t grey_at(const std::array<double, 2>& point_mm) {
  constexpr double kDark = 12.0;
  constexpr double kPlate = 140.0;
  constexpr double kEdge_mm = 1.2;
  // Nothing in view is below 0, where a whole number is cut off otherwise.
  const auto from_nearest = [](double mm) {
    return mm - kPitch_mm * static_cast<double>(static_cast<std::int32_t>(mm / kPitch_mm + 0.5));
  };
  const double x = from_nearest(point_mm[0]);
  const double y = from_nearest(point_mm[1]);
  constexpr double kInside_mm = kBore_mm / 2.0 - kEdge_mm;
  constexpr double kOutside_mm = kBore_mm / 2.0 + kEdge_mm;
  const double squared = x * x + y * y;
  if (squared <= kInside_mm * kInside_mm || squared >= kOutside_mm * kOutside_mm) {
    return static_cast<std::uint8_t>(squared <= kInside_mm * kInside_mm ? kDark : kPlate);
  }
  const double s = (std::sqrt(squared) - kInside_mm) / (kOutside_mm - kInside_mm);
  return static_cast<std::uint8_t>(kDark + (kPlate - kDark) * s * s * (3.0 - 2.0 * s) + 0.5);
}

void add(core::Fnv1a& digest, const core::Sighting& s) {
  for (const std::int64_t number : {static_cast<std::int64_t>(s.state),
                                    static_cast<std::int64_t>(s.reason),
                                    std::int64_t{s.judged},
                                    std::int64_t{s.tracked},
                                    std::int64_t{s.primary.row},
                                    std::int64_t{s.primary.column},
                                    std::int64_t{s.primary_px.u_q16},
                                    std::int64_t{s.primary_px.v_q16},
                                    std::int64_t{s.axis_px.u_q16},
                                    std::int64_t{s.axis_px.v_q16},
                                    std::int64_t{s.height_um_q8},
                                    std::int64_t{s.tool_known},
                                    std::int64_t{s.tool.row},
                                    std::int64_t{s.tool.column},
                                    std::int64_t{s.offset_um_q8},
                                    std::int64_t{s.displacement_um_q8[0]},
                                    std::int64_t{s.displacement_um_q8[1]},
                                    std::int64_t{s.aligned},
                                    std::int64_t{s.velocity_um_s[0]},
                                    std::int64_t{s.velocity_um_s[1]},
                                    std::int64_t{s.margin_permyriad},
                                    std::int64_t{s.residual_px_q16}}) {
    digest.add(number);
  }
}

/// Draws and tracks, field by field.
class GoldenRun {
 public:
  GoldenRun() : settings_(std::make_unique<core::SessionSettings>()) {
    make_settings(*settings_);
    configured_ = static_cast<bool>(session_->configure(*settings_));
  }

  /// Of all fields; false: they cannot be tracked at all.
  [[nodiscard]] bool play() {
    for (std::int64_t field = 0; configured_ && field < kFields; ++field) {
      step(field);
    }
    return configured_;
  }

  /// What the last field must say whatever the digests are: known beforehand, not computed here.
  [[nodiscard]] bool arrived() const {
    constexpr std::int32_t kOffset_um_q8 = 594 * 256;  // of (0.5125, -0.3) mm
    constexpr std::int32_t kWithin_um_q8 = 200 * 256;
    const core::Sighting& last = output_->sighting;
    return last.state == core::TrackState::kTracking && last.judged && last.tool_known &&
           last.tool == kTo && last.aligned &&
           std::abs(last.offset_um_q8 - kOffset_um_q8) < kWithin_um_q8;
  }

  [[nodiscard]] GoldenDigests digests() const { return {pictures_.value(), sightings_.value()}; }

 private:
  void step(std::int64_t field) {
    const std::int64_t moves =
        std::clamp<std::int64_t>(field - kFirstMove, 0, kLastMove - kFirstMove + 1);
    const View view(settings_->camera,
                    kPitch_mm * kFrom.column + kOff_mm[0] + kMove_mm * static_cast<double>(moves),
                    kPitch_mm * kFrom.row + kOff_mm[1]);
    const auto parity = core::parity_of(settings_->camera.scan, field % 2 == 1);
    draw(view, parity == core::Parity::kOdd ? 1 : 0);
    input_->events.clear();
    if (field == 0) {
      static_cast<void>(input_->events.try_push_back(clicks(view)));
    }
    input_->field.pixels =
        core::field_of({frame_.data(), kWidth_px, kHeight_px, kWidth_px}, parity);
    input_->field.parity = parity;
    input_->field.sequence = field;
    input_->field.number = field;
    input_->field.mid_exposure = std::chrono::seconds(1) + field * kSpan;
    session_->step(*input_, *output_);
    add(sightings_, output_->sighting);
  }

  void draw(const View& view, std::int32_t first_line) {
    for (std::int32_t v = first_line; v < kHeight_px; v += 2) {
      for (std::int32_t u = 0; u < kWidth_px; ++u) {
        frame_[static_cast<std::size_t>(v * kWidth_px + u)] = grey_at(view.point(u, v));
      }
      pictures_.add({&frame_[static_cast<std::size_t>(v * kWidth_px)], kWidth_px});
    }
  }

  [[nodiscard]] static core::Event clicks(const View& view) {
    core::Start start;
    for (const core::TubeAddress tube : {kFrom, core::TubeAddress{kFrom.row + 1, kFrom.column},
                                         core::TubeAddress{kFrom.row, kFrom.column + 1}}) {
      static_cast<void>(start.tubes.try_push_back(
          {tube, view.pixel({kPitch_mm * tube.column, kPitch_mm * tube.row})}));
    }
    core::Event event;
    event.content = start;
    return event;
  }

  std::unique_ptr<core::SessionSettings> settings_;
  std::unique_ptr<core::session::Session<core::FixedPoint>> session_ =
      std::make_unique<core::session::Session<core::FixedPoint>>();
  std::unique_ptr<core::session::Input> input_ = std::make_unique<core::session::Input>();
  std::unique_ptr<core::session::Output> output_ = std::make_unique<core::session::Output>();
  std::vector<std::uint8_t> frame_ =
      std::vector<std::uint8_t>(static_cast<std::size_t>(kWidth_px) * kHeight_px);
  core::Fnv1a pictures_;
  core::Fnv1a sightings_;
  bool configured_ = false;
};

std::string hexadecimal(std::uint64_t value) {
  std::string text;
  drivers::print(text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace

const GoldenDigests kGolden{0x055a4ed15799315c, 0xad497650ccdabdcd};

GoldenResult run_golden_recording(const GoldenDigests& expected) {
  GoldenRun run;
  if (!run.play()) {
    return {true, false, "the golden recording's settings are refused"};
  }
  const GoldenDigests found = run.digests();
  if (found.pictures != expected.pictures) {
    return {true, false,
            "the golden recording is drawn otherwise than it must be: " +
                hexadecimal(found.pictures) + ", expected " + hexadecimal(expected.pictures)};
  }
  if (found.sightings != expected.sightings || !run.arrived()) {
    return {true, false,
            "the golden recording is judged otherwise than it must be: " +
                hexadecimal(found.sightings) + ", expected " + hexadecimal(expected.sightings)};
  }
  return {true, true,
          "the golden recording is judged as on every machine, " + hexadecimal(found.sightings)};
}

}  // namespace tubesight::board
