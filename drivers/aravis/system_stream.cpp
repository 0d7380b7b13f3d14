// The half of SystemDevice that streams.

#include <algorithm>
#include <cerrno>
#include <ctime>

#include <sched.h>

#include "drivers/aravis/refusal.h"
#include "drivers/aravis/system_device.h"

namespace tubesight::drivers::aravis {
namespace {

using core::FieldTime;

/// How long the library waits for the rest of a picture, where it asks for lost packets again.
constexpr FieldTime kRetentionWithResend = std::chrono::milliseconds(100);
/// Where it does not: two pictures on nothing will come any more, but a slow host needs its time.
constexpr FieldTime kShortestRetention = std::chrono::milliseconds(20);

/// What the kernel may keep of what the library's thread has not read yet. It counts a packet's own
/// memory too, up to twice its bytes, and gives no more than net.core.rmem_max.
constexpr std::size_t kPicturesInSocket = 4;
constexpr std::size_t kMostInSocket_bytes = std::size_t{32} << 20;

std::intptr_t number_of(const Functions& arv, ArvBuffer* buffer) {
  return reinterpret_cast<std::intptr_t>(arv.arv_buffer_get_user_data(buffer));
}

}  // namespace

ArvStream* SystemDevice::create_stream(const StreamPlan& plan, std::string& why) {
  Refusal refusal(*arv_);
  arv_->arv_camera_set_acquisition_mode(camera_, ARV_ACQUISITION_MODE_CONTINUOUS, refusal.out());
  ArvStream* const stream =
      arv_->arv_camera_create_stream(camera_, &SystemDevice::on_stream, this, refusal.out());
  if (stream == nullptr) {
    static_cast<void>(refusal.said(why));
    return nullptr;
  }
  if (has_packets()) {
    const FieldTime retention =
        plan.resend ? kRetentionWithResend : std::max(2 * plan.frame, kShortestRetention);
    const auto retention_us = static_cast<guint>(
        std::chrono::duration_cast<std::chrono::microseconds>(retention).count());
    const auto socket_bytes = static_cast<gint>(
        std::min<std::size_t>(kPicturesInSocket * plan.buffer_bytes, kMostInSocket_bytes));
    arv_->g_object_set(stream, "frame-retention", retention_us, "socket-buffer",
                       ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size", socket_bytes,
                       nullptr);
    // Cameras that cannot resend have been found out by the library; it knows better than to ask.
    if (!plan.resend) {
      arv_->g_object_set(stream, "packet-resend", ARV_GV_STREAM_PACKET_RESEND_NEVER, nullptr);
    }
  }
  return stream;
}

bool SystemDevice::begin(const StreamPlan& plan, const hal::Clock& clock, std::string& why) {
  clock_ = &clock;
  buffers_ = plan.buffers;
  priority_ = plan.priority;
  running_ = false;
  stream_ = create_stream(plan, why);
  if (stream_ == nullptr) {
    why = why.empty() ? "no stream" : why;
    return false;
  }
  for (std::int32_t i = 0; i < buffers_; ++i) {
    const auto index = static_cast<std::size_t>(i);
    buffer_[index] =
        arv_->arv_buffer_new_full(plan.buffer_bytes, plan.memory.data() + index * plan.buffer_bytes,
                                  reinterpret_cast<void*>(static_cast<std::intptr_t>(i)), nullptr);
    ours_[index] = true;
    push(i);
  }
  running_ = true;
  Refusal refusal(*arv_);
  arv_->arv_camera_start_acquisition(camera_, refusal.out());
  if (refusal.said(why)) {
    end(false);
    return false;
  }
  return true;
}

void SystemDevice::end(bool gone) {
  if (stream_ == nullptr) {
    return;
  }
  if (!gone) {
    quieten();
  }
  running_ = false;
  // Joins the library's thread; what is in its queues goes with it.
  arv_->g_object_unref(stream_);
  stream_ = nullptr;
  for (std::size_t i = 0; i < static_cast<std::size_t>(buffers_); ++i) {
    if (ours_[i]) {
      arv_->g_object_unref(buffer_[i]);
    }
    ours_[i] = false;
  }
  Picture picture;
  while (arrived_.try_pop(picture)) {
  }
  std::int32_t buffer = 0;
  while (returned_.try_pop(buffer)) {
  }
}

/// To the library; `queues_` is held, or nobody streams yet.
void SystemDevice::push(std::int32_t buffer) {
  const auto index = static_cast<std::size_t>(buffer);
  ours_[index] = false;
  arv_->arv_stream_push_buffer(stream_, buffer_[index]);
}

void SystemDevice::look_after() {
  if (!running_) {
    return;
  }
  const std::scoped_lock lock(queues_);
  std::int32_t buffer = 0;
  while (returned_.try_pop(buffer)) {
    push(buffer);
  }
}

void SystemDevice::on_control_lost(ArvDevice* /*device*/, void* self) {
  auto* const device = static_cast<SystemDevice*>(self);
  device->control_lost_ = true;
  sem_post(&device->news_);
}

/// On the library's thread. Its first call comes before the stream is known, and brings no buffer.
void SystemDevice::on_stream(void* self, ArvStreamCallbackType what, ArvBuffer* /*buffer*/) {
  auto* const device = static_cast<SystemDevice*>(self);
  if (what == ARV_STREAM_CALLBACK_TYPE_INIT && device->priority_ > 0) {
    // Where the system refuses, the tracking thread's own request has said so already.
    sched_param wanted{};
    wanted.sched_priority = device->priority_;
    static_cast<void>(sched_setscheduler(0, SCHED_FIFO, &wanted));
  }
  if (what != ARV_STREAM_CALLBACK_TYPE_BUFFER_DONE || !device->running_) {
    return;
  }
  device->look_after();
  while (ArvBuffer* const filled = device->arv_->arv_stream_try_pop_buffer(device->stream_)) {
    device->pass_on(filled);
  }
}

void SystemDevice::pass_on(ArvBuffer* buffer) {
  Picture picture;
  picture.arrival = clock_->now();
  picture.buffer = static_cast<std::int32_t>(number_of(*arv_, buffer));
  const ArvBufferPayloadType payload = arv_->arv_buffer_get_payload_type(buffer);
  const bool image = payload == ARV_BUFFER_PAYLOAD_TYPE_IMAGE ||
                     payload == ARV_BUFFER_PAYLOAD_TYPE_EXTENDED_CHUNK_DATA;
  picture.complete = arv_->arv_buffer_get_status(buffer) == ARV_BUFFER_STATUS_SUCCESS && image;
  picture.frame_id = arv_->arv_buffer_get_frame_id(buffer);
  picture.stamp_ns = arv_->arv_buffer_get_timestamp(buffer);
  if (picture.complete) {
    gint beside = 0;
    gint below = 0;
    arv_->arv_buffer_get_image_padding(buffer, &beside, &below);
    picture.padding_bytes = beside;
    picture.width_px = arv_->arv_buffer_get_image_width(buffer);
    picture.height_px = arv_->arv_buffer_get_image_height(buffer);
    picture.format = arv_->arv_buffer_get_image_pixel_format(buffer);
    static_cast<void>(arv_->arv_buffer_get_image_data(buffer, &picture.bytes));
  }
  const std::scoped_lock lock(queues_);
  ours_[static_cast<std::size_t>(picture.buffer)] = true;
  if (!arrived_.try_push(picture)) {
    push(picture.buffer);  // there are no more buffers than places: it does not happen
    return;
  }
  sem_post(&news_);
}

StreamCounts SystemDevice::counts() {
  StreamCounts counts;
  if (stream_ == nullptr) {
    return counts;
  }
  guint64 completed = 0;
  guint64 failures = 0;
  guint64 underruns = 0;
  arv_->arv_stream_get_statistics(stream_, &completed, &failures, &underruns);
  counts.underruns = static_cast<std::int64_t>(underruns);
  if (has_packets()) {
    const auto info = [this](const char* name) {
      return static_cast<std::int64_t>(arv_->arv_stream_get_info_uint64_by_name(stream_, name));
    };
    counts.resent_packets = info("n_resent_packets");
    counts.missing_packets = info("n_missing_packets");
  }
  return counts;
}

Taken SystemDevice::take(std::chrono::milliseconds timeout, Picture& picture) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const std::int64_t until_ns = (clock_->now() + timeout).count();
  const timespec until{static_cast<std::time_t>(until_ns / kSecond_ns),
                       static_cast<long>(until_ns % kSecond_ns)};
  while (!arrived_.try_pop(picture)) {
    if (control_lost_) {
      return Taken::kControlLost;
    }
    if (sem_clockwait(&news_, CLOCK_MONOTONIC, &until) != 0 && errno != EINTR) {
      return arrived_.try_pop(picture) ? Taken::kPicture : Taken::kNothing;
    }
  }
  return Taken::kPicture;
}

void SystemDevice::give_back(std::int32_t buffer) {
  // There are as many places as buffers.
  static_cast<void>(returned_.try_push(buffer));
}

}  // namespace tubesight::drivers::aravis
