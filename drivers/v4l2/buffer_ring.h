#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/result.h"
#include "core/base/static_vector.h"
#include "drivers/v4l2/camera_setup.h"
#include "drivers/v4l2/capture_api.h"
#include "drivers/v4l2/kernel.h"
#include "drivers/v4l2/write_marks.h"

struct v4l2_buffer;

namespace tubesight::drivers::v4l2 {

/// The buffers that a camera's driver and we pass to and fro. No heap after open().
class BufferRing {
 public:
  /// Wanted of the driver: at 30 frames a second they bridge 200 ms in which nobody takes any.
  static constexpr std::uint32_t kBuffers = 6;

  explicit BufferRing(Kernel& kernel) : kernel_(&kernel) {}

  /// Obtains, maps and queues the buffers for pictures of this format and width, and starts the
  /// stream. After an error the ring is closed. Errors: kIo, with `message`.
  [[nodiscard]] core::Result<void> open(int descriptor, const AgreedFormat& agreed,
                                        std::int32_t width_px, std::string& message);

  /// Stops the stream and gives all memory back, also where the device is gone.
  void close();

  /// Takes a filled buffer; gives 0 or -errno. Of planes, as where there are none; a picture that
  /// would not fit behind its offset is told as one of no bytes.
  [[nodiscard]] int take(v4l2_buffer& buffer);

  /// Gives one back to the driver. What it refuses is tried again by queue_owed().
  void give_back(std::uint32_t index);

  /// Tries again to give back what the driver refused; gives 0, or -errno of a refusal.
  [[nodiscard]] int queue_owed();

  /// Where the picture of a buffer that was taken begins.
  [[nodiscard]] const std::byte* memory(std::uint32_t index) const;
  /// Whether the driver left lines of that field as they were before it got the buffer.
  [[nodiscard]] bool unwritten(std::uint32_t index, const FieldLines& field) const {
    return marks_.left(memory(index), field);
  }
  [[nodiscard]] std::int64_t refusals() const { return refusals_; }

 private:
  /// A driver may give more than it was asked for.
  static constexpr std::int32_t kMostBuffers = 32;
  struct Mapped {
    void* memory = nullptr;
    std::size_t bytes = 0;
    std::size_t offset = 0;  ///< of the picture in it
    bool queued = false;
    bool owed = false;
  };

  core::Result<void> map_all(std::uint32_t count, std::string& message);
  int queue(std::uint32_t index);

  Kernel* kernel_;
  int descriptor_ = -1;
  CaptureApi api_ = CaptureApi::kWhole;
  std::size_t picture_bytes_ = 0;
  WriteMarks marks_;
  core::StaticVector<Mapped, kMostBuffers> buffers_;
  std::int64_t refusals_ = 0;
};

}  // namespace tubesight::drivers::v4l2
