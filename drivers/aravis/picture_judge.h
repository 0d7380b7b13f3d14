#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/base/settings.h"
#include "drivers/aravis/aravis_report.h"
#include "drivers/aravis/camera_clock.h"
#include "drivers/aravis/camera_setup.h"
#include "drivers/aravis/frame_counter.h"
#include "drivers/aravis/library.h"

namespace tubesight::drivers::aravis {

/// Says what the fields of a picture are, and whether they can be believed. No heap.
class PictureJudge {
 public:
  /// What is found is counted in `report`, which outlives the judge.
  explicit PictureJudge(AravisReport& report) : report_(&report) {}

  /// A stream begins; numbers, sequence and time go on over it.
  void begin(core::Scan scan, const AgreedPicture& agreed);

  /// A picture's first field, but for the pixels.
  [[nodiscard]] core::Field first_field(const Picture& picture);

  /// The other field of that picture.
  [[nodiscard]] core::Field second_field() const;

  /// A glance at the pixels: makes the field a damaged one where no camera made them. Converters of
  /// analogue video go on delivering when they have no signal.
  void look_at_picture(core::Field& field);

  /// Whether there was a complete picture since the beginning.
  [[nodiscard]] bool had_complete() const { return had_complete_; }

 private:
  void doubt(AravisTrouble trouble);
  void doubt(AravisTrouble trouble, std::int64_t& counter);
  void judge_pixels(const Picture& picture);
  void judge_number(const Picture& picture);
  void judge_time(const Picture& picture);

  AravisReport* report_;
  core::Scan scan_ = core::Scan::kProgressive;
  AgreedPicture agreed_;
  FrameCounter counter_;
  CameraClock clock_;
  core::Field first_;  ///< of the last picture
  std::int64_t last_number_ = -1;
  core::FieldTime last_time_{INT64_MIN};  ///< of the last field
  std::int32_t pictures_ = 0;             ///< since the beginning, up to those that settle
  bool had_complete_ = false;
};

}  // namespace tubesight::drivers::aravis
