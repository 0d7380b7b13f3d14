#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <linux/videodev2.h>

#include "core/base/field.h"

namespace tubesight::tests {

/// A camera of the fake kernel: what it has, and what it does wrong. All may be changed at any
/// time.
struct FakeCamera {
  struct Input {
    std::string name;
    std::uint32_t status = 0;
    v4l2_std_id standards = 0;  ///< that it knows
  };
  struct Control {
    std::string name;
    std::uint32_t id = 0;  ///< 0: its place in the list, from 1
    std::uint32_t type = V4L2_CTRL_TYPE_INTEGER;
    std::int32_t least = 0;
    std::int32_t most = 100;
    std::vector<std::string> entries;
    std::int32_t value = 0;
    std::int32_t usual = 0;  ///< by default
    bool keeps = true;
  };

  std::uint32_t caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  int opening = 0;  ///< what an opening ends with: 0, or -errno
  std::string bus = "usb-0000:00:14.0-1";
  std::string serial;
  std::string card = "Grabber";
  std::vector<Input> inputs{{"S-Video", 0}};
  int input = 0;                ///< the one chosen
  bool stays_at_input = false;  ///< it says that another one was chosen, and it was not
  v4l2_std_id standard = 0;     ///< set; 0: it has none
  v4l2_std_id sensed = 0;       ///< of the signal, as QUERYSTD says it; 0: it cannot
  core::FieldTime sensing{0};   ///< how long QUERYSTD takes
  std::vector<std::uint32_t> formats{V4L2_PIX_FMT_GREY};
  std::vector<std::uint32_t> fields{V4L2_FIELD_NONE};  ///< others are answered with the first
  std::uint32_t widths_of = 1;      ///< a width is rounded up to a multiple of it
  std::uint32_t padding_bytes = 0;  ///< at the end of a line
  std::uint32_t missing_bytes = 0;  ///< of a buffer's memory
  std::uint32_t planes = 0;         ///< it knows the calls with planes alone, and gives so many
  std::uint32_t data_offset = 0;    ///< bytes before the picture, in the first plane
  v4l2_fract frame_time{1, 30};     ///< 0: it does not say
  bool changes_rate = false;
  std::uint32_t most_buffers = 32;
  std::vector<Control> controls;

  /// Time from one buffer to the next; 0: none ever comes.
  core::FieldTime every{33'333'333};
  std::uint32_t stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  /// What a driver says and a picture shows may be changed here before a buffer is taken; `number`
  /// counts the buffers of all streams from 0.
  std::function<void(std::int64_t number, v4l2_buffer& buffer, std::span<std::byte> memory)> tamper;
  /// Lines of the next buffers that the driver does not write, from, to; what stood there stays.
  std::deque<std::pair<std::uint32_t, std::uint32_t>> unwritten;
  /// Results of the next calls of a request, in their order: 0 is done as usual, else -errno.
  std::map<unsigned long, std::deque<int>> results;
  std::deque<int> poll_results;   ///< of the next calls, as poll()'s
  std::deque<v4l2_event> events;  ///< pending
  /// Called before a request is answered: what happens in the middle of an opening.
  std::function<void(unsigned long request)> before;
};

/// Draws what a camera of this format sees, as `told` says which lines.
void draw_picture(const v4l2_pix_format& format, const v4l2_buffer& told,
                  std::span<std::byte> memory, std::pair<std::uint32_t, std::uint32_t> unwritten);

/// Bytes from one grey value of a format to the next.
[[nodiscard]] std::uint32_t bytes_a_pixel(std::uint32_t format);

/// The answers to a control's requests; 0 or -errno.
int query_control(const FakeCamera& camera, v4l2_queryctrl& query);
int query_menu(const FakeCamera& camera, v4l2_querymenu& menu);
int serve_control(FakeCamera& camera, bool set, v4l2_control& asked);

}  // namespace tubesight::tests
