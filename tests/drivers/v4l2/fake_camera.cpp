#include "tests/drivers/v4l2/fake_camera.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "tests/support/drawn_grey.h"

namespace tubesight::tests {

std::uint32_t bytes_a_pixel(std::uint32_t format) {
  return format == V4L2_PIX_FMT_GREY || format == V4L2_PIX_FMT_NV12 ? 1 : 2;
}

namespace {

/// The place in the list of a control; the list's length: it has none of this number.
std::size_t place_of(const FakeCamera& camera, std::uint32_t id) {
  std::size_t at = 0;
  while (at < camera.controls.size() &&
         id != (camera.controls[at].id != 0 ? camera.controls[at].id : at + 1)) {
    ++at;
  }
  return at;
}

}  // namespace

int query_control(const FakeCamera& camera, v4l2_queryctrl& query) {
  const bool next = (query.id & V4L2_CTRL_FLAG_NEXT_CTRL) != 0;
  const std::uint32_t id = query.id & ~V4L2_CTRL_FLAG_NEXT_CTRL;
  const std::size_t at = !next ? place_of(camera, id) : id == 0 ? 0 : place_of(camera, id) + 1;
  if (at >= camera.controls.size()) {
    return -EINVAL;
  }
  const FakeCamera::Control& control = camera.controls[at];
  query = {};
  query.id = control.id != 0 ? control.id : static_cast<std::uint32_t>(at + 1);
  query.type = control.type;
  query.minimum = control.least;
  query.maximum = control.most;
  query.default_value = control.usual;
  std::memcpy(query.name, control.name.data(),
              std::min(sizeof query.name - 1, control.name.size()));
  return 0;
}

int query_menu(const FakeCamera& camera, v4l2_querymenu& menu) {
  const FakeCamera::Control& control = camera.controls[place_of(camera, menu.id)];
  if (menu.index >= control.entries.size() || control.entries[menu.index].empty()) {
    return -EINVAL;
  }
  std::memset(menu.name, 0, sizeof menu.name);
  std::memcpy(menu.name, control.entries[menu.index].data(),
              std::min(sizeof menu.name - 1, control.entries[menu.index].size()));
  return 0;
}

int serve_control(FakeCamera& camera, bool set, v4l2_control& asked) {
  const std::size_t at = place_of(camera, asked.id);
  if (at >= camera.controls.size()) {
    return -EINVAL;
  }
  FakeCamera::Control& control = camera.controls[at];
  if (set && control.keeps) {
    control.value = asked.value;
  }
  asked.value = control.value;
  return 0;
}

/// A field a buffer, or all lines: as the format says.
void draw_picture(const v4l2_pix_format& pix, const v4l2_buffer& told, std::span<std::byte> memory,
                  std::pair<std::uint32_t, std::uint32_t> unwritten) {
  for (std::uint32_t line = 0; line < pix.height; ++line) {
    if (line >= unwritten.first && line < unwritten.second) {
      continue;
    }
    std::uint32_t v = line;
    if (pix.field == V4L2_FIELD_ALTERNATE) {
      v = 2 * line + (told.field == V4L2_FIELD_BOTTOM ? 1 : 0);
    } else if (V4L2_FIELD_IS_SEQUENTIAL(pix.field)) {
      const std::uint32_t half = pix.height / 2;
      const bool below = line >= half;
      v = 2 * (line % half) + (below == (told.field == V4L2_FIELD_SEQ_TB) ? 1 : 0);
    }
    for (std::uint32_t u = 0; u < pix.width; ++u) {
      const std::uint32_t grey =
          drawn_grey(static_cast<std::int32_t>(u), static_cast<std::int32_t>(v));
      const std::size_t at = line * pix.bytesperline + u * bytes_a_pixel(pix.pixelformat);
      const auto set = [&](std::size_t place, std::uint32_t value) {
        if (place < memory.size()) {
          memory[place] = static_cast<std::byte>(value);
        }
      };
      switch (pix.pixelformat) {
        case V4L2_PIX_FMT_UYVY: set(at, 128), set(at + 1, grey); break;
        case V4L2_PIX_FMT_YUYV: set(at, grey), set(at + 1, 128); break;
        case V4L2_PIX_FMT_Y10: set(at, grey << 2 | 3), set(at + 1, grey >> 6); break;
        case V4L2_PIX_FMT_Y16: set(at, 255), set(at + 1, grey); break;
        default: set(at, grey); break;
      }
    }
  }
}

}  // namespace tubesight::tests
