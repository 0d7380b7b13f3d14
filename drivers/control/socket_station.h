#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "core/base/event.h"
#include "core/base/reply.h"
#include "core/base/result.h"
#include "core/base/spsc_queue.h"
#include "hal/operator_station.h"

namespace tubesight::drivers {

/// The operator at the control socket: what clients ask for crosses to the tracking thread in one
/// queue, and the answers come back in another. Neither side waits for the other.
///
/// The port's functions belong to the tracking thread, submit() and take_reply() to the one that
/// serves the socket. Nothing is allocated.
class SocketStation final : public hal::OperatorStation {
 public:
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;
  [[nodiscard]] core::Result<std::optional<core::Event>> poll_event() override;
  [[nodiscard]] core::Result<void> send_reply(const core::Reply& reply) override;
  /// Counts the picture and shows nothing: a socket of text has none. kNotReady not started.
  [[nodiscard]] core::Result<void> show(const core::RgbImageView& picture,
                                        const core::Sighting& sighting) override;

  /// Hands an event to the tracking thread; false, and the event is dropped, where so many wait
  /// that it finds no room, or where the station is not started.
  [[nodiscard]] bool submit(const core::Event& event);

  /// The next answer; empty: none has come.
  [[nodiscard]] std::optional<core::Reply> take_reply();

  /// Pictures that were to be shown.
  [[nodiscard]] std::int64_t pictures() const { return pictures_.load(); }

 private:
  /// Four fields' worth of events: a person and some scripts, not a stream.
  static constexpr std::uint32_t kRoom = 64;

  core::SpscQueue<core::Event, kRoom> events_;
  core::SpscQueue<core::Reply, kRoom> replies_;
  std::atomic<bool> started_{false};
  std::atomic<bool> dropped_{false};
  std::atomic<std::int64_t> pictures_{0};
};

}  // namespace tubesight::drivers
