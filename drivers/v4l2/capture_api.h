#pragma once

#include <cstdint>
#include <optional>

#include <linux/videodev2.h>

namespace tubesight::drivers::v4l2 {

/// By which of V4L2's two sets of calls a driver gives its pictures: each in one memory, or in
/// planes. Drivers of boards (MIPI) often know the second alone, also for pictures of one plane;
/// those are taken, others are not.
enum class CaptureApi : std::uint8_t { kWhole, kPlanes };

/// What a device says that it can; of both the first. Empty: it gives no pictures.
[[nodiscard]] std::optional<CaptureApi> capture_api_of(const ::v4l2_capability& can);

/// As `device_caps`, where the driver tells them.
[[nodiscard]] std::uint32_t caps_of(const ::v4l2_capability& can);

/// V4L2_BUF_TYPE_... of all calls.
[[nodiscard]] std::uint32_t buffer_type_of(CaptureApi api);

/// A picture of one plane as the call's argument.
[[nodiscard]] ::v4l2_format format_of(CaptureApi api, const ::v4l2_pix_format& picture);

/// The answer; of several planes the first.
[[nodiscard]] ::v4l2_pix_format picture_of(CaptureApi api, const ::v4l2_format& format);

/// In how many memories the answer's picture lies.
[[nodiscard]] std::uint32_t planes_of(CaptureApi api, const ::v4l2_format& format);

/// A buffer as an argument of both sets of calls. Not to be copied: it may point into itself.
class BufferCall {
 public:
  BufferCall(CaptureApi api, std::uint32_t index);
  BufferCall(const BufferCall&) = delete;
  BufferCall& operator=(const BufferCall&) = delete;

  [[nodiscard]] void* argument() { return &buffer_; }

  /// The answer as that of the calls without planes: `length`, `bytesused` and `m.offset` are the
  /// plane's. `bytesused` counts from where the picture begins in it.
  [[nodiscard]] ::v4l2_buffer answer() const;

  /// Bytes before the picture.
  [[nodiscard]] std::uint32_t data_offset() const { return plane_.data_offset; }

 private:
  CaptureApi api_;
  ::v4l2_buffer buffer_{};
  ::v4l2_plane plane_{};
};

}  // namespace tubesight::drivers::v4l2
