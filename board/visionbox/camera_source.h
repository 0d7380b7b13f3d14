#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "board/visionbox/camera.h"
#include "board/visionbox/field_source.h"
#include "board/visionbox/wakeup.h"

namespace tubesight::board {

/// The system's monotonic clock, with which cameras' drivers stamp.
class SystemClock final : public hal::Clock {
 public:
  [[nodiscard]] core::FieldTime now() const override { return monotonic_now(); }
};

/// A camera that may be there or not: a thread of its own opens it, looks after it and opens it
/// anew, so that none of that keeps the tracking waiting.
///
/// The box starts without it and takes it when it comes. Who may touch the camera is passed to and
/// fro: the tracking thread while it delivers, the source's thread from the first error on. Between
/// two attempts waits double.
class CameraSource final : public FieldSource {
 public:
  using Tell = std::function<void(const std::string&)>;

  struct Waits {
    std::chrono::milliseconds first{500};  ///< before a camera that failed is opened again
    std::chrono::milliseconds longest{8'000};
    std::chrono::milliseconds look{250};  ///< between two looks after it
  };

  /// `camera` stamps by a SystemClock and outlives the source; `tell` is called with lines for a
  /// person, on the source's thread.
  CameraSource(Camera& camera, Tell tell) : CameraSource(camera, std::move(tell), Waits()) {}
  CameraSource(Camera& camera, Tell tell, const Waits& waits);
  CameraSource(const CameraSource&) = delete;
  CameraSource& operator=(const CameraSource&) = delete;
  ~CameraSource() { stop(); }

  /// Begins to open the camera and waits until the first attempt went well or not, at most a second
  /// or two. Never fails but for kNotReady, started already.
  [[nodiscard]] core::Result<void> start() override;
  /// Nobody may be in grab_for().
  void stop() override;

  [[nodiscard]] core::Result<hal::FieldLease> grab_for(std::chrono::milliseconds timeout) override;
  /// Leases are the camera's own and go back to it.
  void give_back(std::int32_t /*buffer*/) override {}

  [[nodiscard]] const hal::Clock& clock() const override { return clock_; }
  [[nodiscard]] SourceState state() const override;
  [[nodiscard]] core::FieldTime span() const override { return core::FieldTime{span_ns_.load()}; }
  [[nodiscard]] std::int32_t fields_at_once() const override { return fields_at_once_; }
  [[nodiscard]] std::int64_t passes() const override { return passes_; }
  [[nodiscard]] std::int64_t failures() const override { return failures_; }
  [[nodiscard]] std::int64_t made_late() const override { return 0; }

  /// What the calibration leaves open of the camera; empty: nothing. Any thread.
  [[nodiscard]] std::string doubt() const;

  /// A field is due when it would be here after the shortest way that one of its kind took since
  /// the camera was opened.
  [[nodiscard]] MonotonicTime due() const override { return due_; }
  [[nodiscard]] MonotonicTime handed_over() const override { return handed_over_; }

 private:
  /// Whose the camera is.
  enum class Phase : std::uint8_t {
    kClosed,  ///< the source's thread, which opens it
    kOpen,    ///< the tracking thread
    kBroken,  ///< the source's thread, which closes it
  };

  void keep();
  bool open();
  void tell_once(const std::string& line);
  void tell_state();
  void pause(std::chrono::milliseconds longest);
  void measure(const core::Field& field);

  Camera* camera_;
  Tell tell_;
  Waits waits_;
  SystemClock clock_;
  std::thread thread_;
  Wakeup opened_;
  Wakeup stirred_;  ///< the source's thread: something has happened

  std::atomic<bool> stopping_{false};
  std::atomic<Phase> phase_{Phase::kClosed};
  std::atomic<bool> tried_{false};
  std::atomic<bool> delivered_{false};  ///< since it was opened
  std::atomic<std::int64_t> span_ns_;
  std::atomic<std::int32_t> fields_at_once_{1};
  std::atomic<std::int64_t> passes_{0};
  std::atomic<std::int64_t> failures_{0};
  std::string state_;             ///< words of the camera at the last look; of the source's thread
  std::int32_t state_looks_ = 0;  ///< in a row with these words
  bool state_told_ = false;       ///< a trouble was told that is not over
  mutable std::mutex doubt_mutex_;
  std::string doubt_;
  std::string told_;  ///< the last trouble that was told; of the source's thread
  // Of the tracking thread.
  bool started_ = false;
  MonotonicTime due_{0};
  MonotonicTime handed_over_{0};
  std::int64_t pass_ = 0;
  std::array<core::FieldTime, 2> shortest_way_{};  ///< by the evenness of numbers
};

}  // namespace tubesight::board
