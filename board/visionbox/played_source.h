#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "board/visionbox/field_player.h"
#include "board/visionbox/field_source.h"
#include "board/visionbox/source_clock.h"
#include "board/visionbox/wakeup.h"
#include "core/base/field.h"
#include "core/base/result.h"
#include "core/base/spsc_queue.h"
#include "core/base/static_vector.h"
#include "hal/dimmer.h"
#include "hal/frame_grabber.h"
#include "hal/lamp_history.h"

namespace tubesight::board {

/// How a source is played.
struct PlayedSourceSettings {
  bool loop = true;          ///< begin anew at the end
  bool in_real_time = true;  ///< else time stands still while a field is late: none is ever missing
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  std::chrono::milliseconds first_wait{500};  ///< before a source that failed is opened again
  std::chrono::milliseconds longest_wait{30'000};
};

/// Plays a recording or a scenario in real time, as a camera delivers: a thread makes the fields,
/// and the tracking thread gets each at its instant.
///
/// Whatever ends or fails is opened again by that thread, after waits that double. A new beginning
/// lies a second after the end before it, in time and in sequence, so that no track goes on over
/// it. The grabber's functions belong to the tracking thread and allocate nothing.
class PlayedSource final : public FieldSource {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// `player` outlives the source; `tell` is called with lines for a person, on the source's
  /// thread.
  PlayedSource(FieldPlayer& player, const PlayedSourceSettings& settings, Tell tell);
  PlayedSource(const PlayedSource&) = delete;
  PlayedSource& operator=(const PlayedSource&) = delete;
  ~PlayedSource() { stop(); }

  /// Starts playing and waits until the first opening went well or not; never fails but for
  /// kNotReady, started already.
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;

  /// Waits for the field's instant. kDisconnected: the source ended or failed, and all it delivered
  /// was taken; it is asked again as after a time-out.
  [[nodiscard]] core::Result<hal::FieldLease> grab_for(std::chrono::milliseconds timeout) override;
  void give_back(std::int32_t buffer) override;

  /// What was said before the fields delivered, in its order. Of the tracking thread.
  [[nodiscard]] const core::Event* next_said() const;
  void take_said();

  [[nodiscard]] const hal::Clock& clock() const override { return clock_; }
  [[nodiscard]] SourceState state() const override { return state_.load(); }
  [[nodiscard]] core::FieldTime span() const override { return core::FieldTime{span_ns_.load()}; }
  [[nodiscard]] std::int32_t fields_at_once() const override { return 1; }
  [[nodiscard]] std::int64_t delivered() const { return delivered_.load(); }
  /// Times that it was played from its beginning, and times that it failed.
  [[nodiscard]] std::int64_t passes() const override { return passes_.load(); }
  [[nodiscard]] std::int64_t failures() const override { return failures_.load(); }
  /// Fields that were made after their instant: the machine is too slow to play them, or busy.
  [[nodiscard]] std::int64_t made_late() const override { return made_late_.load(); }
  /// Events of the script that found no room.
  [[nodiscard]] std::int64_t unsaid() const { return unsaid_; }

  [[nodiscard]] MonotonicTime due() const override { return due_; }
  [[nodiscard]] MonotonicTime handed_over() const override { return handed_over_; }

  /// The lamp level that the next field is made with. Any thread.
  void set_lamp_permille(std::int32_t permille) { lamp_permille_ = permille; }
  /// The lamp level that the field handed over last was made with. Any thread.
  [[nodiscard]] std::int32_t shone_permille() const { return shone_permille_; }

 private:
  static constexpr std::uint32_t kSlots = 8;
  static constexpr std::int32_t kMostSaid = 4 * core::kMaxEventsPerField;

  struct Slot {
    std::vector<std::uint8_t> pixels;
    core::Field field;
    core::EventList events;
  };
  /// From the player's time and sequence to the source's.
  struct Shift {
    core::FieldTime time{0};
    std::int64_t sequence = 0;
    bool known = false;
  };

  void play_all();
  core::Result<void> play_once();
  bool wait_for_slot(std::uint32_t& slot);
  void fill(const PlayedField& played, Shift& shift, Slot& slot);
  void begin_at(const core::Field& first, Shift& shift);
  void wait_before_reopening(std::chrono::milliseconds& wait);
  void say(const drivers::Messages& messages, const char* otherwise);
  void hand_over(const Slot& slot);

  FieldPlayer* player_;
  PlayedSourceSettings settings_;
  Tell tell_;
  SourceClock clock_;
  std::thread thread_;
  std::array<Slot, kSlots> slots_;
  core::SpscQueue<std::uint32_t, kSlots> free_;
  core::SpscQueue<std::uint32_t, kSlots> filled_;
  Wakeup slot_freed_;
  Wakeup slot_filled_;
  Wakeup opened_;

  std::atomic<bool> stopping_{false};
  std::atomic<SourceState> state_{SourceState::kOpening};
  std::atomic<std::int64_t> span_ns_;
  std::atomic<std::int64_t> delivered_{0};
  std::atomic<std::int64_t> passes_{0};
  std::atomic<std::int64_t> failures_{0};
  std::atomic<std::int64_t> made_late_{0};
  std::atomic<std::int32_t> lamp_permille_{core::kFullLamp_permille};
  std::atomic<std::int32_t> shone_permille_{core::kFullLamp_permille};
  // Of the source's thread.
  std::optional<std::uint32_t> spare_;  ///< a slot for which there was no field
  core::FieldTime last_time_{0};
  std::int64_t next_sequence_ = 0;
  bool first_attempt_ = true;
  // Of the tracking thread.
  std::optional<std::uint32_t> held_;  ///< taken from filled_, its instant not come
  bool started_ = false;
  bool lent_ = false;
  MonotonicTime due_{0};
  MonotonicTime handed_over_{0};
  core::StaticVector<core::Event, kMostSaid> said_;
  std::int32_t said_taken_ = 0;
  std::int64_t unsaid_ = 0;
};

/// The lamp of a played world: the next field that is made is exposed in its light. Some are made
/// already when a level is set; which level a field was made with comes with it.
class PlayedDimmer final : public hal::Dimmer, public hal::LampHistory {
 public:
  /// `source` outlives the dimmer.
  explicit PlayedDimmer(PlayedSource& source) : source_(&source) {}

  [[nodiscard]] core::Result<void> start() override;
  void stop() override;
  [[nodiscard]] core::Result<void> set_level(std::int32_t permille) override;
  [[nodiscard]] std::int32_t level_permille() const override { return level_permille_; }

  /// Of the field handed over last, whose instant it is.
  [[nodiscard]] std::int32_t level_permille_at(core::FieldTime /*instant*/) const override {
    return source_->shone_permille();
  }

 private:
  PlayedSource* source_;
  std::int32_t level_permille_ = 0;
  bool started_ = false;
};

}  // namespace tubesight::board
