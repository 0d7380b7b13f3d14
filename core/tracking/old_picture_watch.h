#pragma once

#include <cstdint>

#include "core/base/field.h"
#include "core/base/image_view.h"
#include "core/tracking/picture_memory.h"

namespace tubesight::core::tracking {

/// Finds pictures that were seen before: the frame store stopped, or the field is torn.
///
/// Equal lines are an old picture only where the camera has noise; drawn and averaged pictures have
/// none. That is learnt from the tool's own rests: pictures of the same place that differ show
/// that equal ones do not happen. Until then no picture is called old. Integers alone.
class OldPictureWatch {
 public:
  /// A new start: nothing is remembered or learnt.
  void begin() { *this = {}; }

  /// Whether two or more of the lines looked at are a picture seen before. Call once for each field
  /// with pixels. The window lies in the picture.
  [[nodiscard]] bool shows_old(const Field& field, const PixelBox& window);

  /// The field looked at last was believed; `at_rest`: it shows the tool standing still.
  void believe(bool at_rest);

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [memory, likeness, rested, noisy] = self;
    stream(memory, likeness);
    stream.number(rested, 0, 1 << 30);
    stream(noisy);
  }

 private:
  PictureMemory memory_{};
  PictureLikeness likeness_{};  ///< of the last field that was looked at
  std::int32_t rested_ = 0;     ///< believed fields in a row with the tool at rest
  bool noisy_ = false;          ///< pictures of a tool at rest differ
};

}  // namespace tubesight::core::tracking
