#pragma once

#include <chrono>
#include <cstdint>

#include <linux/videodev2.h>

#include "core/base/field.h"
#include "drivers/v4l2/kernel.h"
#include "hal/clock.h"

namespace tubesight::drivers::v4l2 {

/// What kind of analogue video: lines of a frame and fields a second.
enum class VideoStandard : std::uint8_t {
  kNone,  ///< it is not known, or there is no such thing
  kNtsc,  ///< 525 lines, 59.94 fields a second
  kPal,   ///< 625 lines, 50 fields a second
};

/// Of V4L2's bits; kNone where they leave both possible.
[[nodiscard]] VideoStandard standard_of(v4l2_std_id bits);
/// As settings name it: "NTSC".
[[nodiscard]] const char* name_of(VideoStandard standard);
/// From one field to the next; 0 of kNone.
[[nodiscard]] core::FieldTime field_time_of(VideoStandard standard);

/// Asks a driver for the standard of the signal that comes in, as often as it bears the question.
///
/// Some set their chip to find it out, and sleep for a tenth of a second with the lock in hand that
/// the calls for buffers need as well; some refuse while they stream. They are spared it: whoever
/// asks does so only where no picture is good anyway.
class StandardQuestion {
 public:
  /// A driver that takes longer keeps its buffers waiting.
  static constexpr core::FieldTime kLongest = std::chrono::milliseconds(5);

  StandardQuestion(Kernel& kernel, const hal::Clock& clock) : kernel_(&kernel), clock_(&clock) {}

  /// The camera is opened anew.
  void begin() { dear_ = false; }
  /// kNone: the driver does not find it out. May take its time.
  [[nodiscard]] VideoStandard ask(int descriptor);
  /// Whether the driver was slow to answer, or refused.
  [[nodiscard]] bool dear() const { return dear_; }

 private:
  Kernel* kernel_;
  const hal::Clock* clock_;
  bool dear_ = false;
};

/// Finds a signal of the other standard by the pace of its fields.
///
/// Many grabbers cannot say what comes in. One that is set to 525 lines and gets a signal of 625
/// delivers torn or rolling pictures, or some of their lines, at the pace of the signal: 20 ms a
/// field and not 16.7. Pictures lost on the way, or late ones, make single intervals longer, but
/// not most of them alike. No heap.
class StandardPace {
 public:
  /// Intervals that are looked at, some 0.8 s of frames; and how many must be of one kind.
  static constexpr int kIntervals = 24;
  static constexpr int kMost = 20;

  /// A stream of this standard begins; of kNone nothing is found.
  void begin(VideoStandard agreed);

  /// A buffer's first field: when it was exposed, and its number among all.
  void take(core::FieldTime mid_exposure, std::int64_t sequence);

  /// Whether the signal is of the other standard.
  [[nodiscard]] bool other() const { return other_; }

 private:
  core::FieldTime own_time_{0};
  core::FieldTime other_time_{0};
  core::FieldTime last_{0};
  std::int64_t last_sequence_ = 0;
  bool known_ = false;            ///< there was a field
  std::uint32_t own_bits_ = 0;    ///< the last intervals that were of this standard
  std::uint32_t other_bits_ = 0;  ///< the last intervals that were of the other
  bool other_ = false;
};

}  // namespace tubesight::drivers::v4l2
