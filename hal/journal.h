#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/field.h"
#include "core/base/result.h"
#include "core/base/tube_address.h"

namespace tubesight::hal {

/// What a row of the journal tells; the column `kind` has its word.
enum class JournalKind : std::uint8_t {
  kBegin,            ///< the journal's first row, made by the store itself
  kBoot,             ///< the box's program started, or ended
  kVerification,     ///< claims of one stop with one verdict
  kStart,            ///< a start or restart, and who confirmed it
  kLoss,             ///< the track was lost
  kPose,             ///< a pose measured, with the correction that follows
  kFault,            ///< of the lamp or the camera; or that it is over
  kSetting,          ///< a setting changed
  kAcknowledgement,  ///< somebody has seen a disagreement
};

/// The word of a kind in files.
[[nodiscard]] constexpr std::string_view name_of(JournalKind kind) {
  switch (kind) {
    case JournalKind::kBegin: return "begin";
    case JournalKind::kBoot: return "boot";
    case JournalKind::kVerification: return "verification";
    case JournalKind::kStart: return "start";
    case JournalKind::kLoss: return "loss";
    case JournalKind::kPose: return "pose";
    case JournalKind::kFault: return "fault";
    case JournalKind::kSetting: return "setting";
    case JournalKind::kAcknowledgement: return "acknowledgement";
  }
  return {};
}

/// When a row was made. The monotonic clock orders rows of one boot; the wall clock is a hint, as
/// it may have been wrong or set in between.
struct JournalTime {
  std::string_view boot_id;                       ///< the kernel's; empty: not known
  std::chrono::microseconds monotonic{0};         ///< since that boot
  std::optional<std::chrono::microseconds> wall;  ///< since 1970-01-01 UTC, without leap seconds
  std::optional<std::chrono::microseconds> wall_doubt;  ///< how far it may be off; empty: unknown
};

/// What was seen at the instant that a row is about; empty: not known.
struct JournalSighting {
  std::optional<core::TubeAddress> tube;         ///< above the guidetube
  std::optional<std::int32_t> offset_um;         ///< of the guidetube's axis from its centre
  std::optional<std::int32_t> height_um;         ///< tip below the plane of the tube-ends
  std::optional<std::int32_t> margin_permyriad;  ///< from the rounding limit, 1/10000 sigma
  std::optional<std::int32_t> residual_millipx;  ///< RMS of the tube-ends used, 1/1000 px
  std::optional<std::int64_t> field;             ///< its number
  std::optional<core::FieldTime> field_time;     ///< its mid-exposure
  std::string_view
      field_digest;  ///< SHA-256 of its pixels, 64 hexadecimal digits; empty: not known
};

/// One row. What is empty is written as "not known", and never as a number.
///
/// Texts are UTF-8; control characters in them become '?'.
struct JournalRow {
  JournalKind kind = JournalKind::kBoot;
  JournalTime time;
  std::string_view version;              ///< of the program that saw it
  std::string_view origin;               ///< who: "robot", "operator", "box"
  std::optional<std::int64_t> event_id;  ///< of the event that it answers
  std::optional<core::TubeAddress> claimed;
  std::string_view
      verdict;  ///< "confirmed", "contradicted", "unknown"; of a start "taken", "refused"
  std::string_view reason;  ///< why, a word of docs/messages.md
  JournalSighting seen;
  std::string_view camera_id;  ///< of the calibrations in force
  std::string_view tool_id;
  std::string_view base_id;
  std::optional<std::chrono::microseconds> first;  ///< of claims that are one row, monotonic
  std::optional<std::chrono::microseconds> last;
  std::int64_t count = 1;              ///< how many events are this row
  std::string_view detail;             ///< the rest, "key=value" words
  std::span<const std::byte> picture;  ///< JPEG; empty: none
};

/// Keeps what was verified, row after row; nothing is ever changed.
///
/// Every call may take as long as the disk; one thread calls all functions, and it is never the one
/// that tracks.
class Journal {
 public:
  /// Appends rows in their order. When this returns all of them are on the disk, whatever the power
  /// does from then on; the number of the last. After an error none of them was told safe.
  ///
  /// Errors: kIo the disk is full, read-only or gone, kNotReady not open; the journal is closed
  /// then, and whoever owns it opens it again. kInvalidArgument no rows.
  [[nodiscard]] virtual core::Result<std::int64_t> append(std::span<const JournalRow> rows) = 0;

  /// Signs everything up to the last row, where a key is there and something is unsigned. Errors as
  /// append().
  [[nodiscard]] virtual core::Result<void> sign() = 0;

  /// Number of the last row that is safe on the disk, counted from 1; 0: there is none.
  [[nodiscard]] virtual std::int64_t last_safe() const = 0;

 protected:
  ~Journal() = default;
};

}  // namespace tubesight::hal
