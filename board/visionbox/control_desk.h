#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "board/visionbox/box_report.h"
#include "board/visionbox/script_ports.h"
#include "core/base/settings.h"
#include "drivers/control/control_server.h"
#include "drivers/control/socket_station.h"

namespace tubesight::board {

/// Answers the control socket: tells how the box is doing, carries what a person asks for to the
/// tracking thread, and the answer to the client that asked. The thread of the server.
class ControlDesk final : public drivers::ControlHandler {
 public:
  using Report = std::function<BoxReport()>;

  /// `station` and `start` outlive the desk.
  ControlDesk(Report report, drivers::SocketStation& station, const core::StartSettings& start)
      : report_(std::move(report)), station_(&station), start_(&start) {}

  [[nodiscard]] std::optional<std::string> handle(drivers::ControlClient client,
                                                  std::string_view line) override;

  /// Hands over the answers that came, and tells whoever waits too long.
  void serve_replies(drivers::ControlServer& server, MonotonicTime now);

  /// Whether somebody waits for an answer.
  [[nodiscard]] bool busy() const { return !waiting_.empty(); }

 private:
  struct Waiting {
    std::int64_t id = 0;
    drivers::ControlClient client = 0;
    std::string command;
    MonotonicTime since{0};
  };

  Report report_;
  drivers::SocketStation* station_;
  const core::StartSettings* start_;
  std::vector<Waiting> waiting_;
  std::int64_t next_id_ = ScriptedStation::kFirstStationId;
};

}  // namespace tubesight::board
