#include "drivers/v4l2/buffer_ring.h"

#include <cerrno>
#include <cstring>

#include <linux/videodev2.h>

namespace tubesight::drivers::v4l2 {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// One that is lent, and one that the driver fills.
constexpr std::uint32_t kFewest = 2;

}  // namespace

Result<void> BufferRing::open(int descriptor, const AgreedFormat& agreed, std::int32_t width_px,
                              std::string& message) {
  descriptor_ = descriptor;
  api_ = agreed.api;
  picture_bytes_ = agreed.bytes;
  marks_.begin(agreed, width_px);
  const auto fail = [&](const char* what, int status) -> Result<void> {
    message = std::string(what) + ": " + std::strerror(-status);
    close();
    return Unexpected(Error::kIo);
  };
  v4l2_requestbuffers wanted{};
  wanted.count = kBuffers;
  wanted.type = buffer_type_of(api_);
  wanted.memory = V4L2_MEMORY_MMAP;
  if (const int status = kernel_->ioctl(descriptor, VIDIOC_REQBUFS, &wanted); status != 0) {
    return status == -EBUSY
               ? fail("is busy: another program takes its pictures, expected it free", status)
               : fail("gives no buffers", status);
  }
  if (wanted.count < kFewest || wanted.count > static_cast<std::uint32_t>(kMostBuffers)) {
    message = "gives " + std::to_string(wanted.count) + " buffers, expected 2 to 32";
    close();
    return Unexpected(Error::kIo);
  }
  if (const auto mapped = map_all(wanted.count, message); !mapped) {
    close();
    return mapped;
  }
  for (std::uint32_t i = 0; i < wanted.count; ++i) {
    if (const int status = queue(i); status != 0) {
      return fail("does not take its buffers", status);
    }
  }
  auto type = static_cast<int>(buffer_type_of(api_));
  if (const int status = kernel_->ioctl(descriptor, VIDIOC_STREAMON, &type); status != 0) {
    return fail("does not start to stream", status);
  }
  return {};
}

Result<void> BufferRing::map_all(std::uint32_t count, std::string& message) {
  for (std::uint32_t i = 0; i < count; ++i) {
    BufferCall call(api_, i);
    if (const int status = kernel_->ioctl(descriptor_, VIDIOC_QUERYBUF, call.argument());
        status != 0) {
      message = std::string("does not describe its buffers: ") + std::strerror(-status);
      return Unexpected(Error::kIo);
    }
    const v4l2_buffer told = call.answer();
    if (told.length < picture_bytes_) {
      message = "gives buffers of " + std::to_string(told.length) + " bytes, expected " +
                std::to_string(picture_bytes_) + " for the format that it agreed to";
      return Unexpected(Error::kIo);
    }
    void* const memory = kernel_->map(descriptor_, told.length, told.m.offset);
    if (memory == nullptr) {
      message = "cannot share the memory of its buffers";
      return Unexpected(Error::kIo);
    }
    static_cast<void>(buffers_.try_push_back({memory, told.length, 0, false, false}));  // counted
  }
  return {};
}

void BufferRing::close() {
  if (descriptor_ < 0) {
    return;
  }
  auto type = static_cast<int>(buffer_type_of(api_));
  static_cast<void>(kernel_->ioctl(descriptor_, VIDIOC_STREAMOFF, &type));
  for (const Mapped& buffer : buffers_) {
    kernel_->unmap(buffer.memory, buffer.bytes);
  }
  buffers_.clear();
  v4l2_requestbuffers none{};
  none.type = buffer_type_of(api_);
  none.memory = V4L2_MEMORY_MMAP;
  static_cast<void>(kernel_->ioctl(descriptor_, VIDIOC_REQBUFS, &none));
  descriptor_ = -1;
}

int BufferRing::take(v4l2_buffer& buffer) {
  BufferCall call(api_, 0);
  const int status = kernel_->ioctl(descriptor_, VIDIOC_DQBUF, call.argument());
  if (status != 0) {
    return status;
  }
  buffer = call.answer();
  if (buffer.index >= static_cast<std::uint32_t>(buffers_.size()) ||
      !buffers_[static_cast<std::int32_t>(buffer.index)].queued) {
    return -EBADMSG;  // one that it did not have
  }
  Mapped& mapped = buffers_[static_cast<std::int32_t>(buffer.index)];
  mapped.queued = false;
  mapped.offset = call.data_offset();
  if (mapped.offset > mapped.bytes - picture_bytes_) {
    mapped.offset = 0;
    buffer.bytesused = 0;
  }
  return 0;
}

int BufferRing::queue(std::uint32_t index) {
  Mapped& mapped = buffers_[static_cast<std::int32_t>(index)];
  marks_.lay(static_cast<std::byte*>(mapped.memory) + mapped.offset);
  BufferCall call(api_, index);
  const int status = kernel_->ioctl(descriptor_, VIDIOC_QBUF, call.argument());
  mapped.queued = status == 0;
  mapped.owed = status != 0;
  refusals_ += status != 0 ? 1 : 0;
  return status;
}

void BufferRing::give_back(std::uint32_t index) { static_cast<void>(queue(index)); }

int BufferRing::queue_owed() {
  int refused = 0;
  for (std::int32_t i = 0; i < buffers_.size(); ++i) {
    if (buffers_[i].owed) {
      const int status = queue(static_cast<std::uint32_t>(i));
      refused = status != 0 ? status : refused;
    }
  }
  return refused;
}

const std::byte* BufferRing::memory(std::uint32_t index) const {
  const Mapped& mapped = buffers_[static_cast<std::int32_t>(index)];
  return static_cast<const std::byte*>(mapped.memory) + mapped.offset;
}

}  // namespace tubesight::drivers::v4l2
