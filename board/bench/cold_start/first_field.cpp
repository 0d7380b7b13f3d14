#include "board/bench/cold_start/first_field.h"

#include <chrono>
#include <cstddef>

#include "board/bench/input/recording_input.h"

namespace tubesight::board {

RecordedField read_first_field(const core::CameraSettings& camera, const std::string& recording,
                               std::int64_t frame, bool ignore_scan_flag) {
  RecordedField read;
  drivers::ReplayFrameGrabber grabber(camera, recording);
  if (!feed(grabber, recording, ignore_scan_flag, read.message)) {
    return read;
  }
  return read_first_field(grabber, camera, recording, frame);
}

RecordedField read_first_field(drivers::ReplayFrameGrabber& grabber,
                               const core::CameraSettings& camera, const std::string& recording,
                               std::int64_t frame) {
  RecordedField read;
  if (drivers::Messages messages; !start(grabber, messages)) {
    read.message = messages.empty() ? recording + ": cannot be read" : messages.front();
    return read;
  }
  while (true) {
    const auto lease = grabber.grab_for(std::chrono::milliseconds(0));
    if (!lease) {
      read.message = recording + ": ends before frame " + std::to_string(frame);
      return read;
    }
    if (grabber.field_number() < 2 * frame) {
      continue;
    }
    const core::Field& field = lease->field();
    if (field.status != core::FieldStatus::kGood) {
      read.message = recording + ": the first field of frame " + std::to_string(frame) +
                     " is damaged or missing, expected a good one to find the lattice in";
      return read;
    }
    read.sums.resize(static_cast<std::size_t>(camera.width_px) *
                     static_cast<std::size_t>(camera.height_px));
    core::picture::PictureAverage average(read.sums, camera.width_px, camera.height_px);
    if (average.add(field.pixels)) {
      if (const auto averaged = average.finish()) {
        read.picture = *averaged;
        return read;
      }
    }
    read.message = recording + ": its first field is no picture of the camera's size";
    return read;
  }
}

}  // namespace tubesight::board
