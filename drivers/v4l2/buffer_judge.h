#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/base/settings.h"
#include "drivers/camera/picture_look.h"
#include "drivers/v4l2/camera_report.h"
#include "drivers/v4l2/camera_setup.h"
#include "drivers/v4l2/sequence_counter.h"
#include "drivers/v4l2/signal.h"
#include "drivers/v4l2/stamp_judge.h"
#include "drivers/v4l2/video_standard.h"

struct v4l2_buffer;

namespace tubesight::drivers::v4l2 {

/// Says what the fields of a buffer are, and whether they can be believed. No heap.
class BufferJudge {
 public:
  /// What is found is counted in `report`, which outlives the judge.
  explicit BufferJudge(CameraReport& report) : report_(&report) {}

  /// A stream begins at `now`; numbers, sequence and time go on over it. An exposure of 0: a
  /// field's whole time.
  void begin(core::Scan scan, const AgreedFormat& agreed, core::FieldTime exposure,
             core::FieldTime now);

  /// When a buffer was taken from the driver.
  struct Arrival {
    core::FieldTime at{0};
    bool late = false;  ///< it may have lain there for long
  };

  /// A buffer that arrived: its first field, but for the pixels. `signal`: what the driver says of
  /// it.
  [[nodiscard]] core::Field first_field(const ::v4l2_buffer& buffer, const Arrival& arrival,
                                        Signal signal);

  /// The other field of that buffer.
  [[nodiscard]] core::Field second_field() const;

  /// Where a field stands in that buffer.
  [[nodiscard]] FieldLines lines_of(core::Parity parity) const;

  /// A glance at the pixels: makes the field a damaged one where no camera made them, or
  /// `unwritten`, where the driver left lines of an older picture.
  void look_at_picture(core::Field& field, bool unwritten);

 private:
  [[nodiscard]] core::Parity parity_of(const ::v4l2_buffer& buffer);
  void doubt(core::Field& field, CameraTrouble trouble, std::int64_t& counter);
  void count(const ::v4l2_buffer& buffer);
  void judge_time(const ::v4l2_buffer& buffer, const Arrival& arrival);

  CameraReport* report_;
  core::Scan scan_ = core::Scan::kProgressive;
  AgreedFormat agreed_;
  SequenceCounter sequence_{BufferKind::kFrame};
  StampJudge stamps_;
  StandardPace pace_;
  core::Field first_;       ///< of the last buffer
  bool odd_above_ = false;  ///< of the last buffer, a sequential one
  core::Parity last_parity_ = core::Parity::kOdd;
  std::int64_t last_number_ = -1;
};

}  // namespace tubesight::drivers::v4l2
