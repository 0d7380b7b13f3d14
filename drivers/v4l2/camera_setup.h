#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/field.h"
#include "core/base/result.h"
#include "drivers/v4l2/capture_api.h"
#include "drivers/v4l2/kernel.h"
#include "drivers/v4l2/pixel_format.h"
#include "drivers/v4l2/sequence_counter.h"
#include "drivers/v4l2/v4l2_settings.h"
#include "drivers/v4l2/video_standard.h"

namespace tubesight::drivers::v4l2 {

/// Where a field stands in a buffer, in lines: the first one, and how far from one to the next.
struct FieldLines {
  std::int32_t first = 0;
  std::int32_t step = 1;
  std::int32_t lines = 0;
};

/// What was agreed with a driver, read back from it.
struct AgreedFormat {
  CaptureApi api = CaptureApi::kWhole;  ///< what the device can, known beforehand
  PixelFormat pixel;
  BufferKind kind = BufferKind::kFrame;
  bool sequential = false;  ///< the fields of a pair stand one below the other
  bool odd_above = false;   ///< of those, that of odd lines first
  std::int32_t lines = 0;   ///< in a buffer
  std::int32_t stride_bytes = 0;
  std::size_t bytes = 0;                          ///< that the grey values of a buffer reach to
  core::FieldTime span{0};                        ///< from one field to the next
  std::uint32_t input = 0;                        ///< index of the one chosen
  bool input_status = false;                      ///< there is an input that can be asked
  VideoStandard standard = VideoStandard::kNone;  ///< that the input is set to

  /// Of a buffer's field; `above_is_odd` where they stand one below the other.
  [[nodiscard]] FieldLines lines_of(bool odd, bool above_is_odd) const;
};

/// Sets an open camera as the settings want it and reads back what became of it: input, standard,
/// format, rate, controls. A change of the source from the choice of the standard on is told by an
/// event of the stream, so that none is missed. Opens no buffers. `agreed.api` is read, the rest is
/// written.
///
/// Errors: kUnsupported it does not have what is wanted, kIo it refused; `message` says which, what
/// it offers and what was wanted.
[[nodiscard]] core::Result<void> set_up(Kernel& kernel, int descriptor,
                                        const V4l2Settings& settings, StandardQuestion& question,
                                        AgreedFormat& agreed, std::string& message);

/// Whether a status of VIDIOC_ENUMINPUT says that no signal comes in.
[[nodiscard]] bool says_no_signal(std::uint32_t status);
/// Whether it says that the signal's standard is not the one that is set, nor any that is known.
[[nodiscard]] bool says_no_standard(std::uint32_t status);

}  // namespace tubesight::drivers::v4l2
