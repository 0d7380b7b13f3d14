#include "tests/drivers/v4l2/fake_kernel.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <poll.h>

#include "tests/drivers/v4l2/fake_planes.h"

namespace tubesight::tests {
namespace {

template <std::size_t N>
void put(unsigned char (&to)[N], const std::string& text) {
  std::memcpy(to, text.c_str(), std::min(N, text.size() + 1));
}

}  // namespace

std::shared_ptr<FakeCamera> FakeKernel::plug(int number, std::shared_ptr<FakeCamera> camera) {
  cameras_[number] = camera;
  return camera;
}

void FakeKernel::unplug(int number) { cameras_.erase(number); }

bool FakeKernel::plugged(const Opened& opened) const {
  const auto at = cameras_.find(opened.number);
  return at != cameras_.end() && at->second == opened.camera;
}

int FakeKernel::calls(unsigned long request) const {
  const auto at = calls_.find(request);
  return at == calls_.end() ? 0 : at->second;
}

void FakeKernel::change_source(FakeCamera& camera, std::uint32_t id) {
  v4l2_event change{};
  change.type = V4L2_EVENT_SOURCE_CHANGE;
  change.id = id;
  tell(camera, change);
}

void FakeKernel::change_control(FakeCamera& camera, std::uint32_t id, std::int32_t value) {
  v4l2_control set{id, value};
  static_cast<void>(serve_control(camera, true, set));
  v4l2_event change{};
  change.type = V4L2_EVENT_CTRL;
  change.id = id;
  change.u.ctrl.changes = V4L2_EVENT_CTRL_CH_VALUE;
  tell(camera, change);
}

void FakeKernel::tell(FakeCamera& camera, const v4l2_event& event) {
  const std::pair<std::uint32_t, std::uint32_t> what{event.type, event.id};
  for (const auto& [descriptor, opened] : opened_) {
    const bool told = std::ranges::find(opened.subscribed, what) != opened.subscribed.end();
    if (told && opened.camera.get() == &camera) {
      camera.events.push_back(event);
    }
  }
}

int FakeKernel::open(const std::string& path) {
  const std::string real = real_path(path);
  if (real.empty()) {
    return -ENOENT;
  }
  const int number = std::stoi(real.substr(std::strlen("/dev/video")));
  Opened opened;
  opened.camera = cameras_.at(number);
  if (opened.camera->opening != 0) {
    return opened.camera->opening;
  }
  opened.number = number;
  opened_[next_descriptor_] = std::move(opened);
  return next_descriptor_++;
}

void FakeKernel::close(int descriptor) { opened_.erase(descriptor); }

int FakeKernel::ioctl(int descriptor, unsigned long request, void* argument) {
  ++calls_[request];
  const auto at = opened_.find(descriptor);
  if (at == opened_.end()) {
    return -EBADF;
  }
  Opened& opened = at->second;
  if (!plugged(opened)) {
    return -ENODEV;
  }
  if (opened.camera->before) {
    opened.camera->before(request);
  }
  std::deque<int>& results = opened.camera->results[request];
  if (!results.empty()) {
    const int result = results.front();
    results.pop_front();
    if (result != 0) {
      return result;
    }
  }
  if (!of_this_camera(*opened.camera, request, argument)) {
    return -EINVAL;
  }
  if (opened.camera->planes == 0) {
    return answer(opened, request, argument);
  }
  // One reference: what a std::function holds without the heap.
  const auto serve = [&](void* whole) { return answer(opened, request, whole); };
  return answer_in_planes(*opened.camera, request, argument,
                          [&serve](void* whole) { return serve(whole); });
}

int FakeKernel::answer(Opened& opened, unsigned long request, void* argument) {
  FakeCamera& camera = *opened.camera;
  switch (request) {
    case VIDIOC_QUERYCAP: {
      auto& can = *static_cast<v4l2_capability*>(argument);
      put(can.driver, "fake");
      put(can.card, camera.card);
      put(can.bus_info, camera.bus);
      can.capabilities = camera.caps | V4L2_CAP_DEVICE_CAPS;
      can.device_caps = camera.caps;
      return 0;
    }
    case VIDIOC_ENUMINPUT: {
      auto& input = *static_cast<v4l2_input*>(argument);
      if (input.index >= camera.inputs.size()) {
        return -EINVAL;
      }
      put(input.name, camera.inputs[input.index].name);
      input.status = camera.inputs[input.index].status;
      input.std = camera.inputs[input.index].standards;
      return 0;
    }
    case VIDIOC_S_INPUT:
      camera.input = camera.stays_at_input ? camera.input : *static_cast<int*>(argument);
      return 0;
    case VIDIOC_G_INPUT:
      *static_cast<int*>(argument) = camera.input;
      return camera.inputs.empty() ? -ENOTTY : 0;
    case VIDIOC_S_STD: {
      const v4l2_std_id wanted = *static_cast<v4l2_std_id*>(argument);
      camera.standard = camera.standard == 0 ? 0 : wanted;
      return camera.standard == 0 ? -ENODATA : 0;
    }
    case VIDIOC_G_STD:
      *static_cast<v4l2_std_id*>(argument) = camera.standard;
      return camera.standard == 0 ? -ENODATA : 0;
    case VIDIOC_QUERYSTD:
      now_ += camera.sensing;
      *static_cast<v4l2_std_id*>(argument) = camera.sensed;
      return camera.sensed == 0 ? -ENOTTY : 0;
    default: return answer_format(opened, request, argument);
  }
}

int FakeKernel::answer_format(Opened& opened, unsigned long request, void* argument) {
  FakeCamera& camera = *opened.camera;
  switch (request) {
    case VIDIOC_ENUM_FMT: {
      auto& format = *static_cast<v4l2_fmtdesc*>(argument);
      if (format.index >= camera.formats.size()) {
        return -EINVAL;
      }
      format.pixelformat = camera.formats[format.index];
      return 0;
    }
    case VIDIOC_S_FMT: return set_format(opened, *static_cast<v4l2_format*>(argument));
    case VIDIOC_G_FMT: static_cast<v4l2_format*>(argument)->fmt.pix = opened.format; return 0;
    case VIDIOC_S_PARM: {
      const auto& asked = *static_cast<v4l2_streamparm*>(argument);
      if (camera.changes_rate) {
        camera.frame_time = asked.parm.capture.timeperframe;
      }
      return 0;
    }
    case VIDIOC_G_PARM:
      static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = camera.frame_time;
      return 0;
    case VIDIOC_QUERYCTRL: return query_control(camera, *static_cast<v4l2_queryctrl*>(argument));
    case VIDIOC_QUERYMENU: return query_menu(camera, *static_cast<v4l2_querymenu*>(argument));
    case VIDIOC_S_CTRL: return serve_control(camera, true, *static_cast<v4l2_control*>(argument));
    case VIDIOC_G_CTRL: return serve_control(camera, false, *static_cast<v4l2_control*>(argument));
    default: return answer_stream(opened, request, argument);
  }
}

int FakeKernel::answer_stream(Opened& opened, unsigned long request, void* argument) {
  FakeCamera& camera = *opened.camera;
  switch (request) {
    case VIDIOC_SUBSCRIBE_EVENT: {
      const auto& wanted = *static_cast<v4l2_event_subscription*>(argument);
      opened.subscribed.emplace_back(wanted.type, wanted.id);
      return 0;
    }
    case VIDIOC_DQEVENT: {
      if (camera.events.empty()) {
        return -ENOENT;
      }
      auto& event = *static_cast<v4l2_event*>(argument);
      event = camera.events.front();
      camera.events.pop_front();
      event.pending = static_cast<std::uint32_t>(camera.events.size());
      return 0;
    }
    case VIDIOC_REQBUFS:
      return others_stream(opened)
                 ? -EBUSY
                 : give_buffers(opened, *static_cast<v4l2_requestbuffers*>(argument));
    case VIDIOC_QUERYBUF: {
      auto& buffer = *static_cast<v4l2_buffer*>(argument);
      buffer.length = static_cast<std::uint32_t>(opened.buffers[buffer.index].memory.size());
      buffer.m.offset = buffer.index;
      return 0;
    }
    case VIDIOC_QBUF: {
      const std::uint32_t index = static_cast<v4l2_buffer*>(argument)->index;
      if (opened.buffers[index].queued) {
        return -EINVAL;
      }
      opened.buffers[index].queued = true;
      opened.queue.push_back(index);
      return 0;
    }
    case VIDIOC_DQBUF: return dequeue(opened, *static_cast<v4l2_buffer*>(argument));
    case VIDIOC_STREAMON:
      opened.streams = true;
      opened.next = now_ + camera.every;
      return 0;
    case VIDIOC_STREAMOFF: opened.streams = false; return 0;
    default: return -ENOTTY;
  }
}

int FakeKernel::set_format(Opened& opened, v4l2_format& format) const {
  const FakeCamera& camera = *opened.camera;
  v4l2_pix_format& pix = format.fmt.pix;
  const auto has = [](const std::vector<std::uint32_t>& list, std::uint32_t value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  pix.pixelformat = has(camera.formats, pix.pixelformat) ? pix.pixelformat : camera.formats[0];
  pix.field = has(camera.fields, pix.field) ? pix.field : camera.fields[0];
  pix.width = (pix.width + camera.widths_of - 1) / camera.widths_of * camera.widths_of;
  pix.bytesperline = pix.width * bytes_a_pixel(pix.pixelformat) + camera.padding_bytes;
  pix.sizeimage = pix.bytesperline * pix.height;
  opened.format = pix;
  return 0;
}

/// Whoever has a camera's buffers has the camera.
bool FakeKernel::others_stream(const Opened& opened) const {
  return std::any_of(opened_.begin(), opened_.end(), [&](const auto& entry) {
    const Opened& other = entry.second;
    return &other != &opened && other.camera == opened.camera && !other.buffers.empty();
  });
}

int FakeKernel::give_buffers(Opened& opened, v4l2_requestbuffers& wanted) const {
  wanted.count = std::min(wanted.count, opened.camera->most_buffers);
  opened.buffers.assign(wanted.count, {});
  opened.queue.clear();
  opened.queue.reserve(wanted.count);
  opened.done.clear();
  opened.done.reserve(wanted.count);
  for (Buffer& buffer : opened.buffers) {
    buffer.memory.resize(opened.camera->data_offset + opened.format.sizeimage -
                         opened.camera->missing_bytes);
  }
  return 0;
}

int FakeKernel::dequeue(Opened& opened, v4l2_buffer& buffer) {
  if (!opened.streams) {
    return -EINVAL;
  }
  if (opened.done.empty()) {
    return -EAGAIN;
  }
  const std::uint32_t index = opened.done.front();
  opened.done.erase(opened.done.begin());
  opened.buffers[index].queued = false;
  buffer = opened.buffers[index].told;
  return 0;
}

void* FakeKernel::map(int descriptor, std::size_t bytes, std::uint32_t offset) {
  Buffer& buffer = opened_.at(descriptor).buffers.at(offset);
  if (buffer.memory.size() != bytes) {
    return nullptr;
  }
  ++mapped_;
  return buffer.memory.data();
}

void FakeKernel::unmap(void* /*memory*/, std::size_t /*bytes*/) { --mapped_; }

void FakeKernel::expose(Opened& opened) {
  FakeCamera& camera = *opened.camera;
  const bool alternate = opened.format.field == V4L2_FIELD_ALTERNATE;
  v4l2_buffer told{};
  told.flags = camera.stamp_flags;
  told.field = opened.format.field;
  if (alternate) {
    told.field = opened.bottom ? V4L2_FIELD_BOTTOM : V4L2_FIELD_TOP;
  }
  told.sequence = opened.sequence;
  told.bytesused = camera.data_offset + opened.format.sizeimage;
  told.timestamp.tv_sec = opened.next.count() / 1'000'000'000;
  told.timestamp.tv_usec = opened.next.count() % 1'000'000'000 / 1000;
  // Both fields of a frame have one number, as the specification wants it.
  opened.sequence += !alternate || opened.bottom ? 1 : 0;
  opened.bottom = !opened.bottom;
  const std::int64_t number = exposed_++;
  if (opened.queue.empty()) {
    return;
  }
  told.index = opened.queue.front();
  opened.queue.erase(opened.queue.begin());
  Buffer& buffer = opened.buffers[told.index];
  buffer.told = told;
  std::pair<std::uint32_t, std::uint32_t> unwritten;
  if (!camera.unwritten.empty()) {
    unwritten = camera.unwritten.front();
    camera.unwritten.pop_front();
  }
  draw_picture(opened.format, told, std::span(buffer.memory).subspan(camera.data_offset),
               unwritten);
  if (camera.tamper) {
    camera.tamper(number, buffer.told, buffer.memory);
  }
  opened.done.push_back(told.index);
}

int FakeKernel::poll(int descriptor, short events, int timeout_ms) {
  const auto at = opened_.find(descriptor);
  if (at == opened_.end()) {
    return POLLNVAL;
  }
  Opened& opened = at->second;
  if (!plugged(opened)) {
    return POLLERR | POLLHUP;
  }
  FakeCamera& camera = *opened.camera;
  if (!camera.poll_results.empty()) {
    const int result = camera.poll_results.front();
    camera.poll_results.pop_front();
    return result;
  }
  if (!opened.streams) {
    return POLLERR;
  }
  if (!camera.events.empty() && (events & POLLPRI) != 0) {
    return POLLPRI;
  }
  const core::FieldTime until = now_ + std::chrono::milliseconds(timeout_ms);
  // What was exposed while nobody waited came then.
  while (camera.every > core::FieldTime{0} &&
         (opened.next <= now_ || (opened.done.empty() && opened.next <= until))) {
    now_ = std::max(now_, opened.next);
    expose(opened);
    opened.next += camera.every;
  }
  if (opened.done.empty()) {
    now_ = until;
    return 0;
  }
  return POLLIN;
}

}  // namespace tubesight::tests
