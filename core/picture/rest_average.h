#pragma once

#include <cstdint>
#include <span>

#include "core/base/image_view.h"
#include "core/base/result.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::picture {

/// A picture averaged at rest, or the motion that forbids it.
struct RestOutcome {
  bool rested = false;
  double frame_shift_px = 0.0;  ///< largest between a field and those of its lines before
  double field_shift_px = 0.0;  ///< between the two fields of the average; 0 for progressive ones
  AveragedPicture picture;      ///< valid when the camera rested; its buffer is the caller's
};

/// Averages fields and checks as they come that nothing moved between them.
///
/// Both fields of interlaced frames are brought together only when nothing moved between them
/// either. One kind of field alone makes a picture, too, with half its lines made up.
class RestAverage {
 public:
  /// As PictureAverage's.
  RestAverage(std::span<std::uint16_t> buffer, std::int32_t width_px, std::int32_t height_px)
      : average_(buffer, width_px, height_px) {}

  /// Takes a field; errors are those of PictureAverage::add(). Costs some 3 ms, at rest.
  [[nodiscard]] Result<void> add(const FieldView& field);

  /// Fields taken so far; a whole frame counts as two.
  [[nodiscard]] std::int32_t fields() const { return average_.count(0) + average_.count(1); }

  /// Ends the average. Nothing rested when no field was taken.
  [[nodiscard]] RestOutcome finish();

 private:
  PictureAverage average_;
  double frame_shift_px_ = 0.0;
  bool interlaced_ = false;
};

}  // namespace tubesight::core::picture
