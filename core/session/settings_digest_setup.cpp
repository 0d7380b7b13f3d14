#include "core/base/state_stream.h"
#include "core/session/settings_digest.h"

namespace tubesight::core::session {
namespace {

// Each binds all members, so that a new one does not compile until it is in the digest.

void digest(const CameraSettings& camera, StateDigest& stream) {
  const auto& [width, height, scan, focal_length, cell_width, cell_height, sensor_columns,
               frame_columns, scale, center, distortion, distortion2] = camera;
  stream(width, height);
  stream.choice(scan, Scan::kProgressive);
  stream(focal_length, cell_width, cell_height, sensor_columns, frame_columns, scale, center,
         distortion, distortion2);
}

void digest(const TubesheetSettings& sheet, StateDigest& stream) {
  const auto& [origin, row_step, column_step, bore, weld, rows, columns, addresses, shift, missing,
               plugged] = sheet;
  stream(origin, row_step, column_step, bore);
  stream.choice(weld, Weld::kFillet);
  stream(rows, columns);
  stream.choice(addresses, AddressParity::kOddSum);
  stream(shift, missing, plugged);
}

}  // namespace

std::uint64_t settings_digest(const SessionSettings& settings) {
  const auto& [camera, tool, tubesheet, start, motion, edges, verification] = settings;
  StateDigest stream;
  digest(camera, stream);
  digest(tubesheet, stream);
  const auto& [position, rotation] = tool;
  stream(position, rotation);
  const auto& [clicks, window, optimum] = start;
  stream(window, optimum);
  const auto& [speed, acceleration, height_speed, height_acceleration, turn_speed,
               turn_acceleration, lean_speed, lean_acceleration] = motion;
  stream(speed, acceleration, height_speed, height_acceleration, turn_speed, turn_acceleration,
         lean_speed, lean_acceleration);
  const auto& [initial, region] = edges;
  stream(initial, region);
  const auto& [aligned_within, claim_within, claim_oldest] = verification;
  stream(aligned_within, claim_within, claim_oldest);
  return stream.value();
}

}  // namespace tubesight::core::session
