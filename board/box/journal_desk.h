#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "board/box/journal_note.h"
#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/sighting.h"
#include "core/base/spsc_queue.h"
#include "core/session/session.h"

namespace tubesight::board {

/// What happened, on its way from the tracking thread to the one that keeps the journal.
///
/// take() is of the tracking thread, never waits and never allocates; it copies each good field, as
/// a claim may be judged by one of the last. The rest is of the other thread. What finds no room is
/// counted, and the count comes through as soon as there is some. Six pictures of memory.
class JournalDesk {
 public:
  /// Pixels of a note, until give_back().
  struct Picture {
    core::Field field;  ///< `pixels` are the desk's
    std::vector<std::uint8_t> pixels;
  };

  /// For fields of this size or smaller.
  JournalDesk(std::int32_t width_px, std::int32_t height_px);

  /// Takes what a step was given and left.
  void take(const core::session::Input& input, const core::session::Output& output);

  /// The next note, in their order; false: there is none. Its picture is to be given back.
  [[nodiscard]] bool take_note(JournalNote& note) { return notes_.try_pop(note); }
  /// Of a note; null: it has none.
  [[nodiscard]] const Picture* picture(const JournalNote& note) const {
    return note.picture < 0 ? nullptr : &lent_[static_cast<std::size_t>(note.picture)].picture;
  }
  /// Frees the place of its picture, if it has one.
  void give_back(JournalNote& note);

  /// Notes that found no room so far. Any thread.
  [[nodiscard]] std::int64_t lost() const { return lost_.load(); }

 private:
  /// Claims of a robot that asks ten times a second, while a disk hangs for six seconds.
  static constexpr std::uint32_t kRoom = 64;
  /// A claim is answered by the field after its instant, and judged by the nearer of the two.
  static constexpr std::size_t kFields = 2;
  static constexpr std::size_t kLent = 4;
  static constexpr std::size_t kSightings = 64;
  /// Of claims that wait for their field, and some that no reply has come for.
  static constexpr std::size_t kInstants = 64;

  struct Instant {
    std::int64_t id = 0;
    core::EventOrigin origin = core::EventOrigin::kRobot;
    core::FieldTime at{0};
    bool waits = false;
  };
  struct Named {
    std::int64_t id = 0;
    core::EventOrigin origin = core::EventOrigin::kRobot;
    core::Start start;
    bool waits = false;
  };
  struct Lent {
    Picture picture;
    std::atomic<bool> taken{false};
  };

  void keep(const core::Field& field);
  void keep(const core::EventList& events, core::FieldTime now);
  void note_reply(const core::Reply& reply, const core::Sighting& now);
  void note_claim(const core::Reply& reply, const core::ClaimReply& claim);
  void note_changes(const core::Sighting& sighting);
  void see(JournalNote& note, const core::Sighting& sighting);
  void lend(JournalNote& note);
  void push(JournalNote& note);

  std::array<Picture, kFields> fields_;
  std::size_t last_field_ = 0;
  std::array<core::Sighting, kSightings> sightings_{};
  std::array<Instant, kInstants> instants_{};
  std::size_t next_instant_ = 0;
  std::array<Named, 4> starts_{};
  std::size_t next_start_ = 0;
  core::TrackState state_ = core::TrackState::kWaiting;
  std::optional<core::TubeAddress> under_;
  bool claimed_there_ = false;  ///< a stop may be under way

  std::array<Lent, kLent> lent_;
  core::SpscQueue<JournalNote, kRoom> notes_;
  std::int64_t untold_ = 0;  ///< lost and not told yet
  std::atomic<std::int64_t> lost_{0};
};

}  // namespace tubesight::board
