#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>

#include "core/base/settings.h"
#include "core/base/tube_address.h"
#include "core/calibration/zone_field.h"
#include "drivers/modbus/zone_corrections.h"

namespace tubesight::board {

/// Tells the robot its corrections by zones.
///
/// How the places hang together is found on a thread of its own, as that takes seconds where there
/// are hundreds; until then nothing is known. Then a place costs some 50 us, on the thread of the
/// link that asks. Some 0.6 MB: heap.
// Final, and the interface has no virtual destructor. NOLINTNEXTLINE(*-virtual-class-destructor)
class ZoneDesk final : public drivers::ZoneCorrections {
 public:
  /// One point at least.
  ZoneDesk(const core::calibration::ZonePoints& points, const core::TubesheetSettings& sheet);
  ZoneDesk(const ZoneDesk&) = delete;
  ZoneDesk& operator=(const ZoneDesk&) = delete;
  ~ZoneDesk() { stop(); }

  void start();
  void stop();

  [[nodiscard]] bool at(core::TubeAddress tube, drivers::ZoneAnswer& answer) const override;

  /// Whether they are known by now. Any thread.
  [[nodiscard]] bool ready() const { return ready_.load(); }
  [[nodiscard]] std::int32_t places() const { return points_.size(); }

 private:
  core::calibration::ZonePoints points_;
  core::TubesheetSettings sheet_;
  std::unique_ptr<core::calibration::ZoneField> field_;  ///< of the thread until ready_
  std::thread thread_;
  std::atomic<bool> ready_{false};
};

}  // namespace tubesight::board
