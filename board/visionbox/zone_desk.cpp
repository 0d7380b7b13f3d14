#include "board/visionbox/zone_desk.h"

#include <array>
#include <cmath>

#include "board/visionbox/panic_dimmer.h"
#include "core/tubesheet/sheet_places.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::board {
namespace {

std::int64_t nanometres(double mm) { return std::llround(1e6 * mm); }

}  // namespace

ZoneDesk::ZoneDesk(const core::calibration::ZonePoints& points,
                   const core::TubesheetSettings& sheet)
    : points_(points), sheet_(sheet), field_(std::make_unique<core::calibration::ZoneField>()) {}

void ZoneDesk::start() {
  if (ready_) {
    return;  // what was found once stays, and a link may be asking
  }
  thread_ = std::thread([this] {
    use_signal_stack();
    field_->choose(points_);
    ready_ = true;
  });
}

void ZoneDesk::stop() {
  if (thread_.joinable()) {
    thread_.join();
  }
}

bool ZoneDesk::at(core::TubeAddress tube, drivers::ZoneAnswer& answer) const {
  if (!ready_ ||
      core::tubesheet::check_address(sheet_, tube) != core::tubesheet::AddressFault::kNone) {
    return false;
  }
  const std::array<double, 2> place_mm = core::tubesheet::center_mm(sheet_, tube);
  const core::calibration::ZoneCorrection here = field_->at({place_mm[0], place_mm[1]});
  answer = {{nanometres(here.off_mm.x()), nanometres(here.off_mm.y()), nanometres(here.off_mm.z())},
            nanometres(here.across_mm),
            nanometres(here.along_mm)};
  return true;
}

}  // namespace tubesight::board
