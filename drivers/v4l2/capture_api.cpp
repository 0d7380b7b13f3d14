#include "drivers/v4l2/capture_api.h"

#include <algorithm>

namespace tubesight::drivers::v4l2 {

std::uint32_t caps_of(const v4l2_capability& can) {
  return (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
}

std::optional<CaptureApi> capture_api_of(const v4l2_capability& can) {
  const std::uint32_t caps = caps_of(can);
  if ((caps & V4L2_CAP_VIDEO_CAPTURE) != 0) {
    return CaptureApi::kWhole;
  }
  if ((caps & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0) {
    return CaptureApi::kPlanes;
  }
  return {};
}

std::uint32_t buffer_type_of(CaptureApi api) {
  return api == CaptureApi::kPlanes ? V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE
                                    : V4L2_BUF_TYPE_VIDEO_CAPTURE;
}

v4l2_format format_of(CaptureApi api, const v4l2_pix_format& picture) {
  v4l2_format format{};
  format.type = buffer_type_of(api);
  if (api == CaptureApi::kWhole) {
    format.fmt.pix = picture;
    return format;
  }
  v4l2_pix_format_mplane& planes = format.fmt.pix_mp;
  planes.width = picture.width;
  planes.height = picture.height;
  planes.pixelformat = picture.pixelformat;
  planes.field = picture.field;
  planes.num_planes = 1;
  return format;
}

v4l2_pix_format picture_of(CaptureApi api, const v4l2_format& format) {
  if (api == CaptureApi::kWhole) {
    return format.fmt.pix;
  }
  // The structure is packed: no references into it.
  const v4l2_pix_format_mplane planes = format.fmt.pix_mp;
  v4l2_pix_format picture{};
  picture.width = planes.width;
  picture.height = planes.height;
  picture.pixelformat = planes.pixelformat;
  picture.field = planes.field;
  picture.bytesperline = planes.plane_fmt[0].bytesperline;
  picture.sizeimage = planes.plane_fmt[0].sizeimage;
  return picture;
}

std::uint32_t planes_of(CaptureApi api, const v4l2_format& format) {
  return api == CaptureApi::kWhole ? 1 : format.fmt.pix_mp.num_planes;
}

BufferCall::BufferCall(CaptureApi api, std::uint32_t index) : api_(api) {
  buffer_.type = buffer_type_of(api);
  buffer_.memory = V4L2_MEMORY_MMAP;
  buffer_.index = index;
  if (api == CaptureApi::kPlanes) {
    buffer_.m.planes = &plane_;
    buffer_.length = 1;
  }
}

v4l2_buffer BufferCall::answer() const {
  v4l2_buffer answer = buffer_;
  if (api_ == CaptureApi::kPlanes) {
    answer.length = plane_.length;
    answer.bytesused = plane_.bytesused - std::min(plane_.data_offset, plane_.bytesused);
    answer.m.offset = plane_.m.mem_offset;
  }
  return answer;
}

}  // namespace tubesight::drivers::v4l2
