#include "board/box/recorder_memory.h"

#include <algorithm>

#include "core/base/event.h"

namespace tubesight::board {
namespace {

constexpr std::int32_t kFewestFields = 16;  // in a segment; below that the states weigh too much
constexpr std::uint32_t kFewestSegments = 8;

}  // namespace

core::Result<RecorderMemory> divide_memory(const RecorderSettings& settings,
                                           const core::CameraSettings& camera,
                                           std::size_t state_bytes) {
  const std::int32_t lines =
      camera.scan == core::Scan::kProgressive ? camera.height_px : (camera.height_px + 1) / 2;
  RecorderMemory memory;
  memory.field_bytes = lines * camera.width_px;
  const std::int64_t a_field = memory.field_bytes + static_cast<std::int64_t>(sizeof(KeptField)) +
                               core::kMaxEventsPerField * std::int64_t{sizeof(core::Event)};
  const std::int64_t bytes = std::int64_t{settings.memory_mb} << 20;
  const auto fields_in = [&](std::uint32_t parts) {
    const std::int64_t room = bytes / parts - static_cast<std::int64_t>(state_bytes);
    return static_cast<std::int32_t>(std::min<std::int64_t>(room / a_field, 1 << 16)) / 2 * 2;
  };
  memory.segments = fields_in(kMostSegments) < kFewestFields ? kFewestSegments : kMostSegments;
  memory.fields_a_segment = fields_in(memory.segments);
  if (memory.fields_a_segment < kFewestFields || settings.fields_after < 0 ||
      settings.fields_after > memory.capacity_fields() / 2) {
    return core::Unexpected(core::Error::kOutOfRange);
  }
  return memory;
}

}  // namespace tubesight::board
