#include "board/box/journal_desk.h"

#include <algorithm>

#include "core/base/copy_lines.h"

namespace tubesight::board {
namespace {

void copy(const core::Field& from, JournalDesk::Picture& to) {
  const core::FieldView& lines = from.pixels;
  const auto width = static_cast<std::size_t>(lines.width_px);
  to.field = from;
  if (width * static_cast<std::size_t>(lines.lines) > to.pixels.size()) {
    to.field.status = core::FieldStatus::kDamaged;  // larger than was said
    return;
  }
  to.field.pixels = core::copied_lines(lines, to.pixels.data());
}

}  // namespace

JournalDesk::JournalDesk(std::int32_t width_px, std::int32_t height_px) {
  const std::size_t size = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  for (Picture& each : fields_) {
    each.pixels.resize(size);
    each.field.status = core::FieldStatus::kMissing;
  }
  for (Lent& each : lent_) {
    each.picture.pixels.resize(size);
  }
}

void JournalDesk::take(const core::session::Input& input, const core::session::Output& output) {
  const core::Sighting& sighting = output.sighting;
  keep(input.field);
  keep(input.events, input.field.mid_exposure);
  sightings_[static_cast<std::size_t>(std::max<std::int64_t>(sighting.field, 0)) % kSightings] =
      sighting;
  note_changes(sighting);
  for (const core::Reply& reply : output.replies) {
    note_reply(reply, sighting);
  }
}

void JournalDesk::give_back(JournalNote& note) {
  if (note.picture >= 0) {
    lent_[static_cast<std::size_t>(note.picture)].taken.store(false, std::memory_order_release);
    note.picture = -1;
  }
}

void JournalDesk::keep(const core::Field& field) {
  if (field.status == core::FieldStatus::kGood) {
    last_field_ = (last_field_ + 1) % kFields;
    copy(field, fields_[last_field_]);
  }
}

void JournalDesk::keep(const core::EventList& events, core::FieldTime now) {
  for (const core::Event& event : events) {
    if (core::content_if<core::Claim>(event) != nullptr) {
      instants_[next_instant_] = {event.id, event.origin, event.at.value_or(now), true};
      next_instant_ = (next_instant_ + 1) % kInstants;
    } else if (const auto* const start = core::content_if<core::Start>(event)) {
      starts_[next_start_] = {event.id, event.origin, *start, true};
      next_start_ = (next_start_ + 1) % starts_.size();
    }
  }
}

void JournalDesk::note_reply(const core::Reply& reply, const core::Sighting& now) {
  if (const auto* const claim = core::content_if<core::ClaimReply>(reply)) {
    note_claim(reply, *claim);
    return;
  }
  JournalNote note;
  note.id = reply.id;
  note.origin = reply.origin;
  note.at = reply.at;
  if (const auto* const started = core::content_if<core::StartReply>(reply)) {
    note.kind = JournalNote::Kind::kStart;
    note.started = *started;
    for (Named& named : starts_) {
      if (named.waits && named.id == reply.id && named.origin == reply.origin) {
        note.start = named.start;
        named.waits = false;
        break;
      }
    }
    see(note, now);
    push(note);
  } else if (const auto* const pose = core::content_if<core::PoseReply>(reply)) {
    note.kind = JournalNote::Kind::kPose;
    note.pose = *pose;
    see(note, now);
    push(note);
  }
}

void JournalDesk::note_claim(const core::Reply& reply, const core::ClaimReply& claim) {
  JournalNote note;
  note.kind = JournalNote::Kind::kClaim;
  note.id = reply.id;
  note.origin = reply.origin;
  note.at = reply.at;
  note.claim = claim;
  for (Instant& instant : instants_) {
    if (instant.waits && instant.id == reply.id && instant.origin == reply.origin) {
      note.at = instant.at;
      instant.waits = false;
      break;
    }
  }
  if (claim.field >= 0) {
    const core::Sighting& seen = sightings_[static_cast<std::size_t>(claim.field) % kSightings];
    if (seen.field == claim.field) {
      see(note, seen);
    }
  }
  claimed_there_ = true;
  push(note);
}

/// A loss, and that the tool has left the tube that it was claimed to be under.
void JournalDesk::note_changes(const core::Sighting& sighting) {
  const bool lost = sighting.state == core::TrackState::kLost && state_ != core::TrackState::kLost;
  state_ = sighting.state;
  JournalNote note;
  note.at = sighting.time;
  if (sighting.tool_known) {
    if (under_ && *under_ != sighting.tool && claimed_there_) {
      note.kind = JournalNote::Kind::kLeft;
      push(note);
      claimed_there_ = false;
    }
    under_ = sighting.tool;
  }
  if (lost) {
    note.kind = JournalNote::Kind::kLoss;
    see(note, sighting);
    push(note);
  }
}

void JournalDesk::see(JournalNote& note, const core::Sighting& sighting) {
  note.seen_known = true;
  note.seen = sighting;
  lend(note);
}

/// The picture of what was seen, if it is one of the last and a place is free.
void JournalDesk::lend(JournalNote& note) {
  const auto kept = std::find_if(fields_.begin(), fields_.end(), [&note](const Picture& each) {
    return each.field.number == note.seen.field && each.field.status == core::FieldStatus::kGood;
  });
  if (kept == fields_.end()) {
    return;
  }
  for (std::size_t i = 0; i < lent_.size(); ++i) {
    if (!lent_[i].taken.load(std::memory_order_acquire)) {
      copy(kept->field, lent_[i].picture);
      lent_[i].taken.store(true, std::memory_order_relaxed);
      note.picture = static_cast<std::int32_t>(i);
      return;
    }
  }
}

void JournalDesk::push(JournalNote& note) {
  if (untold_ > 0) {
    JournalNote gap;
    gap.kind = JournalNote::Kind::kGap;
    gap.at = note.at;
    gap.lost = untold_;
    if (notes_.try_push(gap)) {
      untold_ = 0;
    }
  }
  if (untold_ == 0 && notes_.try_push(note)) {
    return;
  }
  ++untold_;
  ++lost_;
  give_back(note);
}

}  // namespace tubesight::board
