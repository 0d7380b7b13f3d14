#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/frames.h"
#include "core/base/image_view.h"
#include "core/base/result.h"
#include "core/base/transform.h"
#include "core/rendering/renderer.h"
#include "core/rendering/truth.h"
#include "drivers/simulated/another_picture.h"
#include "drivers/simulated/fault_schedule.h"
#include "drivers/simulated/pixel_faults.h"
#include "drivers/simulated/scenario.h"
#include "drivers/simulated/simulated_robot.h"
#include "drivers/simulated/tool_motion.h"
#include "drivers/simulated/video_source.h"

namespace tubesight::drivers {

/// What is true in the middle of a field's exposure, all faults included.
struct FieldTruth {
  core::Transform<core::frames::Sheet, core::frames::Tool> T_sheet_tool;
  core::Transform<core::frames::Camera, core::frames::Sheet> T_camera_sheet;
  double speed_mm_s = 0.0;            ///< of the tip
  bool axis_known = false;            ///< the guidetube points at the sheet
  core::rendering::AxisTruth axis{};  ///< where, and the nearest tube
  /// Lattice steps (rows, columns) of the jumps since the last start that nothing showed: a box on
  /// a bare lattice names the true tube less these. A jump within a gap in sequence or time is
  /// told, and not in it. A skip counts as a jump where it looks like one. Of the fields that
  /// next() and next_slot() make.
  std::array<std::int32_t, 2> slip{};
};

/// One field, what came before it, and what is true of it.
struct SimulatedField {
  core::Field field;       ///< pixels are valid until the next call of the world
  std::int64_t slot = 0;   ///< counts the camera's fields, lost ones too
  bool lost = false;       ///< next_slot() alone: the field is not delivered
  core::EventList events;  ///< since the last delivered field
  FieldFaults faults;
  FieldTruth truth;
};

/// Plays a scenario: field after field with events and truth, by its own clock.
///
/// The same scenario gives the same fields on one machine. Everything stands in memory obtained by
/// configure(); next() allocates nothing. One thread. Some MB: static or heap.
class SimulatedWorld {
 public:
  SimulatedWorld() = default;
  SimulatedWorld(const SimulatedWorld&) = delete;
  SimulatedWorld& operator=(const SimulatedWorld&) = delete;

  /// Goes to the start of `scenario`, which outlives the world. May be called again.
  ///
  /// A scenario's robot carries out its path and claims where it believes to be; steer() again
  /// after configuring where another motion is wanted then.
  ///
  /// Errors: those of SimulatedRobot::configure() and add() where the scenario has a robot;
  /// kInvalidArgument, kOutOfRange as Renderer::configure(); kInvalidArgument,
  /// kBufferTooSmall as ToolPath::add(); kInvalidArgument a rate not above 0, an exposure below 0
  /// or longer than a field.
  [[nodiscard]] core::Result<void> configure(const Scenario& scenario);

  /// From now on `motion` moves the tool; null: the scenario's robot or path again.
  void steer(ToolMotion* motion) { motion_ = motion != nullptr ? motion : robot_.get(); }

  /// The lamp level in force from the next field on, 0..1000 permille: what a dimmer sets.
  void set_lamp_permille(std::int32_t permille) { lamp_permille_ = permille; }
  [[nodiscard]] std::int32_t lamp_permille() const { return lamp_permille_; }

  /// Makes the next field that is delivered; false when the recording has ended.
  [[nodiscard]] bool next(SimulatedField& out);

  /// The same for the camera's next field, delivered or not. A lost one has no pixels of its own
  /// and leaves the events to the next.
  [[nodiscard]] bool next_slot(SimulatedField& out);

  /// What the faults do to a slot.
  [[nodiscard]] FieldFaults faults_at(std::int64_t slot) const;

  /// The last slot that faults don't lose; -1 when they lose all.
  [[nodiscard]] std::int64_t last_delivered() const;

  /// Whether a fault, of the scenario or not, has a slot of the recording to act on.
  [[nodiscard]] bool hits(const Fault& fault) const;

  /// What is true of a slot, without drawing it. With a ToolMotion: not before the last field.
  [[nodiscard]] FieldTruth truth_of(std::int64_t slot);

  /// Fields of the whole recording, lost ones too.
  [[nodiscard]] std::int64_t slots() const { return slots_; }

  /// Nominal mid-exposure of a slot.
  [[nodiscard]] core::FieldTime slot_time(std::int64_t slot) const;

  /// The frame with both fields' lines as they were last delivered.
  [[nodiscard]] core::ImageView frame() const;

  /// The scenario's path; what a robot or another ToolMotion makes of it is not in it.
  [[nodiscard]] const core::kinematics::ToolPath& path() const { return path_; }

  /// The scene's truth, for centres of tube-ends.
  [[nodiscard]] const core::rendering::Truth& truth() const { return truth_; }

 private:
  using SheetTool = core::Transform<core::frames::Sheet, core::frames::Tool>;

  [[nodiscard]] FieldSlot slot_at(std::int64_t slot) const;
  [[nodiscard]] core::Parity parity_of(std::int64_t slot) const;
  [[nodiscard]] SheetTool pose_at(double time_s, const FieldFaults& faults);
  [[nodiscard]] FieldPixels pixels_of(core::Parity parity);
  [[nodiscard]] core::Result<void> make_robot(const Scenario& scenario);
  void take_events(double time_s, core::EventList& events);
  /// Where everything is while the shutter is open.
  struct Shutter {
    double opened_s = 0.0;
    double closed_s = 0.0;
    SheetTool opened;
    SheetTool closed;
  };
  FieldTruth look(std::int64_t slot, const FieldFaults& faults, Shutter& shutter);
  void expose(const Shutter& shutter, const SimulatedField& out);
  void draw(const core::rendering::Exposure& exposure, const FieldFaults& faults);
  [[nodiscard]] std::array<std::int32_t, 2> steps_of_skip(const SimulatedField& field);
  void follow_slip(SimulatedField& out);
  [[nodiscard]] core::FieldTime stamp(const FieldFaults& faults) const;
  void warm_lamp();
  [[nodiscard]] double following_share() const;
  void follow_lamp_commands(const core::EventList& events);

  const Scenario* scenario_ = nullptr;
  std::unique_ptr<SimulatedRobot> robot_;  ///< the scenario's, if it has one
  ToolMotion* motion_ = nullptr;
  core::rendering::Renderer renderer_;
  core::rendering::Truth truth_;
  core::kinematics::ToolPath path_;
  std::vector<std::uint8_t> frame_;
  std::vector<std::uint8_t> kept_;  ///< lines of the picture before, while a torn one is drawn
  core::PixelBox window_ = core::rendering::kWholePicture;
  bool interlaced_ = true;
  std::int64_t slots_ = 0;
  std::int64_t slot_ = 0;               ///< the next
  std::int64_t unnumbered_ = 0;         ///< lost without a sequence number
  std::array<std::int32_t, 2> jump_{};  ///< of the last field delivered
  std::array<std::int32_t, 2> told_{};  ///< of that, what a start or a gap let the box know
  std::array<std::int32_t, 2> skip_{};  ///< lattice steps that what was left out is taken for
  double skipped_s_ = 0.0;              ///< of the last field
  bool gap_ = false;                    ///< the last slot was not delivered
  std::size_t events_taken_ = 0;
  bool started_ = false;  ///< the clicks were handed over
  std::int32_t lamp_permille_ = 1000;
  AnotherPicture another_picture_;
  VideoSource video_source_;
  double shine_ = 1.0;  ///< the lamp's light, 0..1, which follows the level with its lag
};

}  // namespace tubesight::drivers
