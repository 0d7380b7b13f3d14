#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/field.h"
#include "core/base/result.h"
#include "core/base/settings.h"

namespace tubesight::board {

/// How much the recorder keeps.
struct RecorderSettings {
  std::int32_t memory_mb = 64;     ///< of 2^20 bytes, 4 to 65536
  std::int32_t fields_after = 60;  ///< that a recording goes on after what it is kept for
  bool on_disagreement = true;     ///< records by itself when a claim is contradicted
  bool on_track_lost = true;       ///< records by itself when the track is lost
};

/// A field in the recorder's memory; its pixels stand elsewhere.
struct KeptField {
  core::Field field;
  std::int32_t first_event = 0;  ///< place of its first event among those of its segment
  std::int32_t events = 0;
};

/// How the recorder's memory is divided.
struct RecorderMemory {
  std::uint32_t segments = 0;
  std::int32_t fields_a_segment = 0;
  std::int32_t field_bytes = 0;  ///< pixels of a field

  /// Fields that a recording has at most: a quarter of the segments is for going on meanwhile.
  [[nodiscard]] std::int32_t capacity_fields() const {
    return fields_a_segment * static_cast<std::int32_t>(segments - segments / 4);
  }
};

/// Of segments, each with the session's state before its first field.
inline constexpr std::uint32_t kMostSegments = 16;

/// Divides the memory of the settings for fields of this camera and states of `state_bytes`.
///
/// Errors: kOutOfRange the memory does not hold eight segments of 16 fields, or `fields_after` is
/// below 0 or over half of capacity_fields().
[[nodiscard]] core::Result<RecorderMemory> divide_memory(const RecorderSettings& settings,
                                                         const core::CameraSettings& camera,
                                                         std::size_t state_bytes);

}  // namespace tubesight::board
