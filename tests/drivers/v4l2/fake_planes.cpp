#include "tests/drivers/v4l2/fake_planes.h"

#include <cerrno>

namespace tubesight::tests {
namespace {

int answer_format(const FakeCamera& camera, v4l2_format& format,
                  const std::function<int(void*)>& answer) {
  v4l2_pix_format_mplane asked = format.fmt.pix_mp;
  v4l2_format whole{};
  whole.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  whole.fmt.pix.width = asked.width;
  whole.fmt.pix.height = asked.height;
  whole.fmt.pix.pixelformat = asked.pixelformat;
  whole.fmt.pix.field = asked.field;
  if (const int status = answer(&whole); status != 0) {
    return status;
  }
  v4l2_pix_format_mplane told{};
  told.width = whole.fmt.pix.width;
  told.height = whole.fmt.pix.height;
  told.pixelformat = whole.fmt.pix.pixelformat;
  told.field = whole.fmt.pix.field;
  told.num_planes = static_cast<std::uint8_t>(camera.planes);
  for (std::uint32_t i = 0; i < camera.planes; ++i) {
    told.plane_fmt[i].bytesperline = whole.fmt.pix.bytesperline;
    told.plane_fmt[i].sizeimage = whole.fmt.pix.sizeimage;
  }
  format.fmt.pix_mp = told;
  return 0;
}

int answer_buffer(const FakeCamera& camera, v4l2_buffer& buffer,
                  const std::function<int(void*)>& answer) {
  v4l2_plane* const planes = buffer.m.planes;
  if (planes == nullptr || buffer.length < camera.planes) {
    return -EINVAL;
  }
  v4l2_buffer whole = buffer;
  if (const int status = answer(&whole); status != 0) {
    return status;
  }
  planes[0] = {};
  planes[0].length = whole.length;
  planes[0].m.mem_offset = whole.m.offset;
  planes[0].bytesused = whole.bytesused;
  planes[0].data_offset = camera.data_offset;
  buffer = whole;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
  buffer.m.planes = planes;
  buffer.length = camera.planes;
  buffer.bytesused = 0;  // the planes have it
  return 0;
}

}  // namespace

bool of_this_camera(const FakeCamera& camera, unsigned long request, const void* argument) {
  const std::uint32_t known =
      camera.planes > 0 ? V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE : V4L2_BUF_TYPE_VIDEO_CAPTURE;
  switch (request) {
    case VIDIOC_ENUM_FMT: return static_cast<const v4l2_fmtdesc*>(argument)->type == known;
    case VIDIOC_S_FMT:
    case VIDIOC_G_FMT: return static_cast<const v4l2_format*>(argument)->type == known;
    case VIDIOC_S_PARM:
    case VIDIOC_G_PARM: return static_cast<const v4l2_streamparm*>(argument)->type == known;
    case VIDIOC_REQBUFS: return static_cast<const v4l2_requestbuffers*>(argument)->type == known;
    case VIDIOC_QUERYBUF:
    case VIDIOC_QBUF:
    case VIDIOC_DQBUF: return static_cast<const v4l2_buffer*>(argument)->type == known;
    case VIDIOC_STREAMON:
    case VIDIOC_STREAMOFF: return *static_cast<const int*>(argument) == static_cast<int>(known);
    default: return true;
  }
}

int answer_in_planes(const FakeCamera& camera, unsigned long request, void* argument,
                     const std::function<int(void*)>& answer) {
  switch (request) {
    case VIDIOC_S_FMT:
    case VIDIOC_G_FMT: return answer_format(camera, *static_cast<v4l2_format*>(argument), answer);
    case VIDIOC_QUERYBUF:
    case VIDIOC_QBUF:
    case VIDIOC_DQBUF: return answer_buffer(camera, *static_cast<v4l2_buffer*>(argument), answer);
    default: return answer(argument);
  }
}

}  // namespace tubesight::tests
