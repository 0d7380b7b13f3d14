#include "drivers/v4l2/v4l2_frame_grabber.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include <linux/videodev2.h>
#include <poll.h>

#include "core/base/assert.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::FieldTime;
using core::Result;
using core::Unexpected;
using v4l2::BufferKind;

/// Refusals in a row after which the stream is given up; one alone passes.
constexpr std::int32_t kMostRefusals = 3;
/// Buffers announced in a row without one being there: a device that does this would keep a
/// processor busy for nothing.
constexpr std::int32_t kMostIdleWakes = 8;
/// Events that one wait takes; others wait for the next.
constexpr int kMostEvents = 8;

constexpr bool device_is_gone(int status) {
  return status == -ENODEV || status == -ENXIO || status == -ENOTTY || status == -EBADF ||
         status == -ESHUTDOWN;
}

}  // namespace

V4l2FrameGrabber::V4l2FrameGrabber(const V4l2Settings& settings, const hal::Clock& clock,
                                   v4l2::Kernel& kernel)
    : settings_(settings), clock_(&clock), kernel_(&kernel), device_(settings_, kernel, clock) {}

Result<void> V4l2FrameGrabber::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  messages_.clear();
  std::string message;
  if (const auto opened = device_.open(message); !opened) {
    messages_.push_back(message);
    report_.trouble = CameraTrouble::kNotOpen;
    publish();
    return opened;
  }
  const v4l2::AgreedFormat& agreed = device_.agreed();
  const FieldTime now = clock_->now();
  judge_.begin(settings_.scan, agreed,
               FieldTime{static_cast<std::int64_t>(settings_.exposure_ms * 1e6)}, now);
  if (!agreed.pixel.lendable()) {
    luma_.resize(static_cast<std::size_t>(settings_.width_px) *
                 static_cast<std::size_t>(settings_.height_px));
  }
  fields_left_ = 0;
  failed_ = false;
  silence_.begin(now);
  looked_ = now;
  backlog_ = true;  // what is there before it can be is of the stream before
  altered_ = false;
  idle_in_a_row_ = 0;
  errors_in_a_row_ = 0;
  refused_in_a_row_ = 0;
  started_ = true;
  report_.trouble = CameraTrouble::kNone;
  look_after();
  publish();
  return {};
}

void V4l2FrameGrabber::stop() {
  TUBESIGHT_ASSERT(!lent_);
  if (!started_) {
    return;
  }
  started_ = false;
  device_.close();
  report_.trouble = CameraTrouble::kNotOpen;
  publish();
}

void V4l2FrameGrabber::look_after() {
  if (started_) {
    signal_ = device_.signal();
    altered_ = altered_ || device_.altered();
  }
}

Result<hal::FieldLease> V4l2FrameGrabber::grab_for(std::chrono::milliseconds timeout) {
  if (!started_ || lent_) {
    return Unexpected(Error::kNotReady);
  }
  if (failed_) {
    return Unexpected(failure_);
  }
  if (fields_left_ == 0) {
    const auto got = next_buffer(timeout);
    report_.counters.queue_errors = device_.ring().refusals();
    if (!got) {
      publish();
      return Unexpected(got.error());
    }
  }
  hal::FieldLease lease = lend();
  publish();
  return lease;
}

Result<void> V4l2FrameGrabber::next_buffer(std::chrono::milliseconds timeout) {
  const FieldTime until = clock_->now() + timeout;
  while (true) {
    if (const int status = device_.ring().queue_owed(); status != 0) {
      if (device_is_gone(status) || ++refused_in_a_row_ >= kMostRefusals) {
        return break_off_by(status);
      }
    } else {
      refused_in_a_row_ = 0;
    }
    const FieldTime before = clock_->now();
    const auto announced = wait(until);
    look_for_backlog(before, until);
    if (!announced) {
      return announced;
    }
    const auto taken = take_buffer();
    if (!taken) {
      return Unexpected(taken.error());
    }
    if (*taken) {
      return {};
    }
  }
}

/// Who was kept from looking for longer than a buffer takes finds those of that time: of what age,
/// only their stamps can tell. The first one that had to be waited for is new again.
void V4l2FrameGrabber::look_for_backlog(FieldTime before, FieldTime until) {
  const FieldTime after = clock_->now();
  const FieldTime usual = 2 * fields_a_buffer() * device_.agreed().span;
  if (after - until > usual) {
    backlog_ = true;
  } else if (after - before > device_.agreed().span / 8) {
    backlog_ = false;
  } else if (before - looked_ > usual) {
    backlog_ = true;
  }
  looked_ = after;
}

/// Until a buffer is announced.
Result<void> V4l2FrameGrabber::wait(FieldTime until) {
  while (true) {
    using std::chrono::milliseconds;
    const auto left = std::chrono::ceil<milliseconds>(until - clock_->now());
    const int events = kernel_->poll(device_.descriptor(), POLLIN | POLLPRI,
                                     static_cast<int>(std::max(left, milliseconds(0)).count()));
    if (events == 0) {
      return nothing_came();
    }
    if (events == -EINTR) {
      continue;
    }
    if (events < 0) {
      return break_off_by(events);
    }
    if ((events & (POLLHUP | POLLNVAL)) != 0) {
      return break_off_by(-ENODEV);
    }
    if ((events & POLLPRI) != 0) {
      TUBESIGHT_TRY(take_events());
    }
    if ((events & (POLLIN | POLLERR)) != 0) {
      return {};
    }
    // Announced without end, and no event there: waiting would keep a processor busy.
    ++report_.counters.idle_wakes;
    if (++idle_in_a_row_ >= kMostIdleWakes) {
      return break_off(CameraTrouble::kStream, Error::kIo);
    }
    if (clock_->now() >= until) {
      return nothing_came();
    }
  }
}

Result<void> V4l2FrameGrabber::nothing_came() {
  if (!silence_.too_long(clock_->now(), device_.agreed().span)) {
    return Unexpected(Error::kTimeout);
  }
  ++report_.counters.silences;
  return break_off(CameraTrouble::kSilent, Error::kIo);
}

/// A change of the source demands a new beginning even where the size looks the same.
Result<void> V4l2FrameGrabber::take_events() {
  for (int i = 0; i < kMostEvents; ++i) {
    v4l2_event event{};
    if (kernel_->ioctl(device_.descriptor(), VIDIOC_DQEVENT, &event) != 0) {
      break;
    }
    if (event.type == V4L2_EVENT_SOURCE_CHANGE) {
      ++report_.counters.source_changes;
      return break_off(CameraTrouble::kSourceChanged, Error::kIo);
    }
    if (event.type == V4L2_EVENT_CTRL && (event.u.ctrl.changes & V4L2_EVENT_CTRL_CH_VALUE) != 0) {
      ++report_.counters.source_changes;
      return break_off(CameraTrouble::kAltered, Error::kIo);
    }
    if (event.pending == 0) {
      break;
    }
  }
  return {};
}

/// False: there is none, or one refusal that may pass.
Result<bool> V4l2FrameGrabber::take_buffer() {
  v4l2_buffer buffer{};
  const int status = device_.ring().take(buffer);
  if (status == 0) {
    // Asked after the buffer was filled: one of the input before the change is lost with it.
    const bool switched = device_.switched();
    if (switched || altered_) {
      ++report_.counters.source_changes;
      const auto trouble = switched ? CameraTrouble::kSwitched : CameraTrouble::kAltered;
      return Unexpected(break_off(trouble, Error::kIo).error());
    }
    idle_in_a_row_ = 0;
    errors_in_a_row_ = 0;
    silence_.broken(clock_->now());
    // What was wrong with the buffer before is known by now; in between nobody may have looked.
    if (report_.trouble != CameraTrouble::kDamaged) {
      silence_.whole();
    }
    if (silence_.broken_for_long(device_.agreed().span)) {
      return Unexpected(break_off(CameraTrouble::kDamaged, Error::kIo).error());
    }
    held_ = buffer.index;
    if (!settings_.use_stamps) {
      buffer.flags &= ~static_cast<std::uint32_t>(V4L2_BUF_FLAG_TIMESTAMP_MASK);  // unknown
    }
    fields_left_ = fields_a_buffer();
    next_ = judge_.first_field(buffer, {silence_.last(), backlog_}, signal_);
    return true;
  }
  bool passes = false;
  if (status == -EAGAIN) {
    ++report_.counters.idle_wakes;
    passes = ++idle_in_a_row_ < kMostIdleWakes;
  } else {
    ++report_.counters.dequeue_errors;
    passes = !device_is_gone(status) && status != -EPIPE && ++errors_in_a_row_ < kMostRefusals;
  }
  return passes ? Result<bool>(false) : Unexpected(break_off_by(status).error());
}

Result<void> V4l2FrameGrabber::break_off(CameraTrouble trouble, Error error) {
  report_.trouble = trouble;
  failed_ = true;
  failure_ = error;
  return Unexpected(error);
}

Result<void> V4l2FrameGrabber::break_off_by(int status) {
  if (device_is_gone(status)) {
    ++report_.counters.disconnects;
    return break_off(CameraTrouble::kGone, Error::kDisconnected);
  }
  return break_off(CameraTrouble::kStream, Error::kIo);
}

core::FieldView V4l2FrameGrabber::view_of(core::Parity parity) {
  const v4l2::AgreedFormat& agreed = device_.agreed();
  const v4l2::FieldLines place = judge_.lines_of(parity);
  core::FieldView view;
  view.width_px = settings_.width_px;
  view.lines = place.lines;
  view.first_line = parity == core::Parity::kOdd ? 1 : 0;
  view.line_step = parity == core::Parity::kProgressive ? 1 : 2;
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(place.step) * agreed.stride_bytes;
  const std::byte* const from =
      device_.ring().memory(held_) + static_cast<std::ptrdiff_t>(place.first) * agreed.stride_bytes;
  if (agreed.pixel.lendable()) {
    view.pixels = reinterpret_cast<const std::uint8_t*>(from);
    view.stride_px = static_cast<std::int32_t>(stride);
    return view;
  }
  for (std::int32_t line = 0; line < view.lines; ++line) {
    v4l2::extract_line(agreed.pixel, from + line * stride, view.width_px,
                       luma_.data() + static_cast<std::ptrdiff_t>(line) * view.width_px);
  }
  view.pixels = luma_.data();
  view.stride_px = view.width_px;
  return view;
}

hal::FieldLease V4l2FrameGrabber::lend() {
  core::Field field = next_;
  field.pixels = view_of(field.parity);
  judge_.look_at_picture(field, device_.ring().unwritten(held_, judge_.lines_of(field.parity)));
  if (--fields_left_ > 0) {
    next_ = judge_.second_field();
  }
  lent_ = true;
  return {*this, static_cast<std::int32_t>(held_), field};
}

void V4l2FrameGrabber::give_back(std::int32_t buffer) {
  TUBESIGHT_ASSERT(lent_ && buffer == static_cast<std::int32_t>(held_));
  lent_ = false;
  if (fields_left_ == 0) {
    device_.ring().give_back(held_);
  }
}

CameraReport V4l2FrameGrabber::report() const {
  CameraReport report;
  static_cast<void>(latest_.try_read(report));
  return report;
}

}  // namespace tubesight::drivers
