#include "drivers/simulated/simulated_world.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Core>

#include "core/tubesheet/sheet_places.h"
#include "drivers/simulated/dice.h"
#include "drivers/simulated/spoilt_picture.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Parity;
using core::Result;
using core::Unexpected;

/// Shorter exposures are pictures of an instant; for the speed some time must pass.
constexpr double kShortest_s = 1e-4;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

core::PixelBox window_of(const Scenario& scenario) {
  const std::int32_t margin = scenario.video.window_margin_px;
  const auto& [left, top, right, bottom] = scenario.told.start.window_px;
  const std::int32_t last_u = scenario.scene.camera.width_px - 1;
  const std::int32_t last_v = scenario.scene.camera.height_px - 1;
  if (margin < 0) {
    return {0, 0, last_u, last_v};
  }
  return {std::max(left - margin, 0), std::max(top - margin, 0), std::min(right + margin, last_u),
          std::min(bottom + margin, last_v)};
}

}  // namespace

Result<void> SimulatedWorld::configure(const Scenario& scenario) {
  const SimulatedVideo& video = scenario.video;
  interlaced_ = scenario.scene.camera.scan != core::Scan::kProgressive;
  const std::int64_t fields_a_frame = interlaced_ ? 2 : 1;
  if (video.rate_numerator <= 0 || video.rate_denominator <= 0 || video.exposure_s < 0.0 ||
      video.exposure_s * static_cast<double>(video.rate_numerator * fields_a_frame) >
          static_cast<double>(video.rate_denominator)) {
    return Unexpected(Error::kInvalidArgument);
  }
  TUBESIGHT_TRY(renderer_.configure(scenario.scene));
  TUBESIGHT_TRY(truth_.configure(scenario.scene));
  TUBESIGHT_TRY(path_.begin(scenario.from));
  for (const core::kinematics::PathSegment& segment : scenario.path) {
    TUBESIGHT_TRY(path_.add(segment));
  }
  TUBESIGHT_TRY(make_robot(scenario));
  scenario_ = &scenario;
  const auto pixels = static_cast<std::size_t>(scenario.scene.camera.width_px) *
                      static_cast<std::size_t>(scenario.scene.camera.height_px);
  frame_.assign(pixels, 0);
  kept_.assign(pixels, 0);
  window_ = window_of(scenario);
  const double length_s = video.length_s > 0.0 ? video.length_s : path_.duration_s();
  const double frames = std::ceil(length_s * static_cast<double>(video.rate_numerator) /
                                      static_cast<double>(video.rate_denominator) -
                                  1e-6);
  slots_ = fields_a_frame * std::max<std::int64_t>(1, std::llround(frames));
  slot_ = unnumbered_ = 0;
  jump_ = told_ = skip_ = {};
  skipped_s_ = 0.0;
  gap_ = false;
  events_taken_ = 0;
  started_ = false;
  another_picture_.begin();
  video_source_.begin(pixels);
  lamp_permille_ = scenario.light.lamp_permille;
  shine_ = lamp_permille_ / 1000.0;
  return {};
}

Result<void> SimulatedWorld::make_robot(const Scenario& scenario) {
  const bool steered = motion_ != nullptr && motion_ != robot_.get();
  if (!steered) {
    motion_ = nullptr;
  }
  robot_.reset();
  if (!scenario.robot) {
    return {};
  }
  robot_ = std::make_unique<SimulatedRobot>();
  SimulatedRobotSettings settings = *scenario.robot;
  settings.home = scenario.from;
  TUBESIGHT_TRY(robot_->configure(settings, scenario.told.tubesheet));
  for (const core::kinematics::PathSegment& segment : scenario.path) {
    TUBESIGHT_TRY(robot_->add(segment));
  }
  if (!steered) {
    motion_ = robot_.get();
  }
  return {};
}

core::FieldTime SimulatedWorld::slot_time(std::int64_t slot) const {
  // slot * period, rounded half up to the nanosecond: whole seconds apart, so that nothing
  // overflows.
  const std::int64_t rate = scenario_->video.rate_numerator * (interlaced_ ? 2 : 1);
  const std::int64_t ticks = slot * scenario_->video.rate_denominator;
  const std::int64_t whole = ticks / rate;
  const std::int64_t rest = ticks % rate;
  return core::FieldTime(whole * kSecond_ns + (2 * rest * kSecond_ns + rate) / (2 * rate));
}

FieldSlot SimulatedWorld::slot_at(std::int64_t slot) const {
  const std::int64_t first = interlaced_ ? slot - slot % 2 : slot;
  const std::int64_t fields_a_frame = interlaced_ ? 2 : 1;
  return {seconds_of(slot_time(slot)), seconds_of(slot_time(first)), seconds_of(slot_time(1)),
          seconds_of(slot_time(slot - 1)), seconds_of(slot_time(first - fields_a_frame))};
}

Parity SimulatedWorld::parity_of(std::int64_t slot) const {
  return core::parity_of(scenario_->scene.camera.scan, slot % 2 != 0);
}

SimulatedWorld::SheetTool SimulatedWorld::pose_at(double time_s, const FieldFaults& faults) {
  const double path_s = time_s + faults.skipped_s;
  const SheetTool pose =
      motion_ != nullptr ? motion_->pose_at(path_s) : path_.state_at(path_s).T_sheet_tool;
  const auto jump_mm =
      core::tubesheet::move_mm(scenario_->scene.sheet, {faults.jump[0], faults.jump[1]});
  const core::Transform<core::frames::Sheet, core::frames::Sheet> jump(
      Eigen::Matrix3d::Identity(), Eigen::Vector3d(jump_mm[0], jump_mm[1], 0.0));
  return jump * pose * faults.off * shake_at(scenario_->faults, time_s);
}

FieldPixels SimulatedWorld::pixels_of(Parity parity) {
  const core::FieldView view = core::field_of(frame(), parity);
  return {frame_.data() + (view.pixels - frame_.data()), view.width_px, view.lines, view.stride_px};
}

core::ImageView SimulatedWorld::frame() const {
  const core::CameraSettings& camera = scenario_->scene.camera;
  return {frame_.data(), camera.width_px, camera.height_px, camera.width_px};
}

namespace {

/// A scenario's event with the instant at which it happens, and its place in the scenario as its
/// id.
core::Event told(const ScenarioEvent& scripted, std::size_t place) {
  core::Event event = scripted.event;
  if (!event.at) {
    event.at = instant_of(scripted.at_s);
  }
  if (event.id == 0) {
    event.id = static_cast<std::int64_t>(place) + 1;
  }
  return event;
}

}  // namespace

void SimulatedWorld::take_events(double time_s, core::EventList& events) {
  const core::StartSettings& start = scenario_->told.start;
  if (!started_ && !start.tubes.empty()) {
    core::Event event;
    event.origin = core::EventOrigin::kOperator;
    event.content = core::Start{start.tubes, {}, false};
    static_cast<void>(events.try_push_back(event));  // the first of all
  }
  started_ = true;
  const auto& all = scenario_->events;
  // What does not fit is handed over before the next field.
  while (events_taken_ < all.size() && all[events_taken_].at_s <= time_s + 1e-9 &&
         events.try_push_back(told(all[events_taken_], events_taken_))) {
    ++events_taken_;
  }
  while (robot_ != nullptr && motion_ == robot_.get() && !events.full()) {
    const auto message = robot_->take_message();
    if (!message) {
      break;
    }
    static_cast<void>(events.try_push_back(*message));  // there is room
  }
}

bool SimulatedWorld::next(SimulatedField& out) {
  while (next_slot(out)) {
    if (!out.lost) {
      return true;
    }
  }
  return false;
}

bool SimulatedWorld::next_slot(SimulatedField& out) {
  if (slot_ >= slots_) {
    return false;
  }
  const FieldSlot slot = slot_at(slot_);
  out.faults = faults_at(slot_);
  out.slot = slot_;
  out.lost = out.faults.lost;
  out.events.clear();
  out.field.parity = parity_of(slot_);
  out.field.status =
      out.lost || out.faults.damaged ? core::FieldStatus::kDamaged : core::FieldStatus::kGood;
  out.field.sequence = slot_ - unnumbered_;
  out.field.mid_exposure = stamp(out.faults);
  out.field.number = interlaced_ ? slot_ : 2 * slot_;
  out.field.lamp_permille = lamp_permille_;
  if (!out.lost) {
    take_events(slot.time_s, out.events);
  }
  warm_lamp();
  Shutter shutter;
  out.truth = look(slot_, out.faults, shutter);
  follow_slip(out);
  if (!out.lost) {
    expose(shutter, out);
  }
  out.field.pixels = core::field_of(frame(), out.field.parity);
  if (out.lost && out.faults.unnumbered) {
    ++unnumbered_;
  }
  follow_lamp_commands(out.events);
  ++slot_;
  return true;
}

FieldFaults SimulatedWorld::faults_at(std::int64_t slot) const {
  return faults_of(scenario_->faults, slot_at(slot));
}

std::int64_t SimulatedWorld::last_delivered() const {
  std::int64_t slot = slots_ - 1;
  while (slot >= 0 && faults_at(slot).lost) {
    --slot;
  }
  return slot;
}

bool SimulatedWorld::hits(const Fault& fault) const {
  // The first field or frame from its beginning on has it, or none: found from a little before.
  constexpr std::int64_t kBefore = 3;
  constexpr std::int64_t kAfter = 5;
  const auto about = static_cast<std::int64_t>(
      std::min(fault.at_s / seconds_of(slot_time(1)), static_cast<double>(slots_)));
  const std::int64_t to = std::min(slots_, about + kAfter);
  for (std::int64_t slot = std::max<std::int64_t>(0, about - kBefore); slot < to; ++slot) {
    if (faults_of({&fault, 1}, slot_at(slot)).has(fault.kind)) {
      return true;
    }
  }
  return false;
}

FieldTruth SimulatedWorld::truth_of(std::int64_t slot) {
  Shutter ignored;
  return look(slot, faults_at(slot), ignored);
}

/// The tool while the shutter is open, and what is true in the middle.
FieldTruth SimulatedWorld::look(std::int64_t number, const FieldFaults& faults, Shutter& shutter) {
  const FieldSlot slot = slot_at(number);
  double middle_s = slot.time_s;
  if (faults.swapped && interlaced_) {
    middle_s = number % 2 == 0 ? slot.time_s + slot.period_s : slot.frame_time_s;
  }
  const double open_s = scenario_->video.exposure_s;
  const double span_s = std::max(open_s, kShortest_s);
  FieldTruth truth;
  shutter.opened_s = middle_s - span_s / 2.0;
  shutter.closed_s = middle_s + span_s / 2.0;
  shutter.opened = pose_at(shutter.opened_s, faults);
  truth.T_sheet_tool = pose_at(middle_s, faults);
  shutter.closed = pose_at(shutter.closed_s, faults);
  truth.speed_mm_s =
      (shutter.closed.translation_mm() - shutter.opened.translation_mm()).norm() / span_s;
  if (open_s < kShortest_s) {
    shutter.opened = shutter.closed = truth.T_sheet_tool;
  }
  truth.T_camera_sheet = truth_.T_camera_sheet(truth.T_sheet_tool, faults.knock);
  const auto axis = truth_.axis(truth.T_sheet_tool);
  truth.axis_known = axis.has_value();
  truth.axis = axis.value_or(core::rendering::AxisTruth{});
  return truth;
}

/// When the next slot is said to have been exposed. It wavers by less than half a field: stamps
/// grow.
core::FieldTime SimulatedWorld::stamp(const FieldFaults& faults) const {
  const core::FieldTime time = slot_time(slot_);
  if (faults.waver_s <= 0.0) {
    return time;
  }
  const double most_ns = std::min(
      faults.waver_s * 1e9, 0.45 * static_cast<double>((slot_time(1) - slot_time(0)).count()));
  Dice dice(derived_seed(scenario_->seed ^ 0x517C'C1B7U, static_cast<std::uint64_t>(slot_)));
  return time + core::FieldTime(std::llround(dice.between(-most_ns, most_ns)));
}

void SimulatedWorld::expose(const Shutter& shutter, const SimulatedField& out) {
  const double duty = shine_;
  const double pwm_hz = scenario_->light.pwm_hz;
  const double light = pwm_hz > 0.0 ? core::rendering::pulsed_light(
                                          duty, 1.0 / pwm_hz, shutter.opened_s, shutter.closed_s)
                                    : duty;
  core::rendering::Exposure exposure;
  exposure.opened = shutter.opened;
  exposure.closed = shutter.closed;
  exposure.lamp = light * out.faults.lamp;
  exposure.dead_lamps = out.faults.dead_lamps;
  exposure.ring = scenario_->light.ring;
  exposure.knock = out.faults.knock;
  exposure.parity = out.field.parity;
  exposure.noise_seed = derived_seed(scenario_->seed, static_cast<std::uint64_t>(out.slot));
  exposure.window = window_;
  // A slow lamp swings more, as a box's own does (core/lighting).
  const AnotherLamp another{following_share(), scenario_->light.lag_s > 0.1 ? 0.02 : 0.01};
  another_picture_.show(out.field, out.faults, scenario_->scene.sheet, another, scenario_->seed,
                        exposure);
  draw(exposure, out.faults);
}

void SimulatedWorld::draw(const core::rendering::Exposure& exposure, const FieldFaults& faults) {
  if (faults.repeated) {
    return;
  }
  const FieldPixels field = pixels_of(exposure.parity);
  Dice dice(derived_seed(exposure.noise_seed, 1));
  if (faults.filled) {
    fill(field, *faults.filled);
    return;
  }
  if (faults.snow) {
    snow(field, dice);
    return;
  }
  video_source_.remember(field, exposure.parity, faults);
  const auto width = static_cast<std::size_t>(field.width_px);
  const std::int32_t kept_from =
      faults.torn_after ? static_cast<std::int32_t>(std::lround(*faults.torn_after * field.lines))
                        : field.lines;
  for (std::int32_t line = kept_from; line < field.lines; ++line) {
    std::copy_n(field.line(line), width, kept_.data() + static_cast<std::size_t>(line) * width);
  }
  const core::CameraSettings& camera = scenario_->scene.camera;
  renderer_.render(exposure, {frame_.data(), camera.width_px, camera.height_px, camera.width_px});
  spoil(field, faults, derived_seed(exposure.noise_seed, 2));
  if (faults.emi_share > 0.0) {
    disturb_lines(field, faults.emi_share, faults.emi_amplitude, dice);
  }
  if (faults.salt_pepper_share > 0.0) {
    salt_and_pepper(field, faults.salt_pepper_share, dice);
  }
  for (std::int32_t line = kept_from; line < field.lines; ++line) {
    std::copy_n(kept_.data() + static_cast<std::size_t>(line) * width, width, field.line(line));
  }
  video_source_.pass(field, exposure.parity, faults, dice);
}

/// A lag of the first order over one field.
void SimulatedWorld::warm_lamp() {
  const double level = lamp_permille_ / 1000.0;
  const double lag_s = scenario_->light.lag_s;
  shine_ = lag_s > 0.0 ? shine_ + (level - shine_) * following_share() : level;
}

/// Of the way to a new level that a lamp goes in one field.
double SimulatedWorld::following_share() const {
  const double period_s = seconds_of(slot_time(1));
  return period_s / (period_s + scenario_->light.lag_s);
}

/// A dimmer that obeys the robot: a level asked for before a field is in force from the next one.
void SimulatedWorld::follow_lamp_commands(const core::EventList& events) {
  for (const core::Event& event : events) {
    if (const auto* const command = core::content_if<core::LampCommand>(event)) {
      lamp_permille_ = command->permille;
    }
  }
}

}  // namespace tubesight::drivers
