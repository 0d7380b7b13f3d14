#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/result.h"
#include "core/base/settings.h"

namespace tubesight::hal {

/// Why a recording is kept.
enum class RecordingReason : std::uint8_t {
  kDisagreement,  ///< the robot claimed another tube than the box vouches for
  kTrackLost,     ///< the box lost its track
  kCommand,       ///< somebody asked for it
};

/// What a store is told before a recording's first field.
struct RecordingHead {
  RecordingReason reason = RecordingReason::kCommand;
  std::int64_t field = 0;      ///< number of the field that it is kept for
  core::FieldTime at{0};       ///< mid-exposure of that
  std::int32_t width_px = 0;   ///< of the full frame
  std::int32_t height_px = 0;  ///< of the full frame
  core::Scan scan = core::Scan::kEvenFirst;
  std::int64_t fields = 0;           ///< that will be added
  std::span<const std::byte> state;  ///< of the session before the first; valid during begin()
};

/// Keeps recordings, one after the other: a folder of a disk.
///
/// A recording is there whole after finish(), or not at all. Every call may take as long as the
/// disk; one thread calls all functions, and it is never the one that tracks.
class RecordingStore {
 public:
  /// Begins a recording and makes room for it. What an earlier begin() left unfinished is given up.
  ///
  /// Errors, after which nothing is begun: kOutOfRange the recording is larger than all that the
  /// store may hold, kIo no place to write.
  [[nodiscard]] virtual core::Result<void> begin(const RecordingHead& head) = 0;

  /// Appends what one step was given: its field, and its events in their order. The pixels of a
  /// missing field are not read. Errors: kIo the disk is full, say; kNotReady nothing is begun. The
  /// recording is then given up.
  [[nodiscard]] virtual core::Result<void> add(const core::Field& field,
                                               std::span<const core::Event> events) = 0;

  /// Puts the recording in its place. Errors as add().
  [[nodiscard]] virtual core::Result<void> finish() = 0;

 protected:
  ~RecordingStore() = default;
};

}  // namespace tubesight::hal
