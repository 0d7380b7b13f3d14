#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "board/bench/output/overlay_sink.h"

namespace tubesight::board {

/// Hands overlay pictures to another sink on a thread of its own, so that the next field is tracked
/// and drawn while a picture is compressed.
///
/// Some pictures wait at most; then add() does. What the other sink refuses is told by the next
/// call.
class BackgroundSink final : public OverlaySink {
 public:
  /// With more than one worker pictures are added side by side and in no order: for a sink that
  /// allows that of its add().
  explicit BackgroundSink(std::unique_ptr<OverlaySink> sink, std::size_t workers = 1)
      : sink_(std::move(sink)), workers_(workers) {}
  BackgroundSink(const BackgroundSink&) = delete;
  BackgroundSink& operator=(const BackgroundSink&) = delete;
  ~BackgroundSink() override { finish(false); }

  [[nodiscard]] core::Result<void> open(const drivers::Y4mHeader& recording,
                                        bool interlaced) override;
  [[nodiscard]] core::Result<void> add(std::int64_t field,
                                       const core::RgbImageView& picture) override;
  [[nodiscard]] core::Result<void> commit() override;
  [[nodiscard]] const std::string& message() const override { return sink_->message(); }

 private:
  static constexpr std::size_t kMostWaiting = 4;

  enum class State : std::uint8_t { kFree, kWaiting, kInWork };
  struct Slot {
    State state = State::kFree;
    std::uint64_t number = 0;  ///< in the order of add()
    std::int64_t field = 0;
    std::vector<std::uint8_t> pixels;  ///< without padding
    core::RgbImageView picture;
  };

  Slot* find_free();
  Slot* find_oldest();
  void work();
  void finish(bool all);

  std::unique_ptr<OverlaySink> sink_;
  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // Under the mutex; a free slot's picture belongs to add(), one in work to its worker.
  std::array<Slot, kMostWaiting> slots_;
  std::uint64_t added_ = 0;
  bool failed_ = false;
  bool closing_ = false;   ///< the workers end when nothing waits
  bool dropping_ = false;  ///< and what waits is not wanted
};

}  // namespace tubesight::board
