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
  explicit BackgroundSink(std::unique_ptr<OverlaySink> sink) : sink_(std::move(sink)) {}
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

  struct Waiting {
    std::int64_t field = 0;
    std::vector<std::uint8_t> pixels;  ///< without padding
    core::RgbImageView picture;
  };

  void work();
  void finish(bool all);

  std::unique_ptr<OverlaySink> sink_;
  std::thread worker_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // Under the mutex; a picture that waits belongs to the worker until it is taken off.
  std::array<Waiting, kMostWaiting> ring_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  bool failed_ = false;
  bool closing_ = false;   ///< the worker ends when nothing waits
  bool dropping_ = false;  ///< and what waits is not wanted
};

}  // namespace tubesight::board
