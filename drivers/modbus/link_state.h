#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/field.h"
#include "core/base/sighting.h"
#include "drivers/modbus/zone_corrections.h"

namespace tubesight::drivers {

/// What a box says of itself to the robot; of what is left empty it says "unknown".
struct LinkIdentity {
  std::int32_t product_version = 0;  ///< 10000 * major + 100 * minor + patch
  /// Differs from one start of the box to the next (a boot count, or dice); never 0.
  std::int32_t boot = 1;
  std::optional<std::int32_t> camera_id;  ///< identities of the calibrations
  std::optional<std::int32_t> tool_id;
  std::optional<std::int32_t> base_id;
  /// Of the settings: a start over the link that names others is refused.
  std::array<std::int32_t, 4> window_px{};
  std::array<double, 2> optimum_px{};
  /// Who knows the corrections by zones, and outlives the link; null: nobody.
  const ZoneCorrections* zones = nullptr;
};

enum class Health : std::uint8_t { kUnknown, kWell, kFailed };

/// What the assembly knows of the box's parts, for the robot to read.
struct LinkHealth {
  Health camera = Health::kUnknown;
  Health lamp = Health::kUnknown;
  bool lamp_dimmed = false;         ///< somebody sets the lamp's level
  bool lamp_automatic = false;      ///< the level is the box's own, which follows the picture
  std::int32_t lamp_permille = -1;  ///< in force; below 0: not known
  std::int64_t fields = -1;         ///< counters of the box; below 0: not known
  std::int64_t fields_missing = -1;
  std::int64_t fields_late = -1;
  std::int64_t pairs_written = -1;  ///< below 0: the box keeps none
  std::int64_t pairs_lost = -1;
};

/// What the box has found of itself.
struct LinkSelfTest {
  Health verdict = Health::kUnknown;  ///< kUnknown: it has not finished
  std::uint16_t bad = 0;              ///< SelfTestBit
  std::uint16_t absent = 0;           ///< the same
  std::int64_t boot = 0;              ///< starts of the machine; 0: not known
  std::int64_t start = 0;             ///< of the program since then; 0: not known
  std::int64_t up_s = 0;
};

/// What the robot reads of the journal.
struct LinkJournal {
  std::int32_t state = 0;  ///< kJournalNone, kJournalWriting or kJournalStanding
  std::int64_t safe = 0;   ///< number of the last row that is safe on the disk
  std::int64_t waiting = 0;
  std::int64_t lost = 0;
};

/// What has come over the line so far, and how long the box took.
struct LinkCounters {
  std::uint32_t requests = 0;
  std::uint32_t answers = 0;
  std::uint32_t exceptions = 0;
  std::uint32_t crc_errors = 0;
  std::uint32_t cut_frames = 0;
  std::uint32_t other_units = 0;
  std::uint32_t broadcasts = 0;
  std::uint32_t stray_bytes = 0;
  std::uint32_t dropped_events = 0;
  std::uint32_t late_claims = 0;
  std::uint32_t abandoned_answers = 0;
  std::uint32_t reopenings = 0;
  std::uint32_t response_last_us = 0;
  std::uint32_t response_worst_us = 0;
  std::uint32_t claim_response_worst_us = 0;
};

/// What all dialogues of a link show alike. One thread.
struct LinkState {
  LinkIdentity identity;
  std::optional<core::Sighting> sighting;  ///< the latest
  std::uint32_t sequence = 0;              ///< of that; 0: none yet
  LinkHealth health;
  LinkSelfTest self_test;
  LinkJournal journal;
  LinkCounters counters;
};

}  // namespace tubesight::drivers
