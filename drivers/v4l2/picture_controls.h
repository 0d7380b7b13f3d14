#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/static_vector.h"
#include "drivers/v4l2/kernel.h"
#include "drivers/v4l2/v4l2_settings.h"

namespace tubesight::drivers::v4l2 {

/// Watches the controls that mirror, turn, shift or magnify a camera's picture.
///
/// A calibration holds for one setting of them; in a mirrored picture the tool moves the wrong way
/// from tube to tube. Any program may change them, even while a camera streams, and what it leaves
/// stays.
class PictureControls {
 public:
  explicit PictureControls(Kernel& kernel) : kernel_(&kernel) {}

  /// Reads those that the camera has, and asks to be told by events of the stream when one changes.
  /// Each must be as it is by default, or as `wanted` has set it. Errors: kUnsupported, with
  /// `message`.
  [[nodiscard]] core::Result<void> begin(int descriptor, const std::vector<ControlSetting>& wanted,
                                         std::string& message);

  /// Whether one is another than at begin(); for drivers that tell no changes. May take its time.
  [[nodiscard]] bool changed(int descriptor) const;

 private:
  struct Kept {
    std::uint32_t id = 0;
    std::int32_t value = 0;
  };
  static constexpr std::int32_t kMost = 6;

  Kernel* kernel_;
  core::StaticVector<Kept, kMost> kept_;
};

}  // namespace tubesight::drivers::v4l2
