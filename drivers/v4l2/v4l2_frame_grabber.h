#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/snapshot.h"
#include "drivers/camera/silence.h"
#include "drivers/v4l2/buffer_judge.h"
#include "drivers/v4l2/camera_device.h"
#include "drivers/v4l2/camera_report.h"
#include "drivers/v4l2/kernel.h"
#include "drivers/v4l2/v4l2_settings.h"
#include "hal/clock.h"
#include "hal/frame_grabber.h"

namespace tubesight::drivers {

/// A camera behind V4L2: by mmap streaming, with what is wanted of it agreed and checked.
///
/// Lines of 8 bits are lent where the driver put them; of packed and deeper formats the luma of one
/// field is taken out when it is lent, so that everything behind sees lines of grey bytes.
///
/// What cannot be believed is a damaged field: what the driver flags, what is cut short, what came
/// while the input had no signal or one of another standard, snow, a picture of one grey, one that
/// the driver did not write whole, one whose stamp cannot be. What ends the stream ends it for
/// good: grab_for() says the error until stop() and start(), which are to be called by a thread
/// that may wait; start() finds the device again, on whatever node.
///
/// start(), stop() and look_after() belong to one thread, grab_for() and give_back() to another or
/// the same; between the two kinds whoever owns the grabber hands it over.
class V4l2FrameGrabber final : public hal::FrameGrabber {
 public:
  /// `clock` is the system's monotonic one, which drivers stamp with; it and `kernel` outlive the
  /// grabber.
  V4l2FrameGrabber(const V4l2Settings& settings, const hal::Clock& clock,
                   v4l2::Kernel& kernel = v4l2::system_kernel());
  V4l2FrameGrabber(const V4l2FrameGrabber&) = delete;
  V4l2FrameGrabber& operator=(const V4l2FrameGrabber&) = delete;
  ~V4l2FrameGrabber() { stop(); }

  /// May take its time. Errors beside those of the interface: kDisconnected the device is not
  /// there; messages() says what is wrong.
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;

  [[nodiscard]] core::Result<hal::FieldLease> grab_for(std::chrono::milliseconds timeout) override;
  void give_back(std::int32_t buffer) override;

  /// Asks the driver about the signal that comes in; to be called some times a second between
  /// start() and stop(). May take its time: some drivers ask a chip behind a slow bus.
  void look_after();

  /// Lines of the last start(), for a person.
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

  /// What the calibration leaves open of the camera that was opened last; of the thread that
  /// starts.
  [[nodiscard]] std::string doubt() const { return device_.doubt(); }

  /// From one field to the next, and fields that come at once; valid once started.
  [[nodiscard]] core::FieldTime span() const { return device_.agreed().span; }
  [[nodiscard]] std::int32_t fields_a_buffer() const {
    return device_.agreed().kind == v4l2::BufferKind::kPair ? 2 : 1;
  }

  /// How the camera is doing. Any thread.
  [[nodiscard]] CameraReport report() const;

 private:
  core::Result<void> next_buffer(std::chrono::milliseconds timeout);
  core::Result<void> wait(core::FieldTime until);
  void look_for_backlog(core::FieldTime before, core::FieldTime until);
  core::Result<void> nothing_came();
  core::Result<void> take_events();
  core::Result<bool> take_buffer();
  core::Result<void> break_off(CameraTrouble trouble, core::Error error);
  core::Result<void> break_off_by(int status);

  hal::FieldLease lend();
  [[nodiscard]] core::FieldView view_of(core::Parity parity);
  void publish() { latest_.publish(report_); }

  V4l2Settings settings_;
  const hal::Clock* clock_;
  v4l2::Kernel* kernel_;
  std::vector<std::string> messages_;

  bool started_ = false;
  CameraReport report_;
  v4l2::CameraDevice device_;
  v4l2::BufferJudge judge_{report_};
  std::vector<std::uint8_t> luma_;  ///< of one field, where it is taken out

  bool lent_ = false;
  bool failed_ = false;
  core::Error failure_ = core::Error::kNotReady;
  std::uint32_t held_ = 0;        ///< the buffer in our hands
  std::int32_t fields_left_ = 0;  ///< of it, not lent yet
  core::Field next_;              ///< the first of those, but for its pixels
  Silence silence_;
  core::FieldTime looked_{0};  ///< when somebody last waited for one
  bool backlog_ = false;       ///< it may have lain there for long
  std::int32_t idle_in_a_row_ = 0;
  std::int32_t errors_in_a_row_ = 0;
  std::int32_t refused_in_a_row_ = 0;

  std::atomic<v4l2::Signal> signal_{v4l2::Signal::kGood};
  std::atomic<bool> altered_{false};  ///< since the start
  core::Snapshot<CameraReport> latest_;
};

}  // namespace tubesight::drivers
