#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "board/visionbox/boot_count.h"
#include "board/visionbox/camera.h"
#include "board/visionbox/field_source.h"
#include "board/visionbox/golden_recording.h"
#include "board/visionbox/journal_writer.h"
#include "board/visionbox/kept_link.h"
#include "board/visionbox/lamp_keeper.h"
#include "board/visionbox/pairs_writer.h"
#include "board/visionbox/recording_writer.h"
#include "board/visionbox/supervisor.h"
#include "board/visionbox/tracking_thread.h"
#include "drivers/modbus/register_codes.h"

namespace tubesight::board {

/// How the box is doing, for whoever asks.
struct BoxReport {
  bool turned = false;  ///< `tracking` is there
  TrackingStatus tracking;
  MonotonicTime up{0};        ///< since the box was started
  double fields_per_s = 0.0;  ///< over the last second or so, those that came

  std::string_view source_kind;
  SourceState source = SourceState::kOpening;
  core::FieldTime span{0};  ///< from one field to the next, as the source says
  std::int64_t passes = 0;
  std::int64_t failures = 0;
  std::int64_t made_late = 0;          ///< fields that the source made after their instant
  std::optional<CameraStatus> camera;  ///< empty: the source is none
  std::optional<LampReport> lamp;      ///< empty: nobody dims it, or a played one

  std::string_view link_kind;
  LinkReport link;
  RecorderReport recorder;
  PairsReport pairs;
  JournalReport journal;
  std::int32_t zones = 0;     ///< places that corrections were seen at
  bool zones_known = false;   ///< between those, too, by now
  std::int32_t priority = 0;  ///< wanted
  bool memory_locked = false;
  bool lock_wanted = false;
  double deadline_ms = 0.0;
  std::int64_t poses_passed_over = 0;
  SupervisionReport supervision;
  bool pattern_wanted = false;  ///< the picture is to follow the lamp's pattern
  GoldenResult golden;
  bool self_test_finished = false;  ///< each part has had its time since the start
  BootCount boots;
};

/// The answer to `status`: one JSON object in a line, with the same for a person under `text`.
[[nodiscard]] std::string status_answer(const BoxReport& report);

/// One thing that the self-test looks at.
struct SelfTestRow {
  enum class Verdict : std::uint8_t { kGood, kBad, kAbsent };
  drivers::SelfTestBit bit = drivers::SelfTestBit::kNumbers;  ///< that the robot reads
  std::string_view what;
  Verdict verdict = Verdict::kGood;
  std::string words;
};
[[nodiscard]] std::vector<SelfTestRow> self_test(const BoxReport& report);

/// The names of those that are bad, "disk, lamp"; empty: none is.
[[nodiscard]] std::string bad_rows(const std::vector<SelfTestRow>& rows);

/// The answer to `self-test`; `ok` is false where one is bad.
[[nodiscard]] std::string self_test_answer(const BoxReport& report);

}  // namespace tubesight::board
