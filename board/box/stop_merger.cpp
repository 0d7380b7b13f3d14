#include "board/box/stop_merger.h"

#include <algorithm>

namespace tubesight::board {
namespace {

bool is_equal(const JournalNote& a, const JournalNote& b) {
  // Of an unknown answer `tube` says nothing.
  const bool same_tube =
      a.claim.verdict == core::ClaimVerdict::kUnknown || a.claim.tube == b.claim.tube;
  return a.origin == b.origin && a.claim.claimed == b.claim.claimed &&
         a.claim.verdict == b.claim.verdict && a.claim.doubt == b.claim.doubt && same_tube;
}

}  // namespace

void StopMerger::take(const JournalNote& note, std::vector<JournalEntry>& rows) {
  using Kind = JournalNote::Kind;
  switch (note.kind) {
    case Kind::kClaim: take_claim(note, rows); return;
    case Kind::kLeft: end(rows); return;
    case Kind::kStart:
    case Kind::kLoss:
    case Kind::kGap:  // what was lost may have ended the stop
      end(rows);
      break;
    case Kind::kPose: break;
  }
  rows.push_back({note, 0, JournalEntry::Part::kFirst, note.at, note.at, 1});
}

void StopMerger::take_claim(const JournalNote& note, std::vector<JournalEntry>& rows) {
  if (last_ && (!is_equal(*last_, note) || note.at - last_->at >= kSilence)) {
    end(rows);
  }
  if (!last_) {
    ++stop_;
    first_ = note.at;
    last_ = note;
    untold_ = 1;
    tell(JournalEntry::Part::kFirst, rows);
    return;
  }
  // Claims may be answered in another order than that of their instants.
  first_ = std::min(first_, note.at);
  const core::FieldTime latest = std::max(last_->at, note.at);
  last_ = note;
  last_->at = latest;
  ++untold_;
  if (latest - told_ >= kTellEvery) {
    tell(JournalEntry::Part::kOn, rows);
  }
}

void StopMerger::look(core::FieldTime now, std::vector<JournalEntry>& rows) {
  if (last_ && now - last_->at >= kSilence) {
    end(rows);
  }
}

void StopMerger::end(std::vector<JournalEntry>& rows) {
  if (last_ && untold_ > 0) {
    tell(JournalEntry::Part::kEnd, rows);
  }
  last_.reset();
}

void StopMerger::tell(JournalEntry::Part part, std::vector<JournalEntry>& rows) {
  rows.push_back({*last_, stop_, part, first_, last_->at, untold_});
  untold_ = 0;
  told_ = last_->at;
}

}  // namespace tubesight::board
