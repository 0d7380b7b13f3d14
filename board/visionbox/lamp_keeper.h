#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <utility>

#include "board/visionbox/lamp_device.h"
#include "board/visionbox/lamp_ramp.h"
#include "board/visionbox/wakeup.h"
#include "core/base/snapshot.h"
#include "hal/dimmer.h"
#include "hal/lamp_history.h"

namespace tubesight::board {

/// How the lamp is doing, for whoever asks.
struct LampReport {
  bool open = false;
  std::int32_t level_permille = 0;  ///< that shines
  bool resting = false;             ///< its time at full power is used up
  std::int64_t failures = 0;        ///< levels refused, and openings that failed
};

/// A lamp that may be there or not, and whose bulb is spared: a thread of its own opens it, leads
/// the level softly to the one wanted, and keeps what shone when.
///
/// set_level() says only what is wanted and never waits. While the device cannot be had it is
/// refused with kIo, but for the first: a box starts without its lamp, too. stop() leads the level
/// down and leaves the lamp dark.
class LampKeeper final : public hal::Dimmer, public hal::LampHistory {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// `lamp` outlives the keeper; `tell` takes lines for a person, on the keeper's thread. A lamp
  /// that cannot be had is tried again each `between_tries`.
  LampKeeper(LampDevice& lamp, const LampCare& care, Tell tell,
             MonotonicTime between_tries = std::chrono::seconds(1))
      : lamp_(&lamp),
        care_(care),
        ramp_(care),
        between_tries_(between_tries),
        tell_(std::move(tell)) {}
  LampKeeper(const LampKeeper&) = delete;
  LampKeeper& operator=(const LampKeeper&) = delete;
  ~LampKeeper() { stop(); }

  /// Begins to open the lamp, and does not wait for it.
  [[nodiscard]] core::Result<void> start() override;
  /// Takes as long as the lamp's soft end.
  void stop() override;
  [[nodiscard]] core::Result<void> set_level(std::int32_t permille) override;
  /// The level wanted; 0 while the lamp cannot be had.
  [[nodiscard]] std::int32_t level_permille() const override;

  /// No more than this shines from now on, whatever is wanted. Any thread.
  void set_most(std::int32_t permille);

  [[nodiscard]] std::int32_t level_permille_at(core::FieldTime instant) const override;

  /// Any thread.
  [[nodiscard]] LampReport report() const;

  /// Times that the keeper's thread has come round; it does ten times a second, whatever happens.
  /// Any thread.
  [[nodiscard]] std::int64_t rounds() const { return rounds_; }

 private:
  /// Changes that are remembered: a soft start's, one each 10 ms for its longest time of a second
  /// that a field may be old.
  static constexpr std::size_t kRemembered = 128;
  struct Change {
    std::int64_t at_ns = 0;
    std::int32_t permille = 0;
  };
  struct History {
    std::array<Change, kRemembered> changes;  ///< the last one at `next` - 1, around the end
    std::uint32_t next = 0;
  };

  void keep();
  bool opened();
  void apply(std::int32_t permille, MonotonicTime now);
  void shine(std::int32_t permille, MonotonicTime now);
  void lose(const std::string& why);
  void remember(std::int32_t permille, MonotonicTime now);

  LampDevice* lamp_;
  LampCare care_;
  LampRamp ramp_;
  MonotonicTime between_tries_;
  Tell tell_;
  std::thread thread_;
  Wakeup stirred_;
  bool started_ = false;

  std::atomic<bool> stopping_{false};
  std::atomic<bool> open_{false};
  std::atomic<bool> failed_{false};  ///< it was tried, and cannot be had
  std::atomic<bool> resting_{false};
  std::atomic<std::int32_t> wanted_permille_{0};
  std::atomic<std::int32_t> most_permille_{hal::kFullLevel_permille};
  std::atomic<bool> asked_{false};  ///< a level was wanted since the start
  std::atomic<std::int32_t> shining_permille_{0};
  std::atomic<std::int64_t> failures_{0};
  std::atomic<std::int64_t> rounds_{0};
  // Of the keeper's thread.
  History history_;
  core::Snapshot<History> latest_;
  MonotonicTime next_try_{0};
  MonotonicTime next_proof_{0};
  std::string told_;
};

}  // namespace tubesight::board
