#include "board/visionbox/journal_line.h"

#include <chrono>

#include "board/box/row_column_text.h"
#include "core/base/names.h"
#include "core/base/words.h"

namespace tubesight::board {
namespace {

using std::chrono::duration_cast;
using std::chrono::microseconds;

std::string word(std::string_view key, std::int64_t value) {
  return detail_word(key, std::to_string(value));
}

hal::JournalSighting seen_of(const core::Sighting& sighting) {
  constexpr std::int32_t kQ8 = 256;
  hal::JournalSighting seen;
  seen.field = sighting.field;
  seen.field_time = sighting.time;
  if (sighting.tool_known) {
    seen.tube = sighting.tool;
    seen.offset_um = sighting.offset_um_q8 / kQ8;
  }
  if (sighting.axis_known) {
    seen.height_um = sighting.height_um_q8 / kQ8;
  }
  if (sighting.margin_known) {
    seen.margin_permyriad = sighting.margin_permyriad;
  }
  if (sighting.judged) {
    seen.residual_millipx =
        static_cast<std::int32_t>(std::int64_t{sighting.residual_px_q16} * 1000 / 65536);
  }
  return seen;
}

void tell_claim(const JournalEntry& entry, core::FieldTime shift, JournalLine& line) {
  const JournalNote& note = entry.note;
  line.kind = hal::JournalKind::kVerification;
  line.event_id = note.id;
  line.claimed = note.claim.claimed;
  line.verdict = core::name_of(note.claim.verdict);
  if (note.claim.verdict == core::ClaimVerdict::kUnknown) {
    line.reason = core::name_of(note.claim.doubt);
  } else {
    line.seen.tube = note.claim.tube;
  }
  line.first = duration_cast<microseconds>(entry.first + shift);
  line.last = duration_cast<microseconds>(entry.last + shift);
  line.count = entry.count;
  line.detail = word("stop", entry.stop) + " part=";
  switch (entry.part) {
    case JournalEntry::Part::kFirst: line.detail += "first"; break;
    case JournalEntry::Part::kOn: line.detail += "on"; break;
    case JournalEntry::Part::kEnd: line.detail += "end"; break;
  }
  if (note.seen_known) {
    line.detail += " " + detail_word("state", core::name_of(note.seen.state));
  }
}

void tell_start(const JournalNote& note, const std::string& who, JournalLine& line) {
  line.kind = hal::JournalKind::kStart;
  line.event_id = note.id;
  const bool taken = note.started.refusal == core::StartRefusal::kNone;
  line.verdict = taken ? "taken" : "refused";
  line.reason = taken ? std::string_view() : core::name_of(note.started.refusal);
  const bool robot = note.origin == core::EventOrigin::kRobot;
  line.detail = detail_word("by", !who.empty() ? who : robot ? "robot" : "control");
  std::string tubes;
  for (const core::StartPoint& point : note.start.tubes) {
    tubes += (tubes.empty() ? "" : ";") + row_column_text(point.address);
  }
  if (!note.start.tubes.empty()) {
    line.claimed = note.start.tubes[0].address;
    line.detail += " " + detail_word("tubes", tubes);
  }
  line.detail += note.start.confirmed ? " confirmed=yes" : "";
}

void tell_pose(const JournalNote& note, JournalLine& line) {
  line.kind = hal::JournalKind::kPose;
  line.event_id = note.id;
  line.verdict = core::name_of(note.pose.verdict);
  const core::PoseResult& pose = note.pose.pose;
  if (note.pose.verdict == core::PoseVerdict::kRefused) {
    line.reason = core::name_of(pose.reason);
    return;
  }
  line.detail = word("x_nm", pose.position_nm[0]) + " " + word("y_nm", pose.position_nm[1]) + " " +
                word("z_nm", pose.position_nm[2]) + " " + word("alpha_ndeg", pose.angles_ndeg[0]) +
                " " + word("beta_ndeg", pose.angles_ndeg[1]) + " " +
                word("gamma_ndeg", pose.angles_ndeg[2]) + " " + word("tubes", pose.tubes);
  const core::Sighting& seen = note.seen;
  if (note.pose.verdict == core::PoseVerdict::kConfirmed && seen.judged && seen.tool_known &&
      seen.tool == note.pose.tube) {
    constexpr std::int64_t kUm = 1000;
    line.detail += " " + word("correction_x_nm", -seen.displacement_um_q8[0] * kUm / 256) + " " +
                   word("correction_y_nm", -seen.displacement_um_q8[1] * kUm / 256);
  }
}

}  // namespace

std::string detail_word(std::string_view key, std::string_view value) {
  constexpr std::string_view kPlain = ".,:;/+-_";
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text = std::string(key) + "=";
  for (const char each : value) {
    const auto byte = static_cast<unsigned char>(each);
    const bool letter = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
                        (byte >= '0' && byte <= '9');
    if (letter || kPlain.find(each) != std::string_view::npos) {
      text += each;
    } else {
      text += '%';
      text += kHex[byte >> 4U];
      text += kHex[byte & 15U];
    }
  }
  return text;
}

JournalLine line_of(const JournalEntry& entry, core::FieldTime shift, const std::string& who) {
  const JournalNote& note = entry.note;
  JournalLine line;
  line.monotonic = duration_cast<microseconds>(note.at + shift);
  line.origin = note.origin == core::EventOrigin::kRobot ? "robot" : "operator";
  if (note.seen_known) {
    line.seen = seen_of(note.seen);
    if (note.digest[0] != '\0') {
      line.digest.assign(note.digest.data(), note.digest.size());
    }
  }
  switch (note.kind) {
    case JournalNote::Kind::kClaim: tell_claim(entry, shift, line); break;
    case JournalNote::Kind::kStart: tell_start(note, who, line); break;
    case JournalNote::Kind::kPose: tell_pose(note, line); break;
    case JournalNote::Kind::kLoss:
      line.kind = hal::JournalKind::kLoss;
      line.origin = "box";
      line.reason = core::name_of(note.seen.reason);
      line.detail = "state=lost";
      break;
    case JournalNote::Kind::kGap:
    case JournalNote::Kind::kLeft:
      line.kind = hal::JournalKind::kFault;
      line.origin = "box";
      line.detail = "part=journal what=over " + word("rows_lost", note.lost);
      break;
  }
  return line;
}

}  // namespace tubesight::board
