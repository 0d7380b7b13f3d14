#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "board/box/recorder_memory.h"
#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/sighting.h"
#include "core/base/spsc_queue.h"
#include "core/base/static_vector.h"
#include "core/base/tube_address.h"
#include "core/session/session.h"
#include "hal/recording_store.h"

namespace tubesight::board {

/// Numbers that request() gave out, in a row; none where `last` is 0.
struct RecordingRequests {
  std::uint32_t first = 0;
  std::uint32_t last = 0;

  [[nodiscard]] bool hold(std::uint32_t number) const { return first <= number && number <= last; }
};

/// How a recording ended.
struct RecordingOutcome {
  enum class End : std::uint8_t {
    kWritten,  ///< it is in its place
    kFailed,   ///< the store gave it up
    kRefused,  ///< there was nothing to write, or no memory for going on
  };
  End end = End::kWritten;
  hal::RecordingReason reason = hal::RecordingReason::kCommand;  ///< what asked for it first
  RecordingRequests requests;                                    ///< that it answers
};

/// What the recorder has come to so far. Any thread may read a copy.
struct RecorderCounters {
  std::uint32_t asked = 0;      ///< recordings that something asked for
  std::uint32_t joined = 0;     ///< of those: while another was going on, which shows it, too
  std::uint32_t refused = 0;    ///< of those: all memory waits to be written
  std::uint32_t written = 0;    ///< recordings that are in their place
  std::uint32_t failed = 0;     ///< that the store gave up: the disk is full, say
  std::uint32_t restarted = 0;  ///< times that what was kept was dropped as it fits no recording
  std::uint32_t spared = 0;     ///< contradicted claims that asked for none so soon after another
};

/// Keeps the last fields with all that a replay needs to repeat their steps to the byte.
///
/// Memory is divided into segments of some tens of fields, each with the session's state before its
/// first. The oldest whole segment makes place for new fields. What asks for a recording (a
/// contradicted claim, a lost track, request()) freezes all segments `fields_after` fields later;
/// they are written by another thread and come back when they are, while recording goes on in those
/// that are free: a quarter of them is kept for that. Where none is free, the recording is refused
/// and counted, and nobody waits. A claim that is contradicted again, or a track that stays lost,
/// is no new reason. A disagreement asks for no recording within 30 s of fields after the last that
/// one asked for: a robot that goes on being wrong would push all older ones off the disk. What it
/// still claims then is recorded.
///
/// How it is used. The assembly makes one, for the camera's size, before the loop starts (all
/// memory is obtained then, and touched), puts it into BoxServices::recorder, and lets a thread of
/// low priority call write_next() with its store again and again, some 20 times a second:
///
///     EventRecorder recorder;
///     recorder.configure(settings, session_settings.camera, Session::state_bytes());
///     services.recorder = &recorder;
///     while (!stop) { if (!recorder.write_next(store)) { wait 50 ms } }
///
/// where the store is drivers::FileRecordingStore, opened before (its open() and message() tell
/// what went wrong), and request() from wherever a command comes. After the loop has stopped,
/// flush() hands over what is going on and write_next() is called until it is false.
///
/// Threads: take(), state_wanted(), put_state() and flush() by the loop's; write_next() by one
/// other; request() and counters() by any.
class EventRecorder {
 public:
  EventRecorder();
  ~EventRecorder();
  EventRecorder(const EventRecorder&) = delete;
  EventRecorder& operator=(const EventRecorder&) = delete;

  /// Obtains the memory. `state_bytes`: Session::state_bytes(). Call once, before all else.
  ///
  /// Errors: those of divide_memory().
  [[nodiscard]] core::Result<void> configure(const RecorderSettings& settings,
                                             const core::CameraSettings& camera,
                                             std::size_t state_bytes);

  /// Asks for a recording of what just was. Any thread; never waits. The number, from 1 on, comes
  /// back with an outcome of write_next(); it is lost only where outcomes are not fetched.
  std::uint32_t request() { return requested_.fetch_add(1, std::memory_order_relaxed) + 1; }

  /// Keeps what the step was given and looks at what it said; `input`'s pixels are still valid.
  /// Copies a field; allocates nothing, never waits.
  void take(const core::session::Input& input, const core::session::Output& output);

  /// Where the session's state is wanted now, before the next step: call after each take(), and
  /// before the first step; empty when it is not.
  [[nodiscard]] std::span<std::byte> state_wanted();

  /// The state was written there; `bytes` of it, 0 when it could not be.
  void put_state(std::size_t bytes);

  /// Ends a recording that is going on, without its further fields. After the last step.
  void flush();

  /// Writes the next recording that waits, and says how it ended; empty when none waits. As slow as
  /// the store.
  [[nodiscard]] std::optional<RecordingOutcome> write_next(hal::RecordingStore& store);

  [[nodiscard]] RecorderCounters counters() const;

  /// Fields that memory holds at most; valid once configured.
  [[nodiscard]] std::int32_t capacity_fields() const { return division_.capacity_fields(); }

 private:
  struct Segment;

  using SegmentList = core::StaticVector<std::uint32_t, static_cast<std::int32_t>(kMostSegments)>;

  /// Segments that are frozen, oldest first; none in one that was refused.
  struct Recording {
    hal::RecordingHead head;
    RecordingRequests requests;
    SegmentList segments;
  };

  [[nodiscard]] bool fits(const core::Field& field) const;
  [[nodiscard]] bool ends_frame(const core::Field& field) const;
  void keep(const core::session::Input& input);
  void look_for_reasons(const core::Field& field, const core::session::Output& output);
  [[nodiscard]] bool disagrees(const core::Field& field, const core::session::Output& output);
  [[nodiscard]] bool too_soon(const core::Field& field) const;
  void ask(hal::RecordingReason reason, const core::Field& field, RecordingRequests requests = {});
  void refuse(hal::RecordingReason reason, RecordingRequests requests);
  [[nodiscard]] bool open_segment();
  void freeze();
  void drop_all();
  void reclaim();
  [[nodiscard]] core::Result<void> write(const Recording& recording, hal::RecordingStore& store);

  RecorderSettings settings_;
  core::CameraSettings camera_;
  RecorderMemory division_;
  std::vector<Segment> memory_;

  // The loop's thread.
  SegmentList kept_;  ///< oldest first
  SegmentList free_;
  bool open_ = false;         ///< the newest of kept_ takes fields
  bool frame_ended_ = true;   ///< the next field is its frame's first
  std::int64_t number_ = -1;  ///< of the last field
  core::TrackState state_ = core::TrackState::kWaiting;
  std::optional<core::TubeAddress> contradicted_;  ///< the claim that was contradicted last
  std::optional<core::FieldTime> disagreed_at_;    ///< when a disagreement began a recording last
  std::int32_t going_on_ = -1;  ///< fields until the recording is frozen; -1: none
  hal::RecordingHead head_;     ///< of the recording going on
  RecordingRequests requests_;  ///< of the recording going on
  std::uint32_t taken_ = 0;     ///< requests that were seen

  // Between the threads.
  std::atomic<std::uint32_t> requested_{0};             ///< how many so far
  core::SpscQueue<Recording, 8> waiting_;               ///< from the loop's to the writing one
  core::SpscQueue<std::uint32_t, kMostSegments> back_;  ///< written: from the writing one back
  struct Counts {
    std::atomic<std::uint32_t> asked{0};
    std::atomic<std::uint32_t> joined{0};
    std::atomic<std::uint32_t> refused{0};
    std::atomic<std::uint32_t> written{0};
    std::atomic<std::uint32_t> failed{0};
    std::atomic<std::uint32_t> restarted{0};
    std::atomic<std::uint32_t> spared{0};
  };
  Counts counts_;
};

}  // namespace tubesight::board
