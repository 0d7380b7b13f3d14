#pragma once

#include <memory>
#include <string>

#include "board/visionbox/boot_count.h"
#include "board/visionbox/box_settings.h"
#include "board/visionbox/box_watch.h"
#include "board/visionbox/control_desk.h"
#include "board/visionbox/golden_recording.h"
#include "board/visionbox/journal_faults.h"
#include "board/visionbox/log.h"
#include "board/visionbox/page_desk.h"
#include "board/visionbox/self_test_watch.h"
#include "board/visionbox/service_manager.h"
#include "board/visionbox/supervisor.h"
#include "board/visionbox/vision_box.h"
#include "drivers/control/control_server.h"

namespace tubesight::board {

/// The box as a service: a vision box, who asks it, and who watches over it.
///
/// A box whose golden recording is judged otherwise than it must be runs, answers, and judges no
/// field: it vouches for nothing.
class BoxService {
 public:
  /// What was found out before the box is made.
  struct Found {
    ServiceEnvironment environment;
    BootCount boots;
    GoldenResult golden;
  };

  /// `settings` and `log` outlive the service.
  BoxService(const BoxSettings& settings, const Found& found, Log& log);
  BoxService(const BoxService&) = delete;
  BoxService& operator=(const BoxService&) = delete;

  /// Starts everything. False: it cannot be, which was told.
  [[nodiscard]] bool start();

  /// Serves until this descriptor can be read.
  void serve(int end);

  /// Stops everything in order; the lamp goes dark, and the hardware's watchdog is disarmed.
  void stop();

  /// How the box is doing. The thread that serves.
  [[nodiscard]] BoxReport report() const;

 private:
  void look_round();
  void tell_robot(const BoxReport& now);
  void journal_boot(std::string_view what);

  const BoxSettings* settings_;
  Log* log_;
  Found found_;
  VisionBox box_;
  ServiceManager manager_;
  Supervisor supervisor_;
  BoxWatch watch_;
  SelfTestWatch self_test_;
  JournalFaults faults_;
  ControlDesk desk_;
  drivers::ControlServer server_;
  std::unique_ptr<PageDesk> page_;  ///< null: there is none
  std::string told_manager_;
};

}  // namespace tubesight::board
