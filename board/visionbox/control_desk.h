#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "board/visionbox/box_report.h"
#include "board/visionbox/script_ports.h"
#include "board/visionbox/vision_box.h"
#include "core/base/settings.h"
#include "drivers/control/control_server.h"

namespace tubesight::board {

/// Answers the control socket: tells how the box is doing, carries what a person asks for to the
/// tracking thread, and the answer to the client that asked. The thread of the server.
class ControlDesk final : public drivers::ControlHandler {
 public:
  using Report = std::function<BoxReport()>;

  /// `box` and `start` outlive the desk.
  ControlDesk(Report report, VisionBox& box, const core::StartSettings& start)
      : report_(std::move(report)), box_(&box), start_(&start) {}

  [[nodiscard]] std::optional<std::string> handle(drivers::ControlClient client,
                                                  std::string_view line) override;

  /// Hands over the answers that came, and tells whoever waits too long.
  void serve_replies(drivers::ControlServer& server, MonotonicTime now);

  /// Whether somebody waits for an answer.
  [[nodiscard]] bool busy() const { return !waiting_.empty() || !recordings_.empty(); }

 private:
  struct Waiting {
    std::int64_t id = 0;
    drivers::ControlClient client = 0;
    std::string command;
    MonotonicTime since{0};
  };

  /// Who waits for a recording.
  struct Recording {
    std::uint32_t number = 0;
    drivers::ControlClient client = 0;
    MonotonicTime since{0};
  };

  [[nodiscard]] std::optional<std::string> record(drivers::ControlClient client);
  void serve_events(drivers::ControlServer& server, MonotonicTime now);
  void serve_recordings(drivers::ControlServer& server, MonotonicTime now);

  Report report_;
  VisionBox* box_;
  const core::StartSettings* start_;
  std::vector<Waiting> waiting_;
  std::vector<Recording> recordings_;
  std::int64_t next_id_ = ScriptedStation::kFirstStationId;
};

}  // namespace tubesight::board
