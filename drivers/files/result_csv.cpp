#include "drivers/files/result_csv.h"

#include "core/base/names.h"
#include "drivers/files/decimal.h"

namespace tubesight::drivers {
namespace {

// The decimals of conventions: px 3, mm 4, s 6, margin and quality 4.
constexpr std::int64_t kQ16 = 65536;
constexpr std::int64_t kMicrometreQ8PerMillimetre = 256 * 1000;
constexpr std::int64_t kPermyriad = 10000;
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

void append_px(std::string& out, core::ImagePoint point) {
  append_decimal(out, point.u_q16, kQ16, 3);
  out += ',';
  append_decimal(out, point.v_q16, kQ16, 3);
}

void append_mm(std::string& out, std::int32_t um_q8) {
  append_decimal(out, um_q8, kMicrometreQ8PerMillimetre, 4);
}

void append_address(std::string& out, core::TubeAddress address) {
  append_whole(out, address.row);
  out += ',';
  append_whole(out, address.column);
}

}  // namespace

void append_fields_row(std::string& out, std::int64_t field, core::Parity parity,
                       const core::Sighting& sighting) {
  append_whole(out, field);
  out += ',';
  append_whole(out, field / 2);
  out += ',';
  out += core::name_of(parity);
  out += ',';
  append_decimal(out, sighting.time.count(), kNanosecondsPerSecond, 6);
  out += ',';
  out += core::name_of(sighting.state);
  out += ',';
  append_whole(out, sighting.tracked);
  out += ',';
  if (sighting.primary_known) {
    append_address(out, sighting.primary);
    out += ',';
    append_px(out, sighting.primary_px);
  } else {
    out += ",,,";
  }
  out += ',';
  if (sighting.tool_known) {
    append_address(out, sighting.tool);
    out += ',';
    append_mm(out, sighting.offset_um_q8);
  } else {
    out += ",,";
  }
  out += ',';
  if (sighting.axis_known) {
    append_mm(out, sighting.height_um_q8);
  }
  out += sighting.aligned ? ",1," : ",0,";
  if (sighting.margin_known) {
    append_decimal(out, sighting.margin_permyriad, kPermyriad, 4);
  }
  out += ',';
  if (sighting.state != core::TrackState::kTracking) {
    out += core::name_of(sighting.reason);
  }
  out += ',';
  if (sighting.tool_known) {
    append_mm(out, sighting.displacement_um_q8[0]);
    out += ',';
    append_mm(out, sighting.displacement_um_q8[1]);
  } else {
    out += ',';
  }
  out += ',';
  if (sighting.judged) {
    append_decimal(out, sighting.residual_px_q16, kQ16, 3);
  }
  out += ',';
  out += core::name_of(sighting.liveness);
  out += '\n';
}

void append_centers_row(std::string& out, std::int64_t field, const core::TubeSighting& tube) {
  append_whole(out, field);
  out += ',';
  append_address(out, tube.address);
  out += ',';
  append_px(out, tube.center_px);
  out += ',';
  append_decimal(out, tube.quality_permyriad, kPermyriad, 4);
  out += '\n';
}

}  // namespace tubesight::drivers
