#include "board/visionbox/journal_writer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <sys/timex.h>

#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/real_time.h"
#include "board/visionbox/wakeup.h"

namespace tubesight::board {
namespace {

using std::chrono::duration_cast;
using std::chrono::microseconds;

constexpr std::chrono::milliseconds kLookEvery{20};
constexpr MonotonicTime kShortestPause = std::chrono::seconds(1);
constexpr MonotonicTime kLongestPause = std::chrono::seconds(30);
constexpr MonotonicTime kSignAfter = std::chrono::seconds(10);

/// How far the wall clock may be off; empty: nobody disciplines it.
std::optional<microseconds> wall_doubt() {
  timex now{};
  if (adjtimex(&now) < 0 || (now.status & STA_UNSYNC) != 0) {
    return {};
  }
  return microseconds(now.maxerror);
}

microseconds wall_now() {
  return duration_cast<microseconds>(std::chrono::system_clock::now().time_since_epoch());
}

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Of a field, as a picture that people know: lines of an interlaced one twice.
struct Upright {
  std::vector<std::uint8_t> pixels;
  core::ImageView view;

  explicit Upright(const core::Field& field) {
    const core::FieldView& lines = field.pixels;
    const auto width = static_cast<std::size_t>(lines.width_px);
    const int times = field.parity == core::Parity::kProgressive ? 1 : 2;
    for (std::int32_t line = 0; line < lines.lines; ++line) {
      const std::uint8_t* const from =
          lines.pixels + static_cast<std::ptrdiff_t>(line) * lines.stride_px;
      for (int i = 0; i < times; ++i) {
        pixels.insert(pixels.end(), from, from + width);
      }
    }
    view.pixels = pixels.data();
    view.width_px = lines.width_px;
    view.height_px = lines.lines * times;
    view.stride_px = lines.width_px;
  }
};

/// The first claim of a stop, and a loss.
bool shows_picture(const JournalEntry& entry) {
  const JournalNote::Kind kind = entry.note.kind;
  return kind == JournalNote::Kind::kLoss ||
         (kind == JournalNote::Kind::kClaim && entry.part == JournalEntry::Part::kFirst);
}

}  // namespace

JournalWriter::JournalWriter(JournalDesk& desk, const hal::Clock& fields, std::string file,
                             JournalFrame frame, Parts parts, Tell tell)
    : desk_(&desk),
      fields_(&fields),
      file_(std::move(file)),
      frame_(std::move(frame)),
      parts_(std::move(parts)),
      tell_(std::move(tell)) {
  report_.file = file_;
  report_.state = JournalReport::State::kStanding;
  report_.trouble = "not opened yet";
}

void JournalWriter::start() {
  stopping_ = false;
  thread_ = std::thread([this] {
    use_signal_stack();
    name_this_thread("journal");
    schedule_behind_others();
    run();
  });
}

void JournalWriter::stop() {
  stopping_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void JournalWriter::run() {
  while (true) {
    // Asked before the last look, so that nothing handed over before stop() is left.
    const bool last = stopping_;
    round(last);
    if (last) {
      return;
    }
    sleep_until(monotonic_now() + kLookEvery);
  }
}

void JournalWriter::round(bool last) {
  take_notes(last);
  const MonotonicTime now = monotonic_now();
  if ((now >= next_try_ || last) && open()) {
    while (!waiting_.empty() && write_waiting()) {
    }
    const bool idle =
        open_ && unsigned_since_ > MonotonicTime{0} && (last || now - unsigned_since_ > kSignAfter);
    if (idle && parts_.store->journal().sign()) {
      unsigned_since_ = MonotonicTime{0};
    }
  }
  if (last && open_) {
    parts_.store->close();
    open_ = false;
  }
  publish();
}

void JournalWriter::take_notes(bool last) {
  const core::FieldTime shift = monotonic_now() - fields_->now();
  std::vector<JournalEntry> entries;
  JournalNote note;
  while (desk_->take_note(note)) {
    const JournalDesk::Picture* const seen = desk_->picture(note);
    if (seen != nullptr) {
      put_digest(*seen, note);
    }
    merger_.take(note, entries);
    std::string picture;
    if (seen != nullptr && !entries.empty() && shows_picture(entries.back())) {
      picture = parts_.compress(Upright(seen->field).view);
    }
    desk_->give_back(note);
    queue_all(entries, shift, std::move(picture));
  }
  if (last) {
    merger_.end(entries);
  } else {
    merger_.look(fields_->now(), entries);
  }
  queue_all(entries, shift, {});
  std::vector<JournalLine> added;
  {
    const std::lock_guard lock(mutex_);
    added.swap(added_);
  }
  for (JournalLine& line : added) {
    queue(std::move(line));
  }
}

void JournalWriter::put_digest(const JournalDesk::Picture& picture, JournalNote& note) const {
  const core::FieldView& lines = picture.field.pixels;
  const auto size =
      static_cast<std::size_t>(lines.width_px) * static_cast<std::size_t>(lines.lines);
  const std::string digest = parts_.digest(std::as_bytes(std::span(lines.pixels, size)));
  if (digest.size() == note.digest.size()) {
    std::copy(digest.begin(), digest.end(), note.digest.begin());
  }
}

/// Queues what a note has brought about; the picture is of the last, which is the note's own.
void JournalWriter::queue_all(std::vector<JournalEntry>& entries, core::FieldTime shift,
                              std::string picture) {
  for (const JournalEntry& entry : entries) {
    JournalLine line = line_of(entry, shift, who_is(entry.note));
    if (&entry == &entries.back()) {
      line.picture = std::move(picture);
    }
    queue(std::move(line));
  }
  entries.clear();
}

void JournalWriter::queue(JournalLine line) {
  if (waiting_.size() < kMostWaiting) {
    waiting_.push_back(std::move(line));
    return;
  }
  ++untold_;
  const std::lock_guard lock(mutex_);
  ++report_.lost;
}

/// The gap is told where it is: behind the rows that were kept.
void JournalWriter::tell_lost() {
  if (untold_ == 0 || waiting_.size() >= kMostWaiting) {
    return;
  }
  JournalLine line;
  line.kind = hal::JournalKind::kFault;
  line.monotonic = duration_cast<microseconds>(monotonic_now());
  line.detail = "part=journal what=over " + detail_word("rows_lost", std::to_string(untold_));
  waiting_.push_back(std::move(line));
  untold_ = 0;
}

bool JournalWriter::open() {
  if (open_) {
    return true;
  }
  JournalLine begin;
  begin.monotonic = duration_cast<microseconds>(monotonic_now());
  if (!parts_.store->open(row_of(begin))) {
    fail(parts_.store->message());
    return false;
  }
  if (!parts_.store->news().empty()) {
    tell_(parts_.store->news());
  }
  open_ = true;
  {
    // Of a journal that was begun anew, as the one before is damaged, it counts anew.
    const std::lock_guard lock(mutex_);
    report_.safe = parts_.store->journal().last_safe();
  }
  if (!std::exchange(compared_, true)) {
    compare_settings();
  }
  return true;
}

/// A start with other settings than the one before is a change of them.
void JournalWriter::compare_settings() {
  constexpr std::string_view kKey = "settings=";
  const std::string last = parts_.store->last_detail(hal::JournalKind::kBoot);
  const std::size_t at = last.find(kKey);
  if (at == std::string::npos || frame_.settings.empty()) {
    return;
  }
  const std::string before = last.substr(at + kKey.size(), frame_.settings.size());
  if (before == frame_.settings) {
    return;
  }
  JournalLine line;
  line.kind = hal::JournalKind::kSetting;
  line.monotonic = duration_cast<microseconds>(monotonic_now());
  line.detail = "what=changed " + detail_word("settings", frame_.settings) + " " +
                detail_word("before", before);
  queue(std::move(line));
}

bool JournalWriter::write_waiting() {
  std::vector<hal::JournalRow> rows;
  for (std::size_t i = 0; i < std::min(waiting_.size(), kMostAtOnce); ++i) {
    rows.push_back(row_of(waiting_[i]));
  }
  busy_since_ = monotonic_now().count();
  const auto written = parts_.store->journal().append(rows);
  busy_since_ = 0;
  if (!written) {
    fail(parts_.store->message());
    return false;
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(rows.size()));
  unsigned_since_ = unsigned_since_ > MonotonicTime{0} ? unsigned_since_ : monotonic_now();
  pause_ = MonotonicTime{0};
  {
    const std::lock_guard lock(mutex_);
    report_.trouble.clear();
    report_.safe = *written;
  }
  if (std::exchange(failed_, false)) {
    tell_("the journal goes on");
  }
  tell_lost();
  return true;
}

void JournalWriter::fail(const std::string& why) {
  parts_.store->close();
  open_ = false;
  failed_ = true;
  pause_ = std::clamp(2 * pause_, kShortestPause, kLongestPause);
  next_try_ = monotonic_now() + pause_;
  bool news = false;
  {
    const std::lock_guard lock(mutex_);
    news = report_.trouble != why;
    report_.trouble = why;
  }
  if (news) {
    tell_("the journal stands still: " + why);
  }
}

void JournalWriter::publish() {
  const std::lock_guard lock(mutex_);
  report_.waiting = static_cast<std::int64_t>(waiting_.size());
  report_.state = open_ && report_.trouble.empty() ? JournalReport::State::kWriting
                                                   : JournalReport::State::kStanding;
  if (open_ && waiting_.empty()) {
    report_.trouble.clear();
    report_.state = JournalReport::State::kWriting;
  }
}

void JournalWriter::add(JournalLine line) {
  line.monotonic = duration_cast<microseconds>(monotonic_now());
  const std::lock_guard lock(mutex_);
  if (added_.size() < kMostWaiting) {
    added_.push_back(std::move(line));
  } else {
    ++report_.lost;
  }
}

void JournalWriter::name(std::int64_t event_id, const std::string& who) {
  const std::lock_guard lock(mutex_);
  names_[event_id] = who;
  if (names_.size() > kMostNames) {
    names_.erase(names_.begin());
  }
}

std::string JournalWriter::who_is(const JournalNote& note) {
  if (note.kind != JournalNote::Kind::kStart || note.origin != core::EventOrigin::kOperator) {
    return {};
  }
  const std::lock_guard lock(mutex_);
  const auto found = names_.find(note.id);
  if (found == names_.end()) {
    return {};
  }
  std::string who = std::move(found->second);
  names_.erase(found);
  return who;
}

JournalReport JournalWriter::report() const {
  const std::int64_t busy = busy_since_;
  const std::lock_guard lock(mutex_);
  JournalReport report = report_;
  report.lost += desk_->lost();
  if (busy > 0 && monotonic_now().count() - busy > kSlow.count()) {
    report.state = JournalReport::State::kStanding;
    report.trouble = file_ + ": the disk takes long";
  }
  return report;
}

hal::JournalRow JournalWriter::row_of(const JournalLine& line) const {
  hal::JournalRow row;
  row.kind = line.kind;
  row.time.boot_id = frame_.boot_id;
  row.time.monotonic = line.monotonic;
  row.time.wall = wall_now() - (duration_cast<microseconds>(monotonic_now()) - line.monotonic);
  row.time.wall_doubt = wall_doubt();
  row.version = frame_.version;
  row.origin = line.origin;
  row.event_id = line.event_id;
  row.claimed = line.claimed;
  row.verdict = line.verdict;
  row.reason = line.reason;
  row.seen = line.seen;
  row.seen.field_digest = line.digest;
  row.camera_id = frame_.camera_id;
  row.tool_id = frame_.tool_id;
  row.base_id = frame_.base_id;
  row.first = line.first;
  row.last = line.last;
  row.count = line.count;
  row.detail = line.detail;
  row.picture = bytes_of(line.picture);
  return row;
}

}  // namespace tubesight::board
