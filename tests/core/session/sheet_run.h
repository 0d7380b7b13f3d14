#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/session/session.h"
#include "tests/support/events.h"
#include "tests/support/synthetic_sheet.h"

namespace tubesight::core::session {

using tests::Frame;
using tests::SyntheticSheet;
using tests::ToolPlace;

/// Fields at 60 a second.
inline constexpr std::chrono::nanoseconds kFieldSpan{16'666'667};
inline constexpr double kFieldSpan_s = 16'666'667e-9;

/// Over tube (20, 10), 60 mm below, turned by 2 degrees.
inline constexpr TubeAddress kTube{20, 10};
inline constexpr double kPitch_mm = 25.4;
inline constexpr ToolPlace kOverTube{10 * kPitch_mm + 0.4, 20 * kPitch_mm - 0.3, 60.0, 2.0, 0, 0};

/// The place `x_mm`, `y_mm` farther.
[[nodiscard]] inline ToolPlace moved(ToolPlace place, double x_mm, double y_mm = 0.0) {
  place.x_mm += x_mm;
  place.y_mm += y_mm;
  return place;
}

/// Way after `t` seconds of a move over `way` that speeds up and down by `acceleration`.
[[nodiscard]] inline double way_after(double t, double way, double speed, double acceleration) {
  const double ramp = std::min(speed / acceleration, std::sqrt(way / acceleration));
  const double top = ramp * acceleration;
  const double total = way / top + ramp;
  if (t <= 0.0) {
    return 0.0;
  }
  if (t >= total) {
    return way;
  }
  if (t < ramp) {
    return acceleration * t * t / 2.0;
  }
  if (t > total - ramp) {
    return way - acceleration * (total - t) * (total - t) / 2.0;
  }
  return top * (t - ramp / 2.0);
}

/// A session that looks at a drawn sheet, field by field, with the truth beside it.
template <Scalar S>
class SheetRun {
 public:
  /// `divisor` 2: a camera of half the lines and columns, four times as fast to draw.
  explicit SheetRun(std::int32_t divisor = 2) {
    tests::make_synthetic_settings(*settings, divisor);
    input_.field.lamp_permille = 700;
  }

  std::unique_ptr<SessionSettings> settings = std::make_unique<SessionSettings>();
  std::unique_ptr<SyntheticSheet> sheet;  ///< after configure()
  FieldTime now{1'000'000'000};
  std::int64_t sequence = 100;
  std::int64_t number = 40;  ///< of the last field
  FieldStatus status = FieldStatus::kGood;

  void configure() {
    sheet = std::make_unique<SyntheticSheet>(*settings);
    ASSERT_TRUE(session_->configure(*settings).has_value());
  }

  void take_lamp(const lighting::LampPolicy& policy) { session_->take_lamp(policy); }
  void lamp_dimmed(bool dimmed) { input_.lamp_dimmed = dimmed; }
  void add(const Event& event) { ASSERT_TRUE(input_.events.try_push_back(event)); }

  /// Clicks on tubes as they stand at `place`, a few pixels off.
  void add_start(const ToolPlace& place, const std::vector<TubeAddress>& tubes) {
    SessionSettings& s = *settings;
    tests::set_clicks(*sheet, place, tubes, {3.0, -2.0}, s);
    add(tests::event_of(Start{s.start.tubes, {}, false}));
  }
  void add_claim(TubeAddress tube) { add(tests::event_of(Claim{tube})); }
  void add_pick(const std::array<double, 2>& at_px) { add(tests::event_of(Pick{at_px, {}})); }

  /// The next field, drawn at `place`; every wrong answer is a failure.
  const Output& step(const ToolPlace& place) {
    draw(place);
    return step_on_last_picture(place);
  }
  /// The next field in time with the picture as it is.
  const Output& step_on_last_picture(const ToolPlace& truth) {
    input_.field.pixels = sheet->view(frame_, parity());
    input_.field.parity = parity();
    input_.field.status = status;
    input_.field.sequence = sequence;
    input_.field.mid_exposure = now;
    input_.field.number = ++number;
    session_->step(input_, output_);
    input_.events.clear();
    status = FieldStatus::kGood;
    check(truth);
    ++sequence;
    now += kFieldSpan;
    return output_;
  }
  /// The next field, drawn at `place`, but for a share of its columns from the left, which are
  /// those of the picture before.
  const Output& step_on_held_picture(const ToolPlace& place, double share) {
    const Frame before = frame_;
    draw(place);
    const std::int32_t width = settings->camera.width_px;
    const auto held = static_cast<std::int32_t>(share * width);
    for (std::int32_t line = 0; line < settings->camera.height_px; ++line) {
      std::copy_n(before.begin() + line * width, held, frame_.begin() + line * width);
    }
    return step_on_last_picture(place);
  }
  void draw(const ToolPlace& place) {
    sheet->draw(place, parity(), static_cast<std::uint32_t>(sequence), frame_);
  }
  /// No field came in time; the next one may be `late` and belong before this moment.
  const Output& miss(const ToolPlace& truth, bool late = false) {
    status = FieldStatus::kMissing;
    const auto sequence_before = sequence;
    const auto now_before = now;
    sequence = 0;  // has none
    now += kFieldSpan / 2;
    step_on_last_picture(truth);
    sequence = late ? sequence_before : sequence_before + 1;
    now = late ? now_before : now_before + kFieldSpan;
    return output_;
  }
  /// Fields that never arrive.
  void drop(int fields) {
    sequence += fields;
    now += fields * kFieldSpan;
  }

  /// Three tubes in the middle of the picture, one neighbour along each step.
  [[nodiscard]] std::vector<TubeAddress> middle_tubes(const ToolPlace& place) const {
    const auto& camera = settings->camera;
    const double u = camera.width_px / 2.0;
    const double v = camera.height_px * 0.4;
    const auto shown = sheet->sheet_point(place, {u, v});
    EXPECT_TRUE(shown.has_value());
    const TubeAddress seen = sheet->nearest(shown.value_or(std::array<double, 2>{}));
    const auto nearer = [&](TubeAddress a, TubeAddress b) {
      const auto at_a = sheet->image_of(place, a);
      const auto at_b = sheet->image_of(place, b);
      const double off_a = std::hypot(at_a[0] - u, at_a[1] - v);
      return off_a < std::hypot(at_b[0] - u, at_b[1] - v) ? a : b;
    };
    return {seen, nearer({seen.row + 1, seen.column}, {seen.row - 1, seen.column}),
            nearer({seen.row, seen.column + 1}, {seen.row, seen.column - 1})};
  }

  /// Starts over `place` and steps a few fields at rest; fails unless it tracks.
  void begin(const ToolPlace& place = kOverTube) {
    const auto axis = sheet->axis_point(place);
    const TubeAddress under = sheet->nearest(axis);
    add_start(place, {under, {under.row + 1, under.column}, {under.row, under.column + 1}});
    for (int i = 0; i < 4; ++i) {
      step(place);
      ASSERT_EQ(sighting().state, TrackState::kTracking) << "field " << i << " after the start";
    }
  }

  [[nodiscard]] const Output& output() const { return output_; }
  [[nodiscard]] const Sighting& sighting() const { return output_.sighting; }
  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] const Session<S>& session() const { return *session_; }
  [[nodiscard]] double offset_mm() const { return sighting().offset_um_q8 / 256000.0; }
  [[nodiscard]] double height_mm() const { return sighting().height_um_q8 / 256000.0; }

  /// True distance of the guidetube's axis from a tube.
  [[nodiscard]] double true_offset_mm(const ToolPlace& place, TubeAddress tube) const {
    const auto axis = sheet->axis_point(place);
    const auto center = sheet->center_of(tube);
    return std::hypot(axis[0] - center[0], axis[1] - center[1]);
  }

 private:
  [[nodiscard]] Parity parity() const { return sequence % 2 == 0 ? Parity::kEven : Parity::kOdd; }

  // What may never be wrong, whatever the state. A named tube must be the nearest one, but for the
  // width of a hair at the rounding limit.
  void check(const ToolPlace& place) const {
    const Sighting& s = sighting();
    const TubeAddress nearest = sheet->nearest(sheet->axis_point(place));
    if (s.aligned) {
      EXPECT_TRUE(s.tool_known);
      EXPECT_EQ(s.tool, nearest) << "aligned under a wrong tube in field " << sequence;
      EXPECT_LT(true_offset_mm(place, s.tool), settings->verification.aligned_within_mm + 0.5)
          << "aligned, but not under the tube in field " << sequence;
      EXPECT_EQ(s.state == TrackState::kTracking || s.state == TrackState::kDegraded, true);
    }
    if (s.tool_known && s.state == TrackState::kTracking) {
      EXPECT_LT(true_offset_mm(place, s.tool), true_offset_mm(place, nearest) + 0.5)
          << "a wrong tube named in field " << sequence;
    }
    if (s.state == TrackState::kLost || s.state == TrackState::kWaiting) {
      EXPECT_FALSE(s.tool_known);
      EXPECT_FALSE(s.aligned);
      EXPECT_FALSE(s.primary_known);
      EXPECT_EQ(s.tracked, 0);
      EXPECT_NE(s.reason, Reason::kNone);
    }
  }

  std::unique_ptr<Session<S>> session_ = std::make_unique<Session<S>>();
  Input input_;
  Output output_;
  Frame frame_;
};

}  // namespace tubesight::core::session
